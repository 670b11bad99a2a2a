// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <locale>
#include <optional>
#include <sstream>
#include <string>

namespace mivo {

/// A switch as YAML has it: true and false, yes and no, on and off, 1 and 0, in small, capital or
/// capitalized letters.
inline std::optional<bool> parseSwitch(const std::string& text) {
  constexpr std::array<const char*, 4> kWords[] = {{"false", "no", "off", "0"},
                                                   {"true", "yes", "on", "1"}};
  std::string small = text;
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const bool answer : {false, true}) {
    const auto& words = kWords[answer ? 1 : 0];
    if (std::find(words.begin(), words.end(), small) != words.end()) return answer;
  }
  return std::nullopt;
}

/// A number, with exponent or without; nothing else may stand beside it but blanks.
inline std::optional<double> parseNumber(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  stream >> number;
  if (stream.fail() || !(stream >> std::ws).eof()) return std::nullopt;
  return number;
}

}  // namespace mivo
