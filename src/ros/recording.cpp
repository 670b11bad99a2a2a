// SPDX-License-Identifier: BSD-3-Clause
#include "ros/recording.h"

#include <rosbag/view.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

namespace mivo {
namespace {

namespace fs = std::filesystem;

constexpr char kToRos1[] =
    "convert it first: pip install rosbags, then rosbags-convert --src PATH --dst FILE.bag";

// What packed files begin with.
constexpr std::pair<const char*, const char*> kPackers[] = {
    {"\x1f\x8b", "gzip"}, {"BZh", "bzip2"},       {"\xfd\x37zXZ", "xz"}, {"PK\x03\x04", "zip"},
    {"7z\xbc\xaf", "7z"}, {"(\xb5/\xfd", "zstd"}, {"Rar!", "rar"}};

bool hasRos2Files(const fs::path& folder) {
  if (fs::exists(folder / "metadata.yaml")) return true;
  const fs::directory_iterator entries(folder);
  return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    const std::string extension = entry.path().extension().string();
    return extension == ".db3" || extension == ".mcap";
  });
}

/// What a file begins with, for those that are often taken for a bag.
std::string otherFormat(const std::string& head) {
  const auto begins = [&](const std::string& magic) { return head.rfind(magic, 0) == 0; };
  if (begins("SQLite format 3")) {
    return std::string("is a recording of ROS 2 (SQLite): ") + kToRos1;
  }
  if (begins("\x89MCAP")) return std::string("is a recording of ROS 2 (MCAP): ") + kToRos1;
  if (begins("#ROSRECORD") || begins("#ROSBAG V1")) {
    return "is a bag of an old version: rosbag fix writes one of version 2.0";
  }
  for (const auto& [magic, name] : kPackers) {
    if (begins(magic)) return std::string("is packed by ") + name + ": unpack it first";
  }
  if (!begins("#ROSBAG V2")) return "is no bag";
  return {};
}

/// Throws Error for what is no bag, with what it is.
void requireBag(const std::string& path) {
  const auto refuse = [&](const std::string& what) {
    throw Error(path + " cannot be read as a bag: it " + what);
  };
  if (fs::is_directory(path)) {
    refuse(hasRos2Files(path) ? std::string("is a recording of ROS 2 (a folder): ") + kToRos1
                              : "is a folder; name the bags themselves, or use run_sequence for a "
                                "folder of images");
  }
  if (fs::is_fifo(path) || fs::is_character_file(path)) {
    refuse(
        "is a pipe or a device; a bag is not read from its beginning to its end: copy it to a "
        "file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path + " cannot be read: " + std::strerror(errno));
  std::string head(16, '\0');
  file.read(&head[0], static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  if (head.empty()) refuse("is empty");
  const std::string other = otherFormat(head);
  if (!other.empty()) refuse(other);
}

bool isWanted(const std::vector<std::string>& topics, const std::string& topic) {
  return std::find(topics.begin(), topics.end(), topic) != topics.end();
}

}  // namespace

boost::shared_ptr<const topic_tools::ShapeShifter> RecordedMessage::readAny() const {
  if (indexed_) return indexed_->instantiate<topic_tools::ShapeShifter>();
  const auto message = boost::make_shared<topic_tools::ShapeShifter>();
  const SalvagedBag::Connection& connection = *salvaged_->connection;
  message->morph(connection.md5sum, connection.type, connection.definition, "0");
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(bag_->data(*salvaged_)),
                                     static_cast<std::uint32_t>(salvaged_->size));
  message->read(stream);
  return message;
}

Recording::Recording(const std::vector<std::string>& paths, Reader reader) {
  for (const std::string& path : paths) {
    requireBag(path);
    name_ += (name_.empty() ? "" : " ") + path;
    open(path, reader);
  }
}

void Recording::open(const std::string& path, Reader reader) {
  if (reader == Reader::kSalvage) {
    salvage(path, "");
    return;
  }
  auto bag = std::make_unique<rosbag::Bag>();
  try {
    bag->open(path, rosbag::bagmode::Read);
    rosbag::View view(*bag);
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      contents_[connection->topic] = connection->datatype;
    }
  } catch (const rosbag::BagUnindexedException&) {
    salvage(path, "it has no index, for its recording was interrupted");
    return;
  } catch (const std::exception&) {
    salvage(path, "its index is damaged or missing");
    return;
  }
  bags_.push_back(std::move(bag));
}

void Recording::salvage(const std::string& path, const std::string& fault) {
  auto bag = std::make_unique<SalvagedBag>(path);
  std::string what = fault;
  const auto add = [&](const std::string& text) { what += (what.empty() ? "" : ", ") + text; };
  if (bag->endsEarly()) add("its end is missing");
  if (bag->damagedPlaces() > 0) {
    add(std::to_string(bag->damagedPlaces()) + " of its parts are damaged");
  }
  if (bag->messages().empty()) {
    throw Error(path + " cannot be read as a bag: " + what + ", and no message in it is whole");
  }
  for (const SalvagedBag::Message& message : bag->messages()) {
    contents_[message.connection->topic] = message.connection->type;
  }
  if (!what.empty()) {
    damage_ += (damage_.empty() ? "" : "; ") + path + ": " + what +
               "; what is whole is used (rosbag reindex " + path + " mends the file)";
  }
  salvaged_.push_back(std::move(bag));
}

std::vector<RecordedMessage> Recording::messages(const std::vector<std::string>& topics) const {
  std::vector<RecordedMessage> messages;
  rosbag::View view;
  for (const auto& bag : bags_) view.addQuery(*bag, rosbag::TopicQuery(topics));
  for (const rosbag::MessageInstance& instance : view) messages.emplace_back(instance);
  for (const auto& bag : salvaged_) {
    for (const SalvagedBag::Message& message : bag->messages()) {
      if (isWanted(topics, message.connection->topic)) messages.emplace_back(*bag, message);
    }
  }
  if (!salvaged_.empty()) {
    std::stable_sort(
        messages.begin(), messages.end(),
        [](const RecordedMessage& a, const RecordedMessage& b) { return a.time() < b.time(); });
  }
  return messages;
}

}  // namespace mivo
