// SPDX-License-Identifier: BSD-3-Clause
// The core's public entry: cameras, parameters, frames, poses and stamps of any kind. Nothing may
// be thrown but for values that are documented to be refused, and every result is sound.
#include <fuzzer/FuzzedDataProvider.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <opencv2/core.hpp>

#include "fuzz/fuzz_file.h"
#include "mivo/core/odometry.h"

namespace mivo {
namespace {

using Input = FuzzedDataProvider;

constexpr int kMostFrames = 6;
constexpr double kOdd[] = {0.0,
                           -0.0,
                           1e-310,
                           1e-30,
                           1e30,
                           1e300,
                           -1.0,
                           std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()};

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "odometry_fuzz: %s\n", what);
  std::abort();
}

/// A plain number mostly.
double number(Input& input, double low, double high) {
  const bool is_odd = input.ConsumeIntegralInRange<int>(0, 15) == 0;
  return is_odd ? input.PickValueInArray(kOdd) : input.ConsumeFloatingPointInRange(low, high);
}

Camera makeCamera(Input& input) {
  Camera camera;
  camera.width = input.ConsumeIntegralInRange<int>(-1, 96);
  camera.height = input.ConsumeIntegralInRange<int>(-1, 72);
  camera.fx = number(input, 10.0, 150.0);
  camera.fy = number(input, 10.0, 150.0);
  camera.cx = number(input, 0.0, 96.0);
  camera.cy = number(input, 0.0, 72.0);
  if (!input.ConsumeBool()) return camera;
  Distortion& d = camera.distortion;
  for (double* k : {&d.k1, &d.k2, &d.p1, &d.p2, &d.k3, &d.k4, &d.k5, &d.k6}) {
    *k = number(input, -1.0, 1.0);
  }
  if (input.ConsumeBool()) d.model = LensModel::kEquidistant;
  return camera;
}

/// Up to 5 parameters with values within their ranges, or beside them.
Parameters makeParameters(Input& input) {
  Parameters parameters;
  parameters.alignment.levels = 3;
  const int changes = input.ConsumeIntegralInRange<int>(0, 5);
  for (int i = 0; i < changes; ++i) {
    const std::size_t row =
        input.ConsumeIntegralInRange<std::size_t>(0, parameterTable().size() - 1);
    const ParameterInfo& info = parameterTable()[row];
    std::string value = input.ConsumeBool() ? "true" : "false";
    if (info.type == ParameterInfo::Type::kEnum) {
      value = info.words[input.ConsumeIntegralInRange<std::size_t>(0, info.words.size() - 1)];
    } else if (info.type == ParameterInfo::Type::kInt) {
      value = std::to_string(input.ConsumeIntegralInRange<int>(static_cast<int>(info.minimum),
                                                               static_cast<int>(info.maximum)));
    } else if (info.type == ParameterInfo::Type::kDouble) {
      value = std::to_string(number(input, info.minimum, info.maximum));
    }
    expectErrorOrSuccess([&] { setParameter(parameters, info.name, value); });
  }
  return parameters;
}

/// Texture that moves with the number of the frame, or one of many faults.
cv::Mat makeImage(Input& input, const Camera& camera, int frame) {
  const int fault = input.ConsumeIntegralInRange<int>(0, 15);
  if (fault == 1) return {};
  if (fault == 2) return cv::Mat(3, 5, CV_8UC1, cv::Scalar(7));
  if (fault == 3) return cv::Mat(camera.height, camera.width, CV_8UC3, cv::Scalar(7, 8, 9));
  cv::Mat image(camera.height, camera.width, CV_8UC1);
  if (fault == 4 || fault == 5) {
    image.setTo(fault == 4 ? 0 : 255);
    return image;
  }
  const double pace = fault == 6 ? 20.0 : input.ConsumeFloatingPointInRange(-1.5, 1.5);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double u = x + pace * frame;
      const double wave = 40.0 * std::sin(0.31 * u + 0.2 * y) + 40.0 * std::sin(0.13 * u * y / 9.0);
      image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(120.0 + wave);
    }
  }
  if (fault == 7) cv::randu(image, 0, 256);
  return image;
}

