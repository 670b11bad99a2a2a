// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/sequence_generator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "mivo/core/error.h"

namespace mivo {
namespace {

GeneratorOptions smallOptions() {
  GeneratorOptions options;
  options.scene = "hallway";
  options.frames = 3;
  options.camera = xtionCamera(160, 120);
  return options;
}

std::vector<SyntheticFrame> film(const GeneratorOptions& options) {
  SequenceGenerator generator(options);
  std::vector<SyntheticFrame> frames;
  while (!generator.atEnd()) frames.push_back(generator.next());
  return frames;
}

double difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF);
}

TEST(SequenceGenerator, SameBytesForAnyNumberOfThreadsAndInEveryRun) {
  GeneratorOptions options = smallOptions();
  options.lighting = "moving_lamp";  // has random shadow rays, too
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const std::vector<SyntheticFrame> one = film(options);
  cv::setNumThreads(5);
  const std::vector<SyntheticFrame> five = film(options);
  cv::setNumThreads(threads);
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(difference(one[k].color, five[k].color), 0.0) << k;
    EXPECT_EQ(difference(one[k].depth, five[k].depth), 0.0) << k;
    EXPECT_EQ(one[k].T_world_camera.matrix(), five[k].T_world_camera.matrix()) << k;
  }
}

TEST(SequenceGenerator, SeedsGiveDifferentSequences) {
  GeneratorOptions options = smallOptions();
  options.frames = 1;
  const cv::Mat first = film(options)[0].color;
  options.seed = 2;
  EXPECT_GT(
      cv::norm(first, film(options)[0].color, cv::NORM_L1) / static_cast<double>(first.total() * 3),
      10.0);
}

TEST(SequenceGenerator, StampsAndPosesBelongTogether) {
  SequenceGenerator generator(smallOptions());
  for (int k = 0; k < 3; ++k) {
    const SyntheticFrame frame = generator.next();
    EXPECT_NEAR(frame.stamp, 1.0 + k / 30.0, 1e-12);
    EXPECT_EQ(frame.T_world_camera.matrix(), generator.path().poseAt(k / 30.0).matrix());
    EXPECT_EQ(frame.depth.type(), CV_16UC1);
    EXPECT_EQ(frame.color.size(), cv::Size(160, 120));
    EXPECT_TRUE(frame.right.empty());
  }
  EXPECT_TRUE(generator.atEnd());
}

TEST(SequenceGenerator, FirstFrameIsMetered) {
  for (const std::string& scene : sceneNames()) {
    GeneratorOptions options = smallOptions();
    options.scene = scene;
    options.frames = 1;
    EXPECT_NEAR(meanGray(film(options)[0].color), 110.0, 4.0) << scene;
  }
}

// Each row of a rolling shutter is the row of a global shutter at that row's time, byte for byte.
TEST(SequenceGenerator, RowsOfARollingShutterSeeTheirOwnTime) {
  GeneratorOptions options = smallOptions();
  options.trajectory = "fast_rotation";
  const SequenceGenerator generator(options);
  const Renderer& renderer = generator.renderer();
  const SceneLighting lighting("oscillating", {30, 1.0 / 30.0}, renderer.scene());
  const PoseAtTime pose = [&](double t) { return generator.path().poseAt(t); };
  const LightAtTime light = [&](double t) { return lighting.at(t); };
  Shutter rolling;
  rolling.mid_time = 0.4;
  rolling.exposure = 0.01;
  rolling.readout = 0.025;
  rolling.samples = 3;
  const cv::Mat image = renderer.renderColor(pose, light, rolling);
  const SurfaceImage surface =
      renderer.renderSurface(pose, light, rolling, Eigen::Vector2f::Zero());
  for (const int row : {0, 31, 60, 119}) {
    Shutter global = rolling;
    global.readout = 0.0;
    global.mid_time = 0.4 + ((row + 0.5) / 120 - 0.5) * 0.025;
    EXPECT_EQ(difference(image.row(row), renderer.renderColor(pose, light, global).row(row)), 0.0)
        << row;
    EXPECT_EQ(
        difference(
            surface.depth.row(row),
            renderer.renderSurface(pose, light, global, Eigen::Vector2f::Zero()).depth.row(row)),
        0.0)
        << row;
  }
  Shutter wrong = rolling;
  wrong.readout = 0.0;
  EXPECT_GT(difference(image.row(0), renderer.renderColor(pose, light, wrong).row(0)), 0.0);
}

