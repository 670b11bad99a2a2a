// SPDX-License-Identifier: BSD-3-Clause
#include "io/table_reader.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <locale>
#include <sstream>
#include <string_view>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// What some editors put before the first character of a file.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

TableReader::TableReader(const std::string& path) : path_(path) {
  // A folder opens like a file and only fails when it is read.
  if (std::filesystem::is_directory(path)) throw Error("cannot read " + path + ": it is a folder");
  errno = 0;
  stream_.open(path);
  if (!stream_) throw Error("cannot read " + path + ": " + std::strerror(errno));
}

bool TableReader::next() {
  for (std::string line; std::getline(stream_, line);) {
    if (++line_ == 1 && line.rfind(kByteOrderMark, 0) == 0) line.erase(0, kByteOrderMark.size());
    for (char& character : line) {
      if (character == ',' || character == '\t' || character == '\r') character = ' ';
    }
    std::istringstream words(line);
    fields_.clear();
    for (std::string word; words >> word;) fields_.push_back(word);
    if (!fields_.empty() && fields_.front().front() != '#') return true;
  }
  if (stream_.bad()) throw Error("cannot read " + path_ + " after line " + std::to_string(line_));
  fields_.clear();
  return false;
}

double TableReader::number(std::size_t field) const {
  std::istringstream stream(text(field));
  stream.imbue(std::locale::classic());
  double value = 0.0;
  stream >> value;
  if (stream.fail() || stream.peek() != std::istringstream::traits_type::eof() ||
      !std::isfinite(value)) {
    refuse("'" + text(field) + "' is not a finite number");
  }
  return value;
}

void TableReader::refuse(const std::string& what) const {
  throw Error(path_ + ":" + std::to_string(line_) + ": " + what);
}

}  // namespace mivo
