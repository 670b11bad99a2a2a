// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mivo {

/// Invalid command line: exit code 2. Unusable input is an Error: exit code 1.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The command line of one program: required arguments in order, options, `--help` (`-h`),
/// `--version`. An unknown option is answered with the nearest known one.
///
///   int main(int argc, char** argv) {
///     return mivo::runProgram("count_frames", [&] {
///       std::string folder;
///       bool force = false;
///       mivo::CommandLine line("count_frames", "Counts the frames of a sequence folder.");
///       line.argument("FOLDER", &folder, "the sequence");
///       line.options()("force", boost::program_options::bool_switch(&force), "...");
///       if (!line.parse(argc, argv)) return;  // --help or --version was answered
///       ...
///     });
///   }
class CommandLine {
 public:
  CommandLine(std::string program, std::string summary);

  /// Adds a required argument without a name; they are given in the order of these calls.
  void argument(const std::string& name, std::string* target, const std::string& text);

  /// The same for one or more of a kind: all that are given but those of the other arguments. To be
  /// called once at most.
  void arguments(const std::string& name, std::vector<std::string>* targets,
                 const std::string& text);

  /// Adds options in Boost's way: `options()("name", value<...>(...), "text")("other", ...)`.
  boost::program_options::options_description_easy_init options();

  /// Reads the command line and sets the targets. Returns false if --help or --version was given
  /// and answered on stdout. Throws UsageError.
  bool parse(int argc, const char* const* argv);

  /// Whether an option was given (and not only has a default).
  bool has(const std::string& option) const;

  /// The text of `--help`.
  std::string help() const;

 private:
  struct Argument {
    std::string name;
    std::string* target;  ///< one of the two is set
    std::vector<std::string>* targets;
    std::string text;
  };
  std::vector<std::string> optionNames() const;
  void setArguments(const std::vector<std::string>& given);

  std::string program_;
  std::string summary_;
  std::vector<Argument> arguments_;
  boost::program_options::options_description visible_;
  boost::program_options::variables_map values_;
};

/// Value of an option that takes exactly two numbers, neither more nor fewer: `--option A B`.
boost::program_options::typed_value<std::vector<double>>* twoNumbers(std::vector<double>* target);

/// Runs the body of a program and turns what it throws into the exit code: 0 done, 2 UsageError,
/// 1 anything else, also a standard output that cannot be written; with one line `program: what` on
/// stderr.
int runProgram(const std::string& program, const std::function<void()>& body);

}  // namespace mivo
