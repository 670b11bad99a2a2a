// SPDX-License-Identifier: BSD-3-Clause
#include "io/trajectory_format.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <optional>
#include <utility>

#include "io/table_reader.h"
#include "io/trajectory_heading.h"
#include "mivo/core/error.h"
#include "session/stamp_order.h"

namespace mivo {
namespace {

constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kEurocColumns = 17;  // its ground truth: velocities and biases follow
constexpr std::size_t kKittiColumns = 12;
// Files written by hand round quaternions to 3 or 4 digits; a tenth off is another quantity.
constexpr double kNormTolerance = 0.1;
// stamp > this: whole nanoseconds of today, as EuRoC has them.
constexpr double kNanosecondsOfToday = 1e17;
constexpr double kNanosecond = 1e-9;

/// Where the scalar part of a quaternion stands: qx qy qz qw, or qw qx qy qz.
enum class QuaternionOrder { kScalarLast, kScalarFirst };

/// What the records of a file are.
enum class Format { kTum, kEuroc, kKitti, kRos2, kHeading };

Eigen::Quaterniond quaternion(const TableReader& table, const std::array<std::size_t, 4>& xyzw) {
  const Eigen::Quaterniond q(table.number(xyzw[3]), table.number(xyzw[0]), table.number(xyzw[1]),
                             table.number(xyzw[2]));
  if (!(std::abs(q.norm() - 1.0) <= kNormTolerance)) {
    table.refuse(fmt::format("the quaternion has length {:.4g} instead of 1", q.norm()));
  }
  return q.normalized();
}

StampedPose poseOf(const TableReader& table, const PoseColumns& columns) {
  StampedPose pose;
  pose.stamp = table.number(columns.stamp);
  if (columns.nanoseconds) pose.stamp += kNanosecond * table.number(*columns.nanoseconds);
  const auto& p = columns.position;
  // Not by Eigen's comma initializer, which must not be left by an exception.
  pose.pose.translation() =
      Eigen::Vector3d(table.number(p[0]), table.number(p[1]), table.number(p[2]));
  pose.pose.linear() = quaternion(table, columns.quaternion).toRotationMatrix();
  return pose;
}

/// Columns from `stamp` on: the stamp, the position, the quaternion.
PoseColumns plainColumns(std::size_t count, std::size_t first_number, QuaternionOrder order) {
  PoseColumns columns;
  columns.count = count;
  const std::size_t x = first_number;
  columns.position = {x, x + 1, x + 2};
  columns.quaternion = order == QuaternionOrder::kScalarLast
                           ? std::array<std::size_t, 4>{x + 3, x + 4, x + 5, x + 6}
                           : std::array<std::size_t, 4>{x + 4, x + 5, x + 6, x + 3};
  return columns;
}

/// Three rows of a rotation and a translation.
StampedPose kittiPose(const TableReader& table, std::size_t number) {
  if (table.size() != kKittiColumns) {
    table.refuse(fmt::format("expected {} numbers, found {}", kKittiColumns, table.size()));
  }
  StampedPose pose;
  pose.stamp = static_cast<double>(number);
  Eigen::Matrix3d rotation;
  for (std::size_t i = 0; i < kKittiColumns; ++i) {
    const auto row = static_cast<Eigen::Index>(i / 4);
    const auto column = static_cast<Eigen::Index>(i % 4);
    if (column < 3) {
      rotation(row, column) = table.number(i);
    } else {
      pose.pose.translation()[row] = table.number(i);
    }
  }
  const auto nearest = nearestRotation(rotation);
  if (!nearest) {
    table.refuse("the 12 numbers are no pose: columns 1 to 3, 5 to 7 and 9 to 11 are no rotation");
  }
  pose.pose.linear() = *nearest;
  return pose;
}

/// `sec,nanosec,frame,...`: the third column is a name.
bool isRos2(const TableReader& table) {
  return table.size() >= 10 && table.isNumber(0) && table.isNumber(1) && !table.isNumber(2);
}

bool hasCommas(const TableReader& table) {
  return table.textOf(0, table.size() - 1).find(',') != std::string::npos;
}

bool isEuroc(const TableReader& table) {
  if (!hasCommas(table)) return false;
  return table.size() == kEurocColumns ||
         (table.size() == kTumColumns && table.number(0) > kNanosecondsOfToday);
}

/// Reads the records of one file, the first of which says what they are.
class TrajectoryParser {
 public:
  explicit TrajectoryParser(const std::string& path) : table_(path) {}

