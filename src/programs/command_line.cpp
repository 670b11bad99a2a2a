// SPDX-License-Identifier: BSD-3-Clause
#include "programs/command_line.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <iostream>
#include <sstream>
#include <utility>

#include "core/nearest_name.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

namespace po = boost::program_options;

constexpr unsigned kHelpWidth = 100;
const char* const kArguments = "mivo-arguments";

/// Boost's multitoken() would swallow the arguments that follow the option.
class TwoNumbers : public po::typed_value<std::vector<double>> {
 public:
  explicit TwoNumbers(std::vector<double>* target) : po::typed_value<std::vector<double>>(target) {}
  unsigned min_tokens() const override { return 2; }
  unsigned max_tokens() const override { return 2; }
};

/// Without line breaks, and without the control characters of a damaged file that it may quote.
std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

std::string beforeEquals(const std::string& option) {
  return option.substr(0, option.find('='));
}

/// A full disk behind a redirection would leave a part of the figures, or none.
void requireWritten(std::ostream& stream) {
  if (!stream.flush()) throw Error("cannot write to the standard output: is the disk full?");
}

std::string withoutDashes(const std::string& option) {
  return option.substr(std::min(option.find_first_not_of('-'), option.size()));
}

}  // namespace

CommandLine::CommandLine(std::string program, std::string summary)
    : program_(std::move(program)),
      summary_(std::move(summary)),
      visible_("Options", kHelpWidth, kHelpWidth / 2) {
  visible_.add_options()("help,h", "print this text")("version", "print the version");
}

void CommandLine::argument(const std::string& name, std::string* target, const std::string& text) {
  arguments_.push_back({name, target, nullptr, text});
}

void CommandLine::arguments(const std::string& name, std::vector<std::string>* targets,
                            const std::string& text) {
  arguments_.push_back({name + "...", nullptr, targets, text});
}

po::options_description_easy_init CommandLine::options() {
  return visible_.add_options();
}

bool CommandLine::parse(int argc, const char* const* argv) {
  po::options_description all;
  all.add(visible_).add_options()(kArguments, po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add(kArguments, -1);
  // An abbreviated option would change its meaning when another option is added.
  const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  try {
    po::store(
        po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(),
        values_);
    if (values_.count("help") != 0) {
      std::cout << help();
      return false;
    }
    if (values_.count("version") != 0) {
      std::cout << program_ << " " << MIVO_VERSION << "\n";
      return false;
    }
    po::notify(values_);
  } catch (const po::unknown_option& error) {
    const std::string option = beforeEquals(error.get_option_name());
    throw UsageError("unknown option '" + option + "'" +
                     didYouMean(withoutDashes(option), optionNames(), "'--"));
  } catch (const po::error& error) {
    throw UsageError(error.what());
  }
  std::vector<std::string> given;
  if (values_.count(kArguments) != 0) given = values_[kArguments].as<std::vector<std::string>>();
  setArguments(given);
  return true;
}

void CommandLine::setArguments(const std::vector<std::string>& given) {
  if (given.size() < arguments_.size()) {
    throw UsageError("argument " + arguments_[given.size()].name + " is missing");
  }
  const bool has_list = std::any_of(arguments_.begin(), arguments_.end(),
                                    [](const Argument& argument) { return argument.targets; });
  const std::size_t rest = given.size() - arguments_.size();
  if (rest > 0 && !has_list) {
    throw UsageError("unexpected argument '" + given[arguments_.size()] + "'");
  }
  auto next = given.begin();
  for (const Argument& argument : arguments_) {
    const auto first = next++;
    if (argument.targets == nullptr) {
      *argument.target = *first;
    } else {
      next += static_cast<std::ptrdiff_t>(rest);
      argument.targets->assign(first, next);
    }
  }
}

std::vector<std::string> CommandLine::optionNames() const {
  std::vector<std::string> names;
  for (const auto& option : visible_.options()) names.push_back(option->long_name());
  return names;
}

bool CommandLine::has(const std::string& option) const {
  return values_.count(option) != 0 && !values_[option].defaulted();
}

std::string CommandLine::help() const {
  std::ostringstream text;
  text << summary_ << "\n\nUsage: " << program_;
  std::size_t width = 0;
  for (const Argument& argument : arguments_) {
    text << " " << argument.name;
    width = std::max(width, argument.name.size());
  }
  text << " [options]\n\n";
  for (const Argument& argument : arguments_) {
    text << "  " << argument.name << std::string(width - argument.name.size() + 2, ' ')
         << argument.text << "\n";
  }
  if (!arguments_.empty()) text << "\n";
  text << visible_ << "\nExit code: 0 success, 1 input cannot be used, 2 wrong usage.\n";
  return text.str();
}

po::typed_value<std::vector<double>>* twoNumbers(std::vector<double>* target) {
  return new TwoNumbers(target);
}

int runProgram(const std::string& program, const std::function<void()>& body) {
  try {
    body();
    requireWritten(std::cout);
    return 0;
  } catch (const UsageError& error) {
    std::cerr << program << ": " << oneLine(error.what()) << " (see " << program << " --help)\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << program << ": " << oneLine(error.what()) << "\n";
    return 1;
  }
}

}  // namespace mivo
