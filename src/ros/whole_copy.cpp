// SPDX-License-Identifier: BSD-3-Clause
#include "ros/whole_copy.h"

#include "ros/output_bag.h"
#include "ros/recording.h"

namespace mivo {
namespace {

std::vector<RecordedMessage> allMessages(const Recording& recording) {
  std::vector<std::string> topics;
  for (const auto& [topic, type] : recording.contents()) topics.push_back(topic);
  return recording.messages(topics);
}

/// Whether rosbag finds all that its indices name.
bool isReadable(const Recording& recording) {
  try {
    for (const RecordedMessage& message : allMessages(recording)) message.readAny();
    return true;
  } catch (const std::exception&) {
    return false;  // salvaged by the caller, who says what is damaged
  }
}

void writeAll(const Recording& recording, const std::string& path) {
  OutputBag bag(path);
  for (const RecordedMessage& message : allMessages(recording)) {
    bag.write(message.topic(), message.time(), *message.readAny());
  }
  bag.close();
}

}  // namespace

std::string copyWhenDamaged(const std::vector<std::string>& bags, const std::string& copy) {
  const Recording recording(bags);
  if (isReadable(recording)) {
    if (!recording.damage().empty()) writeAll(recording, copy);
    return recording.damage();
  }
  const Recording salvaged(bags, Recording::Reader::kSalvage);
  writeAll(salvaged, copy);
  return salvaged.damage();
}

}  // namespace mivo
