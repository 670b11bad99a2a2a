// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/message_instance.h>
#include <topic_tools/shape_shifter.h>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "mivo/core/error.h"
#include "ros/bag_topics.h"
#include "ros/salvaged_bag.h"

namespace mivo {

/// One message of a recording: where it is, to be read when its turn has come.
class RecordedMessage {
 public:
  explicit RecordedMessage(const rosbag::MessageInstance& instance)
      : indexed_(std::make_shared<rosbag::MessageInstance>(instance)) {}
  RecordedMessage(const SalvagedBag& bag, const SalvagedBag::Message& message)
      : bag_(&bag), salvaged_(&message) {}

  const std::string& topic() const {
    return indexed_ ? indexed_->getTopic() : salvaged_->connection->topic;
  }
  const std::string& type() const {
    return indexed_ ? indexed_->getDataType() : salvaged_->connection->type;
  }
  /// When it was recorded.
  const ros::Time& time() const { return indexed_ ? indexed_->getTime() : salvaged_->time; }

  template <typename Message>
  bool is() const {
    return type() == ros::message_traits::DataType<Message>::value();
  }

  /// Throws Error when it is another type, and whatever rosbag throws when it is damaged.
  template <typename Message>
  boost::shared_ptr<const Message> read() const {
    boost::shared_ptr<const Message> message =
        indexed_ ? boost::shared_ptr<const Message>(indexed_->instantiate<Message>())
                 : salvage<Message>();
    if (!message) {
      throw Error("the message is a " + type() + ", not a " +
                  ros::message_traits::DataType<Message>::value());
    }
    return message;
  }

  /// The same without a look at its type: to be written again.
  boost::shared_ptr<const topic_tools::ShapeShifter> readAny() const;

 private:
  template <typename Message>
  boost::shared_ptr<const Message> salvage() const {
    const char* const wanted = ros::message_traits::MD5Sum<Message>::value();
    if (std::strcmp(wanted, "*") != 0 && salvaged_->connection->md5sum != wanted) return nullptr;
    const auto message = boost::make_shared<Message>();
    // Streams for reading want bytes that may be written all the same.
    ros::serialization::IStream stream(const_cast<std::uint8_t*>(bag_->data(*salvaged_)),
                                       static_cast<std::uint32_t>(salvaged_->size));
    ros::serialization::deserialize(stream, *message);
    return message;
  }

  std::shared_ptr<const rosbag::MessageInstance> indexed_;
  const SalvagedBag* bag_ = nullptr;
  const SalvagedBag::Message* salvaged_ = nullptr;
};

/// One or several bags that were recorded together, as one. rosbag reads them;
/// what it cannot read is salvaged.
class Recording {
 public:
  enum class Reader {
    kIndexed,  ///< rosbag, where it can open the file
    kSalvage   ///< also what rosbag can open: there was damage inside
  };

  /// Throws Error, naming what the file is instead, when one is no bag.
  explicit Recording(const std::vector<std::string>& paths, Reader reader = Reader::kIndexed);

  /// The names of the files.
  const std::string& name() const { return name_; }

  const BagContents& contents() const { return contents_; }

  /// Messages of some topics, in the order in which they were recorded. They live as long as this.
  std::vector<RecordedMessage> messages(const std::vector<std::string>& topics) const;

  /// What is damaged or missing, and what to do; empty: nothing.
  const std::string& damage() const { return damage_; }

 private:
  void open(const std::string& path, Reader reader);
  void salvage(const std::string& path, const std::string& fault);

  std::string name_;
  std::vector<std::unique_ptr<rosbag::Bag>> bags_;
  std::vector<std::unique_ptr<SalvagedBag>> salvaged_;
  BagContents contents_;
  std::string damage_;
};

}  // namespace mivo