TEST(SequenceGenerator, MotionBlurIsTheMeanOverTheExposure) {
  const SequenceGenerator generator(smallOptions());
  const Renderer& renderer = generator.renderer();
  const SceneLighting lighting("constant", {30, 1.0 / 30.0}, renderer.scene());
  const LightAtTime light = [&](double t) { return lighting.at(t); };
  // A sideways shift by three pixels at the wall's depth, against three still images shifted by
  // one.
  const auto still = [&](double shift) {
    Shutter sharp;
    return renderer.renderColor(
        [&](double) {
          return generator.path().poseAt(0.0) * Eigen::Translation3d(shift, 0.0, 0.0);
        },
        light, sharp);
  };
  Shutter blurred;
  blurred.exposure = 0.3;
  blurred.samples = 3;
  const cv::Mat image = renderer.renderColor(
      [&](double t) {
        return generator.path().poseAt(0.0) * Eigen::Translation3d(0.4 * t, 0.0, 0.0);
      },
      light, blurred);
  const cv::Mat mean = (still(-0.04) + still(0.0) + still(0.04)) / 3.0;
  // The samples also spread over the pixel, hence the tolerance: far below what blur changes.
  const double error = cv::norm(image, mean, cv::NORM_L1);
  EXPECT_LT(error, 0.5 * cv::norm(image, still(0.0), cv::NORM_L1));
}

TEST(SequenceGenerator, TheLensBlursTheLight) {
  GeneratorOptions options = smallOptions();
  options.scene = "stripes";
  options.frames = 1;
  options.sensor.makeIdeal();
  options.sensor.gain = 0.7;  // nothing is clipped
  options.sensor.imager.transfer = Transfer::kLinear;
  const cv::Mat sharp = film(options)[0].color;
  options.sensor.lens_blur = 1.5;
  cv::Mat expected;
  cv::GaussianBlur(sharp, expected, cv::Size(), 1.5, 1.5, cv::BORDER_REPLICATE);
  EXPECT_LE(difference(film(options)[0].color, expected), 2.0);
  EXPECT_GT(difference(sharp, expected), 20.0);
}

TEST(SequenceGenerator, OnlyBlindFramesLoseTheTexture) {
  GeneratorOptions options = smallOptions();
  options.scene = "blank";
  options.trajectory = "slide";
  options.sensor.makeIdeal();
  options.frames = 4;
  options.blind_from = 1;
  options.blind_frames = 2;
  const std::vector<SyntheticFrame> frames = film(options);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    double low = 0.0;
    double high = 0.0;
    cv::minMaxLoc(frames[k].color.reshape(1), &low, &high);
    EXPECT_EQ(high - low > 50.0, k == 0 || k == 3) << k << ": " << low << " to " << high;
  }
  options.blind_frames = 0;  // blind throughout; the same surface and path
  const std::vector<SyntheticFrame> blind = film(options);
  EXPECT_EQ(difference(blind[0].depth, frames[0].depth), 0.0);
  options.scene = "wall";
  options.blind_frames = 2;
  EXPECT_THROW(SequenceGenerator{options}, Error);
}

TEST(SequenceGenerator, APaceIsPositiveAndNotAbsurd) {
  GeneratorOptions options = smallOptions();
  for (const double pace : {0.0, -1.0, std::nan(""), 21.0}) {
    options.pace = pace;
    EXPECT_THROW(SequenceGenerator{options}, Error) << pace;
  }
}

