// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "io/sequence_writer.h"
#include "mivo/core/error.h"
#include "programs/bag_options.h"
#include "programs/command_line.h"
#include "programs/progress_bar.h"
#include "ros/bag_source.h"

namespace {

/// Gray stays as it is; color with blue first, as image files are written, and of 16 bits as the
/// gray that the tracker sees.
cv::Mat toBgr(mivo::BagSource& source, const mivo::ColorImage& color) {
  if (color.image.depth() == CV_16U && color.image.channels() > 1) return source.toGray(color);
  const bool rgb = color.order == mivo::ChannelOrder::kRgb;
  cv::Mat image = color.image;
  if (image.channels() == 3 && rgb) cv::cvtColor(color.image, image, cv::COLOR_RGB2BGR);
  if (image.channels() == 4) {
    cv::cvtColor(color.image, image, rgb ? cv::COLOR_RGBA2BGR : cv::COLOR_BGRA2BGR);
  }
  return image;
}

void writeFrames(mivo::BagSource& source, mivo::SequenceWriter& writer) {
  mivo::ProgressBar progress(source.size());
  std::size_t written = 0;
  for (const mivo::BagSource::Pair& pair : source.pairs()) {
    try {
      const mivo::MessageImages images = source.read(pair);
      writer.writeFrame(pair.color.stamp, toBgr(source, images.color), pair.depth.stamp,
                        images.depth.image);
      ++written;
    } catch (const mivo::Error& error) {
      progress.clear();
      std::cerr << "skipped: frame of stamp " << std::to_string(pair.color.stamp) << ": "
                << error.what() << "\n";
    }
    progress.advance();
  }
  if (written == 0) throw mivo::Error("none of the frames could be written");
}

void run(int argc, char** argv) {
  namespace po = boost::program_options;
  std::vector<std::string> bags;
  std::string folder;
  mivo::RgbdTopics topics;
  bool force = false;
  mivo::CommandLine line(
      "bag_to_sequence",
      "Converts a bag to a sequence folder. Depth in millimeters is kept, depth in "
      "meters is converted to 5000 units per meter.");
  line.arguments(
      "BAG", &bags,
      "bag with color images, depth images and camera_info; several bags are one recording");
  line.argument("FOLDER", &folder, "sequence folder to write");
  mivo::declareTopics(line, &topics);
  line.options()("force", po::bool_switch(&force), "replace an existing sequence");
  if (!line.parse(argc, argv)) return;

  mivo::BagSource source(bags, topics);
  if (!source.notice().empty()) {
    std::cerr << "bag_to_sequence: note: " << source.notice() << "\n";
  }
  mivo::SequenceWriter writer(folder, {source.camera(), source.depthUnitsPerMeter()},
                              force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo);
  writeFrames(source, writer);
  for (const mivo::StampedPose& pose : source.groundTruth()) writer.writePose(pose);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("bag_to_sequence", [&] { run(argc, argv); });
}
