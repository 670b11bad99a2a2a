// SPDX-License-Identifier: BSD-3-Clause
// The format: http://wiki.ros.org/Bags/Format/2.0. A record is the length of its header, the
// header, the length of its data, and the data; a header is a list of length and "name=value".
#include "ros/salvaged_bag.h"

#include <rosbag/chunked_file.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr char kMagic[] = "#ROSBAG V2.0\n";
constexpr std::size_t kMagicSize = sizeof(kMagic) - 1;
// A field of the header of a chunk, and of nothing else; the others may stand before it.
constexpr std::array<std::uint8_t, 8> kChunkField = {4, 0, 0, 0, 'o', 'p', '=', 0x05};
constexpr std::size_t kMostBefore = 100;  // bytes of the other fields
// Headers hold a topic and a few numbers: more than this is damage.
constexpr std::size_t kMaxHeader = std::size_t{1} << 20;
// A chunk is 768 kB by default, or one message: more than this is damage.
constexpr std::size_t kMaxChunk = std::size_t{1} << 30;
constexpr std::size_t kSearchStep = std::size_t{1} << 20;

enum Operation : std::uint8_t { kMessage = 0x02, kChunk = 0x05, kConnection = 0x07 };

struct Damage {};

std::uint32_t number(const std::uint8_t* bytes) {
  std::uint32_t value = 0;  // little endian
  for (int i = 3; i >= 0; --i) value = value << 8 | bytes[i];
  return value;
}

/// Reads numbers and parts out of bytes, never beyond their end.
class Cursor {
 public:
  Cursor(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), size_(size) {}
  bool atEnd() const { return position_ == size_; }
  std::size_t position() const { return position_; }
  const std::uint8_t* take(std::size_t count) {
    if (count > size_ - position_) throw Damage();
    const std::uint8_t* part = bytes_ + position_;
    position_ += count;
    return part;
  }
  std::uint32_t takeNumber() { return number(take(4)); }

 private:
  const std::uint8_t* bytes_;
  std::size_t size_;
  std::size_t position_ = 0;
};

std::map<std::string, std::string> fieldsOf(const std::uint8_t* bytes, std::size_t size) {
  std::map<std::string, std::string> fields;
  Cursor cursor(bytes, size);
  while (!cursor.atEnd()) {
    const std::size_t length = cursor.takeNumber();
    const std::string field(reinterpret_cast<const char*>(cursor.take(length)), length);
    const std::size_t equals = field.find('=');
    if (equals == std::string::npos) throw Damage();
    fields[field.substr(0, equals)] = field.substr(equals + 1);
  }
  return fields;
}

const std::string& valueOf(const std::map<std::string, std::string>& fields,
                           const std::string& name, std::size_t size = 0) {
  const auto entry = fields.find(name);
  if (entry == fields.end() || (size > 0 && entry->second.size() != size)) throw Damage();
  return entry->second;
}

std::uint32_t numberOf(const std::map<std::string, std::string>& fields, const std::string& name,
                       std::size_t at = 0, std::size_t size = 4) {
  const std::string& value = valueOf(fields, name, size);
  return number(reinterpret_cast<const std::uint8_t*>(value.data()) + at);
}

std::uint8_t operationOf(const std::map<std::string, std::string>& fields) {
  return static_cast<std::uint8_t>(valueOf(fields, "op", 1)[0]);
}

}  // namespace

SalvagedBag::SalvagedBag(const std::string& path)
    : path_(path), file_(path, std::ios::binary | std::ios::ate) {
  if (!file_) throw Error(path + " cannot be read");
  file_size_ = static_cast<std::size_t>(file_.tellg());
  const std::vector<std::uint8_t> magic = read(0, std::min(kMagicSize, file_size_));
  if (magic.size() < kMagicSize || std::memcmp(magic.data(), kMagic, kMagicSize) != 0) {
    throw Error(path + " cannot be read as a bag: it does not begin as one");
  }
  scan();
  loaded_ = static_cast<std::size_t>(-1);
}

std::vector<std::uint8_t> SalvagedBag::read(std::size_t position, std::size_t size) const {
  if (position > file_size_ || size > file_size_ - position) throw Damage();
  std::vector<std::uint8_t> bytes(size);
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(position));
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!file_) throw Damage();
  return bytes;
}

void SalvagedBag::scan() {
  std::size_t position = kMagicSize;
  while (position < file_size_) {
    try {
      position = scanRecord(position);
    } catch (const Damage&) {
      ++damaged_;
      position = findChunk(position + 1);
    }
  }
}