TEST(SequenceGenerator, RightCameraSeesTheDisparity) {
  GeneratorOptions options = smallOptions();
  options.frames = 1;
  options.trajectory = "static";
  options.sensor.makeIdeal();
  options.sensor.stereo_baseline = 0.1;
  const SyntheticFrame frame = film(options)[0];
  ASSERT_EQ(frame.right.size(), frame.color.size());
  double matched = 0.0;
  double unmatched = 0.0;
  for (int y = 5; y < 115; ++y) {
    for (int x = 30; x < 150; ++x) {
      const double disparity = options.camera.fx * 0.1 / frame.exact_depth.at<float>(y, x);
      const double u = x - disparity;
      const int u0 = static_cast<int>(std::floor(u));
      if (u0 < 0) continue;
      const double a = u - u0;
      const double there = (1 - a) * frame.right.at<cv::Vec3b>(y, u0)[1] +
                           a * frame.right.at<cv::Vec3b>(y, u0 + 1)[1];
      matched += std::abs(there - frame.color.at<cv::Vec3b>(y, x)[1]);
      unmatched +=
          std::abs(frame.right.at<cv::Vec3b>(y, x)[1] - frame.color.at<cv::Vec3b>(y, x)[1]);
    }
  }
  EXPECT_LT(matched, 0.35 * unmatched);
}

TEST(SequenceGenerator, DepthOffsetShiftsTheDepthImage) {
  GeneratorOptions options = smallOptions();
  options.frames = 1;
  options.sensor.makeIdeal();
  const cv::Mat exact = film(options)[0].depth;
  options.sensor.depth_offset = {3.0, 2.0};
  const cv::Mat shifted = film(options)[0].depth;
  // Pixel p has the value of p + offset, up to the rounding of a unit.
  EXPECT_LE(difference(shifted(cv::Rect(0, 0, 157, 118)), exact(cv::Rect(3, 2, 157, 118))), 1.0);
}

TEST(SequenceGenerator, DepthIsTakenLaterByItsTimeOffset) {
  GeneratorOptions options = smallOptions();
  options.frames = 2;
  options.sensor.makeIdeal();
  const std::vector<SyntheticFrame> together = film(options);
  // A whole frame period later: the second frame's depth beside the first one's color.
  options.sensor.depth_time_offset = 1.0 / options.rate;
  const std::vector<SyntheticFrame> later = film(options);
  EXPECT_EQ(difference(later[0].exact_depth, together[1].exact_depth), 0.0);
  EXPECT_EQ(difference(later[0].color, together[0].color), 0.0);
  EXPECT_GT(difference(later[0].exact_depth, together[0].exact_depth), 0.0);
  options.sensor.depth_time_offset = -1.0 / options.rate;
  EXPECT_EQ(difference(film(options)[1].exact_depth, together[0].exact_depth), 0.0);
  options.sensor.depth_time_offset = 0.2;
  EXPECT_THROW(SequenceGenerator{options}, Error);
}

TEST(SequenceGenerator, AutomaticExposureLagsBehindTheLight) {
  GeneratorOptions options = smallOptions();
  options.camera = xtionCamera(64, 48);
  options.trajectory = "static";
  options.lighting = "step";
  options.frames = 60;  // the light falls with frame 30
  options.sensor.exposure_control.automatic = true;
  options.sensor.exposure_control.delay = 7;
  const std::vector<SyntheticFrame> frames = film(options);
  const double before = frames[25].exposure.product();
  const double wanted = before * frames[25].lux / frames[40].lux;
  EXPECT_NEAR(frames[36].exposure.product() / before, 1.0, 0.02);
  EXPECT_GT(frames[37].exposure.product() / before, 1.5);
  EXPECT_NEAR(meanGray(frames[59].color), 110.0, 6.0);
  EXPECT_GT(frames[59].exposure.product(), 0.7 * wanted);
  EXPECT_LT(meanGray(frames[32].color), 70.0);
}

TEST(SequenceGenerator, RefusesWhatCannotBeFilmed) {
  GeneratorOptions options = smallOptions();
  options.frames = 0;
  EXPECT_THROW(SequenceGenerator{options}, Error);
  options = smallOptions();
  options.sensor.exposure_time = 0.05;  // longer than a frame
  EXPECT_THROW(SequenceGenerator{options}, Error);
  options = smallOptions();
  options.sensor.samples = 0;
  EXPECT_THROW(SequenceGenerator{options}, Error);
  options = smallOptions();
  options.lighting = "sunset";
  EXPECT_THROW(SequenceGenerator{options}, Error);
}

}  // namespace
}  // namespace mivo