cv::Mat makeDepth(Input& input, const Camera& camera) {
  const int fault = input.ConsumeIntegralInRange<int>(0, 11);
  if (fault == 1) return {};
  if (fault == 2) return cv::Mat(3, 5, CV_32FC1, cv::Scalar(1.0));
  if (fault == 3) return cv::Mat(camera.height, camera.width, CV_8UC1, cv::Scalar(1));
  if (fault == 4) {
    cv::Mat steps(camera.height, camera.width, CV_16UC1);
    cv::randu(steps, 0, 65536);
    return steps;
  }
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  const double base = number(input, 0.3, 6.0);
  const double slope = input.ConsumeFloatingPointInRange(-0.05, 0.05);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      depth.at<float>(y, x) = static_cast<float>(base + slope * x + 0.3 * std::sin(0.1 * y));
    }
  }
  const int holes = input.ConsumeIntegralInRange<int>(0, 8);
  for (int i = 0; i < holes && !depth.empty(); ++i) {
    const cv::Rect whole(0, 0, depth.cols, depth.rows);
    const int x = input.ConsumeIntegralInRange<int>(0, depth.cols - 1);
    const int y = input.ConsumeIntegralInRange<int>(0, depth.rows - 1);
    const cv::Rect hole(x, y, depth.cols / 3 + 1, depth.rows / 3 + 1);
    depth(hole & whole).setTo(input.PickValueInArray(kOdd));
  }
  return depth;
}

/// A rotation, as the type says, or not finite.
Eigen::Isometry3d makePose(Input& input) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 3; ++i) pose.translation()[i] = number(input, -1.0, 1.0);
  pose.linear() = Eigen::AngleAxisd(number(input, -0.3, 0.3), Eigen::Vector3d::UnitY()).matrix();
  return pose;
}

void check(const TrackingResult& result) {
  if (!std::isfinite(result.stamp)) fail("the stamp is not finite");
  if (!result.T_odom_camera.matrix().allFinite()) fail("the pose is not finite");
  const Eigen::Matrix3d rotation = result.T_odom_camera.linear();
  if (!(rotation * rotation.transpose()).isIdentity(1e-6)) fail("the pose is no rotation");
  if (!result.velocity.allFinite()) fail("the velocity is not finite");
  for (const Matrix6* covariance : {&result.covariance, &result.alignment_covariance}) {
    if (!covariance->allFinite()) fail("a covariance is not finite");
    if (!covariance->isApprox(covariance->transpose())) fail("a covariance is not symmetric");
    if (Eigen::LLT<Matrix6>(*covariance).info() != Eigen::Success) {
      fail("a covariance is not positive definite");
    }
  }
  for (const double value :
       {result.overlap, result.mutual_information, result.residual_scale, result.correlation,
        result.rolling_shutter_readout, result.depth_time_offset}) {
    if (!std::isfinite(value)) fail("a figure is not finite");
  }
}

void act(Input& input, Odometry& odometry) {
  switch (input.ConsumeIntegralInRange<int>(0, 11)) {
    case 0:
      expectErrorOrSuccess([&] { odometry.reset(makePose(input)); });
      break;
    case 1:
      expectErrorOrSuccess([&] { odometry.setPose(makePose(input)); });
      break;
    case 2:
      expectErrorOrSuccess([&] { odometry.setParameters(makeParameters(input)); });
      break;
    case 3:
      odometry.keyframeCloud();
      odometry.residualImage();
      odometry.keyframeImage();
      break;
    default:
      break;
  }
}

void run(Input& input) {
  cv::setRNGSeed(1);
  const Camera camera = makeCamera(input);
  Odometry odometry(camera, makeParameters(input));
  double stamp = number(input, 0.0, 2e9);
  const int frames = input.ConsumeIntegralInRange<int>(1, kMostFrames);
  for (int i = 0; i < frames; ++i) {
    act(input, odometry);
    Frame frame;
    frame.stamp = stamp += number(input, 0.0, 0.1);
    frame.image = makeImage(input, camera, i);
    frame.depth = makeDepth(input, camera);
    frame.depth_unit = number(input, 0.0001, 0.01);
    check(input.ConsumeIntegralInRange<int>(0, 3) == 0 ? odometry.process(frame, makePose(input))
                                                       : odometry.process(frame));
    if (!odometry.predictedPose(stamp).matrix().allFinite() && std::isfinite(stamp)) {
      fail("the prediction is not finite");
    }
  }
}

}  // namespace
}  // namespace mivo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  FuzzedDataProvider input(bytes, count);
  mivo::expectErrorOrSuccess([&] { mivo::run(input); });
  return 0;
}