  TrajectoryFile read() {
    while (table_.next()) {
      if (file_.poses.empty() && !columns_ && !recognize()) continue;
      file_.poses.push_back(format_ == Format::kKitti ? kittiPose(table_, file_.poses.size())
                                                      : tablePose());
    }
    if (file_.poses.empty()) throw Error(table_.path() + " holds no pose");
    useSeconds();
    return std::move(file_);
  }

 private:
  /// By the first record, and the heading before it; false when it is the heading.
  bool recognize() {
    for (const std::string& comment : table_.comments()) {
      const auto columns = parseHeading(comment);
      if (!columns || columns->count != table_.size()) continue;
      takeHeading(*columns);
      return true;
    }
    if (!table_.isNumber(0)) {
      const auto columns = parseHeading(table_.textOf(0, table_.size() - 1));
      if (!columns) table_.refuse("expected 8 numbers 'stamp tx ty tz qx qy qz qw', found a text");
      takeHeading(*columns);
      return false;
    }
    if (isRos2(table_)) {
      takeRos2();
    } else if (isEuroc(table_)) {
      format_ = Format::kEuroc;
      columns_ = plainColumns(table_.size(), 1, QuaternionOrder::kScalarFirst);
      tell("laid out as EuRoC's: read with qw before qx");
    } else if (table_.size() == kKittiColumns) {
      format_ = Format::kKitti;
      tell("laid out as KITTI's, without stamps: its poses are numbered from 0");
    } else {
      columns_ = plainColumns(kTumColumns, 1, QuaternionOrder::kScalarLast);
      file_.is_order_assumed = true;
    }
    return true;
  }

  void takeHeading(const PoseColumns& columns) {
    format_ = Format::kHeading;
    columns_ = columns;
    if (columns.isScalarFirst()) tell("read with qw before qx, as its heading says");
  }

  /// The numbers behind the names of the frames.
  void takeRos2() {
    format_ = Format::kRos2;
    std::size_t first = 2;
    while (first < table_.size() && !table_.isNumber(first)) ++first;
    columns_ = plainColumns(table_.size(), first, QuaternionOrder::kScalarLast);
    columns_->nanoseconds = 1;
    if (first + 7 > table_.size()) table_.refuse("expected 7 numbers of a pose behind the frame");
    tell("laid out as `ros2 topic echo --csv` prints it");
  }

  StampedPose tablePose() const {
    if (table_.size() != columns_->count) {
      table_.refuse(fmt::format("expected {} numbers{}, found {}", columns_->count,
                                columns_->count == kTumColumns && !columns_->isScalarFirst()
                                    ? " 'stamp tx ty tz qx qy qz qw'"
                                    : "",
                                table_.size()));
    }
    return poseOf(table_, *columns_);
  }

  void useSeconds() {
    if (format_ == Format::kKitti || columns_->nanoseconds) return;
    std::vector<double> stamps;
    for (const StampedPose& pose : file_.poses) stamps.push_back(pose.stamp);
    const double unit = stampUnit(stamps);
    for (StampedPose& pose : file_.poses) pose.stamp *= unit;
    if (unit != 1.0 && format_ == Format::kTum) tell("its stamps are " + nameOfUnit(unit));
  }

  void tell(const std::string& text) { file_.notices.push_back(table_.path() + ": " + text); }

  TableReader table_;
  Format format_ = Format::kTum;
  std::optional<PoseColumns> columns_;
  TrajectoryFile file_;
};

}  // namespace

std::optional<Eigen::Matrix3d> nearestRotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  if (!((matrix - nearest).norm() <= kNormTolerance) || nearest.determinant() < 0.0) {
    return std::nullopt;
  }
  return nearest;
}

TrajectoryFile readTrajectoryFile(const std::string& path) {
  return TrajectoryParser(path).read();
}

}  // namespace mivo
