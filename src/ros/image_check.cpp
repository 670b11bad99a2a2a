// SPDX-License-Identifier: BSD-3-Clause
#include "ros/image_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "session/depth_sample.h"

namespace mivo {
namespace {

// Of the nearer reading: a step in depth that is the edge of something.
constexpr float kDepthStep = 0.08F;
// Gray levels per pixel: one strong edge counts no more than this.
constexpr int kMostGradient = 40;
constexpr std::size_t kEnoughEdges = 500;
// Mean gradient at the best shift over that at all: less is chance.
constexpr double kClearPeak = 1.3;

cv::Mat meters(const Frame& frame) {
  cv::Mat depth;
  frame.depth.convertTo(depth, CV_32FC1, frame.depth.type() == CV_16UC1 ? frame.depth_unit : 1.0);
  return depth;
}

}  // namespace

FrameLook lookAt(const Frame& frame) {
  FrameLook look;
  look.stamp = frame.stamp;
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(frame.image, mean, deviation);
  look.brightness = mean[0];
  cv::Mat edges;
  cv::Laplacian(frame.image, edges, CV_32F);
  cv::Scalar edge_mean;
  cv::Scalar edge_deviation;
  cv::meanStdDev(edges, edge_mean, edge_deviation);
  look.sharpness = edge_deviation[0] / std::max(1.0, deviation[0]);
  const DepthSample depth = sampleDepth(frame);
  look.depth_coverage = depth.coverage;
  look.median_depth = depth.median;
  return look;
}

void EdgeOffset::addRows(const cv::Mat& image, const cv::Mat& depth, Score& score) {
  for (int y = 0; y < depth.rows; ++y) {
    const auto* z = depth.ptr<float>(y);
    const auto* gray = image.ptr<std::uint8_t>(y);
    for (int x = kReach; x + kReach + 1 < depth.cols; ++x) {
      const float nearer = std::min(z[x], z[x + 1]);
      if (!(nearer > 0.0F) || !(std::abs(z[x + 1] - z[x]) > kDepthStep * nearer)) continue;
      if (!std::isfinite(z[x]) || !std::isfinite(z[x + 1])) continue;
      ++score.edges;
      for (int d = -kReach; d <= kReach; ++d) {
        score.sum[static_cast<std::size_t>(d + kReach)] +=
            std::min(kMostGradient, std::abs(gray[x + 1 + d] - gray[x + d]));
      }
    }
  }
}

void EdgeOffset::add(const Frame& frame) {
  const cv::Mat depth = meters(frame);
  addRows(frame.image, depth, columns_);
  addRows(frame.image.t(), depth.t(), rows_);
}

/// The highest sum over their mean.
double EdgeOffset::clarity(const Score& score) {
  const double highest = *std::max_element(score.sum.begin() + 1, score.sum.end() - 1);
  double total = 0.0;
  for (const double sum : score.sum) total += sum;
  return total > 0.0 ? highest * static_cast<double>(score.sum.size()) / total : 1.0;
}

double EdgeOffset::clarity() const {
  return std::min(clarity(columns_), clarity(rows_));
}

std::optional<double> EdgeOffset::peak(const Score& score) {
  if (score.edges < kEnoughEdges || clarity(score) < kClearPeak) return std::nullopt;
  const auto highest = std::max_element(score.sum.begin() + 1, score.sum.end() - 1);
  const double before = *(highest - 1);
  const double after = *(highest + 1);
  const double curvature = before - 2.0 * *highest + after;
  const double fraction = curvature < 0.0 ? 0.5 * (before - after) / curvature : 0.0;
  return static_cast<double>(highest - score.sum.begin()) - kReach + fraction;
}

std::optional<EdgeOffset::Shift> EdgeOffset::shift() const {
  const std::optional<double> x = peak(columns_);
  const std::optional<double> y = peak(rows_);
  if (!x || !y) return std::nullopt;
  return Shift{*x, *y};
}

}  // namespace mivo