/// Returns the position of the next record.
std::size_t SalvagedBag::scanRecord(std::size_t position) {
  const std::size_t header_size = number(read(position, 4).data());
  if (header_size > kMaxHeader) throw Damage();
  if (position + 8 + header_size > file_size_) {
    ends_early_ = true;
    return file_size_;
  }
  const std::vector<std::uint8_t> header = read(position + 4, header_size);
  const Fields fields = fieldsOf(header.data(), header.size());
  const std::uint8_t operation = operationOf(fields);
  const std::size_t begin = position + 8 + header_size;
  const std::size_t size = number(read(begin - 4, 4).data());
  if (size > kMaxChunk) throw Damage();
  const std::size_t there = std::min(size, file_size_ - begin);
  if (there < size) {
    if (findChunk(begin) < file_size_) throw Damage();  // not the end, but a wrong size
    ends_early_ = true;
  }
  if (operation == kChunk) {
    scanChunk({begin, there, numberOf(fields, "size"), valueOf(fields, "compression")});
  } else if (operation == kConnection && there == size) {
    const std::vector<std::uint8_t> data = read(begin, size);
    addConnection(fields, data.data(), data.size());
  }
  return begin + there;
}

/// Where the header of a chunk begins that has its field of the operation at a position; nothing
/// when there is none.
std::optional<std::size_t> SalvagedBag::headerAround(std::size_t field) const {
  const std::size_t begin = field - std::min(field, kMostBefore);
  const std::vector<std::uint8_t> part = read(begin, std::min(file_size_ - begin, 2 * kMostBefore));
  for (std::size_t at = field - begin; at >= 4; --at) {
    const std::size_t size = number(part.data() + at - 4);
    if (size < kChunkField.size() || at + size > part.size()) continue;
    try {
      const Fields fields = fieldsOf(part.data() + at, size);
      if (operationOf(fields) == kChunk && fields.count("compression") > 0) return begin + at - 4;
    } catch (const Damage&) {
      // No header begins here.
    }
  }
  return std::nullopt;
}

/// The next position at or after this one at which the record of a chunk begins.
std::size_t SalvagedBag::findChunk(std::size_t position) {
  const std::size_t first = position;
  while (position + kChunkField.size() <= file_size_) {
    const std::vector<std::uint8_t> part =
        read(position, std::min(kSearchStep, file_size_ - position));
    for (auto found = part.begin();;) {
      found = std::search(found, part.end(), kChunkField.begin(), kChunkField.end());
      if (found == part.end()) break;
      const auto header = headerAround(position + static_cast<std::size_t>(found - part.begin()));
      if (header && *header >= first) return *header;
      ++found;
    }
    if (part.size() < kSearchStep) return file_size_;
    position += part.size() - kMostBefore;
  }
  return file_size_;
}

void SalvagedBag::scanChunk(const Chunk& chunk) {
  chunks_.push_back(chunk);
  try {
    load(chunk);
    Cursor cursor(bytes_.data(), bytes_.size());
    while (!cursor.atEnd()) {
      const std::size_t header_size = cursor.takeNumber();
      const Fields fields = fieldsOf(cursor.take(header_size), header_size);
      const std::size_t size = cursor.takeNumber();
      const std::size_t offset = cursor.position();
      const std::uint8_t* data = cursor.take(size);
      const std::uint8_t operation = operationOf(fields);
      if (operation == kConnection) addConnection(fields, data, size);
      if (operation != kMessage) continue;
      const auto connection = connections_.find(numberOf(fields, "conn"));
      if (connection == connections_.end()) throw Damage();
      const ros::Time time(numberOf(fields, "time", 0, 8), numberOf(fields, "time", 4, 8));
      messages_.push_back({&connection->second, time, chunks_.size() - 1, offset, size});
    }
  } catch (const Damage&) {
    // What came before the damage in this chunk stays; the next one begins at a known place.
    if (!ends_early_) ++damaged_;
  }
}

void SalvagedBag::addConnection(const Fields& header, const std::uint8_t* data, std::size_t size) {
  const Fields fields = fieldsOf(data, size);
  connections_.emplace(
      numberOf(header, "conn"),
      Connection{valueOf(header, "topic"), valueOf(fields, "type"), valueOf(fields, "md5sum"),
                 valueOf(fields, "message_definition")});
}

/// Fills bytes_.
void SalvagedBag::load(const Chunk& chunk) const {
  loaded_ = static_cast<std::size_t>(-1);
  std::vector<std::uint8_t> compressed = read(chunk.position, chunk.compressed_size);
  if (chunk.compression == "none") {
    bytes_ = std::move(compressed);
    return;
  }
  if (chunk.size > kMaxChunk) throw Damage();
  bytes_.resize(chunk.size);
  try {
    rosbag::ChunkedFile().decompress(
        chunk.compression == "bz2" ? rosbag::compression::BZ2 : rosbag::compression::LZ4,
        bytes_.data(), static_cast<unsigned>(chunk.size), compressed.data(),
        static_cast<unsigned>(compressed.size()));
  } catch (const std::exception&) {
    bytes_.clear();
    throw Damage();
  }
}

const std::uint8_t* SalvagedBag::data(const Message& message) const {
  if (loaded_ != message.chunk) {
    try {
      load(chunks_[message.chunk]);
    } catch (const Damage&) {
      throw Error(path_ + " has changed while it was read");
    }
    loaded_ = message.chunk;
  }
  return bytes_.data() + message.offset;
}

}  // namespace mivo
