// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <memory>
#include <string>

namespace mivo {

/// A bag that is written. rosbag's own closes in its destructor, where an error, such as a full
/// disk, ends the process.
class OutputBag {
 public:
  /// Creates or replaces the file. Throws Error.
  explicit OutputBag(const std::string& path);

  /// Closes the bag; what goes wrong then is not told: see close().
  ~OutputBag();
  OutputBag(const OutputBag&) = delete;
  OutputBag& operator=(const OutputBag&) = delete;

  /// The arguments of rosbag::Bag::write(). Throws Error; the bag takes no more then.
  template <typename... Arguments>
  void write(const Arguments&... arguments) {
    guarded([&] { bag_->write(arguments...); });
  }

  /// Completes the file. Throws Error when it could not be written.
  void close();

 private:
  template <typename Action>
  void guarded(const Action& action) {
    try {
      if (bag_) action();
    } catch (const rosbag::BagException& error) {
      abandon(error.what());
    }
  }
  [[noreturn]] void abandon(const std::string& fault);

  std::string path_;
  std::unique_ptr<rosbag::Bag> bag_;  // empty once it is closed or abandoned
};

}  // namespace mivo
