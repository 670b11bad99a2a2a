// SPDX-License-Identifier: BSD-3-Clause
#include "ros/output_bag.h"

#include "mivo/core/error.h"

namespace mivo {

OutputBag::OutputBag(const std::string& path) : path_(path), bag_(std::make_unique<rosbag::Bag>()) {
  guarded([&] { bag_->open(path, rosbag::bagmode::Write); });
}

OutputBag::~OutputBag() {
  try {
    close();
  } catch (const std::exception&) {
    // The caller, who did not close it, is on the way out with an error of its own.
  }
}

void OutputBag::close() {
  guarded([&] { bag_->close(); });
  bag_.reset();
}

/// A bag that could not be closed would try again in its destructor, and end the process: it is
/// left to the process' own end.
void OutputBag::abandon(const std::string& fault) {
  static_cast<void>(bag_.release());
  throw Error(path_ + " cannot be written: " + fault);
}

}  // namespace mivo
