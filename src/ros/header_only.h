// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>

namespace mivo {

/// The beginning of any message with a header: reads the header of an image without its pixels.
struct HeaderOnly {
  std_msgs::Header header;
};

}  // namespace mivo

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<mivo::HeaderOnly> {
  static const char* value() { return "*"; }  // fits every type
  static const char* value(const mivo::HeaderOnly&) { return value(); }
};

template <>
struct DataType<mivo::HeaderOnly> {
  static const char* value() { return "*"; }
  static const char* value(const mivo::HeaderOnly&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<mivo::HeaderOnly> {
  template <typename Stream>
  static void read(Stream& stream, mivo::HeaderOnly& message) {
    stream.next(message.header);
  }
};

}  // namespace serialization
}  // namespace ros
