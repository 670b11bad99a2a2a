// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

namespace mivo {

/// Reads a text file of fields separated by blanks, tabs or commas, one record a line. Empty lines
/// and lines that start with '#' are skipped. Everything thrown names the file and the line.
class TableReader {
 public:
  /// Throws Error when the file cannot be opened.
  explicit TableReader(const std::string& path);

  /// Goes to the next record; false at the end. Throws Error when the file cannot be read on.
  bool next();

  const std::string& path() const { return path_; }
  std::size_t size() const { return fields_.size(); }
  const std::string& text(std::size_t field) const { return fields_.at(field); }

  /// A finite number with a point for the decimals. Throws Error for anything else.
  double number(std::size_t field) const;

  /// Throws Error "file:line: what".
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string path_;
  std::ifstream stream_;
  std::size_t line_ = 0;
  std::vector<std::string> fields_;
};

}  // namespace mivo
