// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iostream>
#include <optional>
#include <string>

#include "io/pose_folder.h"
#include "mivo/core/error.h"
#include "mivo/io/sequence_reader.h"
#include "programs/command_line.h"
#include "programs/progress_bar.h"
#include "ros/bag_writer.h"

namespace {

using Status = mivo::FrameSource::Status;

/// Writes the frames that run_sequence tracks, with the stamps of color and of depth. The stamp of
/// the first one.
double writeFrames(mivo::SequenceReader& reader, mivo::BagWriter& bag) {
  mivo::ProgressBar progress(reader.size());
  mivo::SequenceImages images;
  mivo::FrameFault fault;
  std::optional<double> first_stamp;
  for (Status status; (status = reader.nextImages(images, fault)) != Status::kEnd;) {
    if (status == Status::kFrame) {
      bag.writeColor(images.stamp, images.color);
      bag.writeDepth(images.depth_stamp, images.depth);
      if (!first_stamp) first_stamp = images.stamp;
    } else {
      progress.clear();
      std::cerr << "skipped: " << fault.text << "\n";
    }
    progress.advance();
  }
  if (!first_stamp) throw mivo::Error("none of the images could be used");
  return *first_stamp;
}

/// Empty when the folder has none.
mivo::Trajectory readTruth(const std::string& folder) {
  return mivo::hasPoses(folder) ? mivo::readPoseFolder(folder).poses : mivo::Trajectory();
}

void writeTruth(const mivo::Trajectory& truth, double first_stamp, mivo::BagWriter& bag) {
  if (truth.empty()) return;
  if (!bag.writeGroundTruth(truth, first_stamp)) {
    std::cerr
        << "sequence_to_bag: note: the ground truth has no pose within 20 ms of the first image: "
           "the bag has no transform from world to odom\n";
  }
}

void tellWhatWasRead(const mivo::SequenceReader& reader) {
  if (!reader.notice().empty()) {
    std::cerr << "sequence_to_bag: note: " << reader.notice() << "\n";
  }
  for (const auto& [reason, count] : reader.leftOut()) {
    std::cerr << "sequence_to_bag: note: left out (" << reason << "): " << count << "\n";
  }
}

void run(int argc, char** argv) {
  namespace po = boost::program_options;
  std::string folder;
  std::string path;
  std::string layout_name;
  bool compressed = false;
  bool force = false;
  mivo::CommandLine line("sequence_to_bag", "Converts a sequence folder to a bag.");
  line.argument("FOLDER", &folder, "sequence folder to read");
  line.argument("BAG", &path, "bag to write");
  line.options()("layout", po::value<std::string>(&layout_name)->default_value("tum"),
                 "names and types of the topics: tum, openni2, rtabmap or realsense")(
      "compressed", po::bool_switch(&compressed),
      "write PNG images on the compressed topics; depth in millimeters")(
      "force", po::bool_switch(&force), "replace an existing bag");
  if (!line.parse(argc, argv)) return;
  const auto& layouts = mivo::bagLayouts();
  if (std::none_of(layouts.begin(), layouts.end(),
                   [&](const mivo::BagLayout& layout) { return layout.name == layout_name; })) {
    throw mivo::UsageError("--layout: '" + layout_name +
                           "' is not one of tum, openni2, rtabmap, realsense");
  }
  mivo::SequenceReader reader(folder);
  tellWhatWasRead(reader);
  const mivo::Trajectory truth = readTruth(folder);
  mivo::BagWriter bag(path, mivo::bagLayout(layout_name),
                      {reader.camera(), reader.depthUnitsPerMeter()},
                      compressed ? mivo::BagImages::kCompressed : mivo::BagImages::kRaw,
                      force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo);
  const double first_stamp = writeFrames(reader, bag);
  writeTruth(truth, first_stamp, bag);
  bag.close();
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("sequence_to_bag", [&] { run(argc, argv); });
}
