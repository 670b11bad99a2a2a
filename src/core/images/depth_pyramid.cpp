// SPDX-License-Identifier: BSD-3-Clause
#include "core/images/depth_pyramid.h"

#include "core/kernels/kernels.h"

namespace mivo {
namespace {

void toMeters(const Frame& frame, float min_depth, float max_depth, cv::Mat& meters) {
  meters.create(frame.depth.size(), CV_32FC1);
  const kernels::DepthView depth = depthView(frame);
  for (int y = 0; y < meters.rows; ++y) {
    kernels::active().depthRow(depth, y, 0, meters.cols, min_depth, max_depth,
                               meters.ptr<float>(y));
  }
}

void reduce(const cv::Mat& fine, float ratio, cv::Mat& coarse) {
  coarse.create((fine.rows + 1) / 2, (fine.cols + 1) / 2, CV_32FC1);
  for (int y = 0; y < coarse.rows; ++y) {
    kernels::DepthRows rows{};
    for (int v = 2 * y - 1; v <= 2 * y + 1; ++v) {
      if (v < 0 || v >= fine.rows) continue;
      if (v == 2 * y) rows.middle = rows.count;
      rows.row[rows.count++] = fine.ptr<float>(v);
    }
    kernels::active().reduceDepthRow(rows, fine.cols, ratio, 0, coarse.ptr<float>(y));
  }
}

}  // namespace

kernels::DepthView depthView(const Frame& frame) {
  const auto stride = static_cast<std::ptrdiff_t>(frame.depth.step1());
  if (frame.depth.type() == CV_16UC1) {
    return {nullptr, frame.depth.ptr<std::uint16_t>(), stride,
            static_cast<float>(frame.depth_unit)};
  }
  return {frame.depth.ptr<float>(), nullptr, stride, 1.0F};
}

float depthAt(const kernels::DepthView& depth, int x, int y) {
  const std::ptrdiff_t index = y * depth.stride + x;
  const float z = depth.meters != nullptr ? depth.meters[index]
                                          : static_cast<float>(depth.steps[index]) * depth.unit;
  return z > 0.0F && z < kernels::kMaxReading ? z : 0.0F;
}

void DepthPyramid::build(const Frame& frame, int num_levels, double min_depth, double max_depth,
                         double edge_ratio) {
  levels_.resize(static_cast<std::size_t>(num_levels));
  toMeters(frame, static_cast<float>(min_depth), static_cast<float>(max_depth), levels_[0]);
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    reduce(levels_[l - 1], static_cast<float>(0.5 * edge_ratio), levels_[l]);
  }
}

}  // namespace mivo
