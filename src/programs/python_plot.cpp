// SPDX-License-Identifier: BSD-3-Clause
#include "programs/python_plot.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "mivo/core/error.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

/// Where Debian's Python modules are, whatever else is first on the PATH.
constexpr char kPython[] = "/usr/bin/python3";

[[noreturn]] void runScript(const std::string& script, const std::string& file, int input) {
  dup2(input, STDIN_FILENO);
  const char* python = fs::exists(kPython) ? kPython : "python3";
  execlp(python, python, script.c_str(), file.c_str(), nullptr);
  _exit(127);
}

void writeAll(int output, const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count = ::write(output, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;  // the script has ended: its exit code says why
    written += static_cast<std::size_t>(count);
  }
}

}  // namespace

void plotWithPython(const std::string& script, const std::string& table, const std::string& file) {
  const fs::path path = fs::read_symlink("/proc/self/exe").parent_path() / script;
  if (!fs::exists(path)) throw Error(path.string() + " is missing: install mivo again");
  int ends[2];
  if (pipe(ends) != 0) throw Error(std::string("no pipe to Python: ") + std::strerror(errno));
  const pid_t child = fork();
  if (child < 0) throw Error(std::string("Python cannot be started: ") + std::strerror(errno));
  if (child == 0) {
    close(ends[1]);
    runScript(path.string(), file, ends[0]);
  }
  close(ends[0]);
  std::signal(SIGPIPE, SIG_IGN);
  writeAll(ends[1], table);
  close(ends[1]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw Error(WIFEXITED(status) && WEXITSTATUS(status) == 127
                  ? "no plot, for python3 cannot be started"
                  : "no plot, for the reason above");
}

}  // namespace mivo
