// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace mivo {

/// In which columns of a table the numbers of a pose stand.
struct PoseColumns {
  std::size_t count = 0;  ///< of all columns
  std::size_t stamp = 0;  ///< or its whole seconds
  std::optional<std::size_t> nanoseconds;
  std::array<std::size_t, 3> position{};    ///< x, y, z
  std::array<std::size_t, 4> quaternion{};  ///< x, y, z, w

  bool isScalarFirst() const { return quaternion[3] < quaternion[0]; }
};

/// The columns by the names of a heading, such as "timestamp tx ty tz qx qy qz qw",
/// "#timestamp, p_RS_R_x [m], ..., q_RS_w [], q_RS_x [], ..." or
/// "%time,field.pose.position.x,...,field.pose.orientation.w". Nothing when it is none, or does not
/// name all.
std::optional<PoseColumns> parseHeading(const std::string& line);

}  // namespace mivo
