// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

namespace mivo {

/// An object for intermediate results, such as arrays. It is one that an earlier user on the same
/// thread has left behind, with its memory, so that frame after frame nothing is allocated. What it
/// holds at first is arbitrary.
template <typename Object>
class Recycled {
 public:
  Recycled() {
    std::vector<Object>& left = leftBehind();
    if (left.empty()) return;
    object_ = std::move(left.back());
    left.pop_back();
  }
  ~Recycled() {
    if (is_owner_) leftBehind().push_back(std::move(object_));
  }
  Recycled(Recycled&& other) noexcept : object_(std::move(other.object_)) {
    other.is_owner_ = false;
  }
  Recycled(const Recycled&) = delete;
  Recycled& operator=(const Recycled&) = delete;
  Recycled& operator=(Recycled&&) = delete;

  Object& operator*() { return object_; }
  const Object& operator*() const { return object_; }
  Object* operator->() { return &object_; }
  const Object* operator->() const { return &object_; }

 private:
  static std::vector<Object>& leftBehind() {
    thread_local std::vector<Object> objects;
    return objects;
  }
  Object object_{};
  bool is_owner_ = true;
};

}  // namespace mivo
