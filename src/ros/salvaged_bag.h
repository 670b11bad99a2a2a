// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mivo {

/// A bag that rosbag cannot read, for its end or its index is missing, or a chunk is damaged: read
/// from front to back, record by record, with whatever is whole. (`rosbag reindex` writes a copy
/// that every tool can read.)
class SalvagedBag {
 public:
  struct Connection {
    std::string topic;
    std::string type;
    std::string md5sum;
    std::string definition;  ///< of the message, as text
  };

  struct Message {
    const Connection* connection;
    ros::Time time;  ///< when it was recorded
    std::size_t chunk;
    std::size_t offset;  ///< in the chunk, of its data
    std::size_t size;
  };

  /// Throws Error when the file cannot be opened or is no bag.
  explicit SalvagedBag(const std::string& path);

  /// In the order of the file.
  const std::vector<Message>& messages() const { return messages_; }

  /// Serialized bytes of a message, which live until the next call.
  const std::uint8_t* data(const Message& message) const;

  std::size_t damagedPlaces() const { return damaged_; }
  bool endsEarly() const { return ends_early_; }

 private:
  struct Chunk {
    std::size_t position;         // in the file, of its compressed bytes
    std::size_t compressed_size;  // of what is there
    std::size_t size;
    std::string compression;
  };
  using Fields = std::map<std::string, std::string>;

  void scan();
  std::size_t scanRecord(std::size_t position);
  std::size_t findChunk(std::size_t position);
  std::optional<std::size_t> headerAround(std::size_t field) const;
  void scanChunk(const Chunk& chunk);
  void addConnection(const Fields& header, const std::uint8_t* data, std::size_t size);
  void load(const Chunk& chunk) const;
  std::vector<std::uint8_t> read(std::size_t position, std::size_t size) const;

  std::string path_;
  mutable std::ifstream file_;
  std::size_t file_size_ = 0;
  std::map<std::uint32_t, Connection> connections_;
  std::vector<Chunk> chunks_;
  std::vector<Message> messages_;
  std::size_t damaged_ = 0;
  bool ends_early_ = false;
  mutable std::vector<std::uint8_t> bytes_;  // of the chunk that was read last
  mutable std::size_t loaded_ = static_cast<std::size_t>(-1);
};

}  // namespace mivo
