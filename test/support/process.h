// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

extern char** environ;

namespace mivo {

/// What a finished process left behind.
struct ProcessResult {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string output;
  std::string errors;

  /// Lines on stderr.
  std::size_t errorLines() const {
    return static_cast<std::size_t>(std::count(errors.begin(), errors.end(), '\n'));
  }
};

/// Runs a program without a shell, waits for it and returns what it wrote and its exit code.
inline ProcessResult runProcess(const std::string& program,
                                const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  const std::string output = folder / "stdout";
  const std::string errors = folder / "stderr";
  std::vector<char*> argv = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int flags = O_WRONLY | O_CREAT;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), flags, 0600);
  pid_t pid = 0;
  const int error = posix_spawn(&pid, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot run " + program);

  int status = 0;
  if (waitpid(pid, &status, 0) != pid) throw std::runtime_error("cannot wait for " + program);
  ProcessResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.output = contentOf(output);
  result.errors = contentOf(errors);
  return result;
}

}  // namespace mivo
