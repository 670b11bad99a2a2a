// SPDX-License-Identifier: BSD-3-Clause
#include "io/table_reader.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <locale>
#include <optional>
#include <sstream>
#include <string_view>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// What some editors put before the first character of a file.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr const char* kSeparators = " \t,;";

std::optional<double> parse(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  stream >> value;
  if (stream.fail() || stream.peek() != std::istringstream::traits_type::eof() ||
      !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

TableReader::TableReader(const std::string& path) : path_(path) {
  // A folder opens like a file and only fails when it is read.
  std::error_code ignored;  // what cannot be looked at cannot be opened either, and that says why
  if (std::filesystem::is_directory(path, ignored))
    throw Error("cannot read " + path + ": it is a folder");
  errno = 0;
  stream_.open(path);
  if (!stream_) throw Error("cannot read " + path + ": " + std::strerror(errno));
}

/// Up to a line feed, a carriage return, or both.
bool TableReader::readLine() {
  record_.clear();
  bool is_line = false;
  for (char character = 0; stream_.get(character); record_ += character) {
    is_line = true;
    if (character == '\n') break;
    if (character == '\r') {
      if (stream_.peek() == '\n') stream_.get();
      break;
    }
  }
  if (stream_.bad()) throw Error("cannot read " + path_ + " after line " + std::to_string(line_));
  if (is_line) ++line_;
  if (line_ == 1) {
    if (record_.rfind("\xFF\xFE", 0) == 0 || record_.rfind("\xFE\xFF", 0) == 0) {
      throw Error(path_ + " is encoded as UTF-16: save it as UTF-8");
    }
    if (record_.rfind(kByteOrderMark, 0) == 0) record_.erase(0, kByteOrderMark.size());
  }
  return is_line;
}

void TableReader::split() {
  fields_.clear();
  for (std::size_t i = record_.find_first_not_of(kSeparators); i != std::string::npos;
       i = record_.find_first_not_of(kSeparators, i)) {
    const std::size_t quote = record_[i] == '"' ? record_.find('"', i + 1) : std::string::npos;
    if (quote != std::string::npos) {
      fields_.push_back({record_.substr(i + 1, quote - i - 1), i, quote + 1});
    } else {
      const std::size_t end = std::min(record_.find_first_of(kSeparators, i), record_.size());
      fields_.push_back({record_.substr(i, end - i), i, end});
    }
    i = fields_.back().end;
  }
}

bool TableReader::next() {
  while (readLine()) {
    split();
    if (fields_.empty()) continue;
    if (record_[fields_.front().begin] != '#') return has_record_ = true;
    if (!has_record_) comments_.push_back(record_.substr(fields_.front().begin + 1));
  }
  fields_.clear();
  return false;
}

std::string TableReader::textOf(std::size_t first, std::size_t last) const {
  if (first == last) return text(first);
  return record_.substr(fields_.at(first).begin, fields_.at(last).end - fields_.at(first).begin);
}

bool TableReader::isNumber(std::size_t field) const {
  return parse(text(field)).has_value();
}

double TableReader::number(std::size_t field) const {
  const std::optional<double> value = parse(text(field));
  if (!value) refuse("'" + text(field) + "' is not a finite number");
  return *value;
}

void TableReader::refuse(const std::string& what) const {
  throw Error(path_ + ":" + std::to_string(line_) + ": " + what);
}

}  // namespace mivo
