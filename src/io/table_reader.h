// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

namespace mivo {

/// Reads a text file of fields separated by blanks, tabs, commas or semicolons, one record a line;
/// a field in double quotes may have them inside. Lines end as on any system. Empty lines, lines
/// that start with '#' and a byte order mark are skipped. Everything thrown names the file and the
/// line.
class TableReader {
 public:
  /// Throws Error when the file cannot be opened.
  explicit TableReader(const std::string& path);

  /// Goes to the next record; false at the end. Throws Error when the file cannot be read on.
  bool next();

  const std::string& path() const { return path_; }
  std::size_t size() const { return fields_.size(); }
  const std::string& text(std::size_t field) const { return fields_.at(field).text; }

  /// From the first of these fields to the last one, with all that separates them, for paths with
  /// blanks in them. Quotes around a single field are left out.
  std::string textOf(std::size_t first, std::size_t last) const;

  /// The lines that were skipped for their '#', without it, before the first record: one of them is
  /// the heading of the table, often.
  const std::vector<std::string>& comments() const { return comments_; }

  /// Whether the field is a finite number.
  bool isNumber(std::size_t field) const;

  /// A finite number with a point for the decimals. Throws Error for anything else.
  double number(std::size_t field) const;

  /// Throws Error "file:line: what".
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  struct Field {
    std::string text;
    std::size_t begin;  // in record_, quotes included
    std::size_t end;
  };

  bool readLine();
  void split();

  std::string path_;
  std::ifstream stream_;
  std::size_t line_ = 0;
  std::string record_;
  std::vector<std::string> comments_;
  bool has_record_ = false;
  std::vector<Field> fields_;
};

}  // namespace mivo
