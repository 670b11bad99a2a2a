// SPDX-License-Identifier: BSD-3-Clause
#include "programs/python_plot.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "mivo/core/error.h"
#include "programs/command_line.h"

extern char** environ;

namespace mivo {
namespace {

namespace fs = std::filesystem;

/// Where Debian's Python modules are, whatever else is first on the PATH.
constexpr char kPython[] = "/usr/bin/python3";

/// A pipe whose ends are closed with it.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_, O_CLOEXEC) != 0) throw Error(std::string("no pipe: ") + std::strerror(errno));
  }
  ~Pipe() {
    closeReader();
    closeWriter();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void closeReader() { close(ends_[0]); }
  void closeWriter() { close(ends_[1]); }

 private:
  static void close(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  int ends_[2] = {-1, -1};
};

/// Without an error when the reader does not want all of it: its exit code tells.
void writeAll(int descriptor, const std::string& text) {
  struct sigaction ignored = {};
  struct sigaction before = {};
  ignored.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignored, &before);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(descriptor, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    done += static_cast<std::size_t>(count);
  }
  sigaction(SIGPIPE, &before, nullptr);
}

std::string readAll(int descriptor) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t count = read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

std::string lastLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

void requirePlotEnding(const std::string& option, const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".png" || ending == ".pdf" || ending == ".svg") return;
  throw UsageError(option + " " + path + ": the name must end with .png, .pdf or .svg");
}

void plotWithPython(const std::string& script, const std::string& table, const std::string& file) {
  const fs::path path = fs::read_symlink("/proc/self/exe").parent_path() / script;
  if (!fs::exists(path)) throw Error(path.string() + " is missing: install mivo again");
  Pipe input;
  Pipe errors;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.reader(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.writer(), STDERR_FILENO);
  std::string words[] = {fs::exists(kPython) ? kPython : "python3", path.string(), file};
  char* const arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  pid_t child = 0;
  const int fault = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (fault != 0) {
    throw Error(std::string("no plot, for python3 cannot be started: ") + std::strerror(fault));
  };
  input.closeReader();
  errors.closeWriter();
  writeAll(input.writer(), table);
  input.closeWriter();
  const std::string told = readAll(errors.reader());
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw Error("no plot: " + lastLine(told));
}

}  // namespace mivo
