// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <string>
#include <vector>

#include "mivo/core/error.h"
#include "mivo/io/output_file.h"
#include "programs/bag_options.h"
#include "programs/command_line.h"
#include "programs/output_paths.h"
#include "programs/python_plot.h"
#include "ros/bag_check.h"
#include "ros/recording.h"
#include "ros/whole_copy.h"

namespace {

/// What bag.launch needs to know before anything is played.
void printTopics(const std::vector<std::string>& bags, const mivo::RgbdTopics& wanted) {
  const mivo::Recording recording(bags);
  const mivo::RgbdTopics topics = mivo::findTopics(recording.contents(), wanted);
  std::cout << "layout: " << mivo::layoutOf(topics) << "\n"
            << "rgb: " << topics.color << "\n"
            << "depth: " << topics.depth << "\n"
            << "camera_info: " << topics.camera_info << "\n"
            << "depth_info: " << topics.depth_info << "\n"
            << "other_cameras: "
            << fmt::format("{}", fmt::join(otherCameras(recording.contents(), topics), ", "))
            << "\n";
}

void run(int argc, char** argv) {
  namespace po = boost::program_options;
  std::vector<std::string> bags;
  mivo::RgbdTopics topics;
  std::string csv;
  std::string plot;
  bool force = false;
  bool topics_only = false;
  std::string copy;
  mivo::CommandLine line("check_bag",
                         "Checks the quality of a recording: rates, gaps, order and clocks of the "
                         "stamps, calibration, "
                         "registration (alignment of edges in depth and color), exposure, blur, "
                         "and coverage of depth.");
  line.arguments("BAG", &bags, "bag; several bags are one recording");
  mivo::declareTopics(line, &topics);
  line.options()("plot", po::value(&plot)->value_name("FILE"),
                 "plot as .pdf, .svg or .png (needs python3-matplotlib)")(
      "csv", po::value(&csv)->value_name("FILE.csv"), "write one row per frame")(
      "force", po::bool_switch(&force), "replace existing files")(
      "topics", po::bool_switch(&topics_only), "only print the topics and their layout")(
      "copy-damaged", po::value(&copy)->value_name("FILE.bag"),
      "only print what is damaged, and copy what is whole if anything is; for rosbag play");
  if (!line.parse(argc, argv)) return;
  if (topics_only) {
    printTopics(bags, topics);
    return;
  }
  const mivo::Overwrite overwrite = force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo;
  std::vector<mivo::NamedFile> inputs;
  for (const std::string& bag : bags) inputs.push_back({"BAG", bag});
  if (!copy.empty()) {
    mivo::requireOutputs({{"--copy-damaged", copy}}, inputs, overwrite);
    const std::string damage = mivo::copyWhenDamaged(bags, copy);
    if (!damage.empty()) std::cout << damage << "\n";
    return;
  }
  if (!plot.empty()) mivo::requirePlotEnding("--plot", plot);
  mivo::requireOutputs({{"--plot", plot}, {"--csv", csv}}, inputs, overwrite);
  const mivo::BagReport report = mivo::checkBag(bags, topics);
  print(std::cout, report);
  if (!csv.empty()) mivo::OutputFile(csv, overwrite).write(toCsv(report));
  if (!plot.empty()) mivo::plotWithPython("plot_bag", toCsv(report), plot);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("check_bag", [&] { run(argc, argv); });
}
