// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <opencv2/core.hpp>
#include <string>

#include "core/keyframe/keyframe.h"
#include "io/image_file.h"
#include "mivo/core/error.h"
#include "mivo/core/odometry.h"
#include "mivo/io/sequence_reader.h"
#include "parameter_options.h"
#include "programs/command_line.h"

// What the tracker sees at one frame (paper, Figs. 1, 2, 4 and 6).

namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

constexpr float kFarthest = 5.0F;  // m, black in the picture of depth

/// Near is bright, no reading is black.
cv::Mat drawDepth(const cv::Mat& depth) {
  cv::Mat picture(depth.size(), CV_8UC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float meters = depth.at<float>(y, x);
      const float nearness = meters > 0.0F ? std::max(0.0F, 1.0F - meters / kFarthest) : 0.0F;
      picture.at<unsigned char>(y, x) = static_cast<unsigned char>(255.0F * nearness);
    }
  }
  return picture;
}

/// Black where a point of level 0 was selected.
cv::Mat drawPoints(const mivo::Keyframe& keyframe) {
  cv::Mat picture(keyframe.image().size(), CV_8UC1, cv::Scalar(255));
  for (const mivo::Pixel& pixel : keyframe.level(0).points.pixels) {
    picture.at<unsigned char>(pixel.y, pixel.x) = 0;
  }
  return picture;
}

void run(int argc, char** argv) {
  std::string sequence;
  std::string folder;
  long long number = 0;
  bool force = false;
  mivo::ParameterOptions parameter_options;
  mivo::CommandLine line("tracking_pictures",
                         "Tracks a sequence up to a frame and writes what the tracker sees there: "
                         "keyframe.png, depth.png, points.png, live.png, residual.png.");
  line.argument("SEQUENCE", &sequence, "sequence folder");
  line.argument("FOLDER", &folder, "where the pictures go");
  line.options()(
      "frame", po::value(&number)->value_name("N"),
      "number of the frame, or if that becomes a keyframe itself, the next one (required)")(
      "force", po::bool_switch(&force), "replace existing pictures");
  parameter_options.declare(line);
  if (!line.parse(argc, argv)) return;
  if (number < 1) throw mivo::UsageError("--frame must be 1 at least: frame 0 is the keyframe");

  const mivo::Parameters parameters = parameter_options.parameters();
  mivo::SequenceReader reader(sequence);
  mivo::Odometry odometry(reader.camera(), parameters);
  mivo::Frame frame;
  mivo::Frame keyframe_frame;
  mivo::FrameFault fault;
  long long i = 0;
  for (bool found = false; !found;) {
    const auto status = reader.next(frame, fault);
    if (status == mivo::FrameSource::Status::kEnd) {
      throw mivo::Error(sequence + " has no frame from number " + std::to_string(number) +
                        " on that is tracked against an earlier one");
    }
    if (status == mivo::FrameSource::Status::kSkipped) continue;
    if (odometry.process(frame).new_keyframe) {
      keyframe_frame = frame;
      keyframe_frame.image = frame.image.clone();
      keyframe_frame.depth = frame.depth.clone();
    } else {
      found = i >= number && odometry.hasKeyframe();
    }
    if (!found) ++i;
  }

  mivo::FramePyramid pyramid;
  pyramid.build(keyframe_frame, parameters);
  mivo::Keyframe keyframe;
  keyframe.build(pyramid, reader.camera(), mivo::Vector6::Zero(), {}, parameters);
  fs::create_directories(folder);
  const mivo::Overwrite overwrite = force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo;
  const auto write = [&](const char* name, const cv::Mat& picture) {
    mivo::writePng((fs::path(folder) / name).string(), picture, overwrite);
  };
  write("keyframe.png", odometry.keyframeImage());
  write("depth.png", drawDepth(keyframe.depth()));
  write("points.png", drawPoints(keyframe));
  write("live.png", frame.image);
  write("residual.png", odometry.residualImage());
  std::cout << "frame: " << i << "\n"
            << "state: " << mivo::toString(odometry.result().state) << "\n"
            << "points: " << keyframe.numPoints() << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("tracking_pictures", [&] { run(argc, argv); });
}
