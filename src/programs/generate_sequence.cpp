// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/image_file.h"
#include "io/sequence_writer.h"
#include "mivo/core/error.h"
#include "mivo/io/output_file.h"
#include "programs/command_line.h"
#include "programs/progress_bar.h"
#include "synthetic/sequence_generator.h"

namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

struct Request {
  std::string folder;
  mivo::GeneratorOptions generator;
  int width = 640;
  int height = 480;
  std::string distortion;
  std::string lens = "polynomial";
  double field_of_view = 0.0;  // degrees; 0: an Xtion's
  std::vector<double> depth_offset;
  std::vector<double> blind;
  std::string transfer = "srgb";
  bool no_blur = false;
  bool no_noise = false;
  bool no_holes = false;
  bool ideal = false;
  int threads = 0;
  bool force = false;
};

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void requireName(const std::string& option, const std::string& name,
                 const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw mivo::UsageError(
        fmt::format("--{}: unknown '{}', expected one of {}", option, name, listed(known)));
  }
}

template <typename T>
po::typed_value<T>* number(T& target, const std::string& default_text) {
  return po::value(&target)->default_value(target, default_text)->value_name("N");
}

void addSequenceOptions(mivo::CommandLine& line, Request& request) {
  mivo::GeneratorOptions& g = request.generator;
  line.options()("scene", po::value(&g.scene)->default_value(g.scene)->value_name("NAME"),
                 listed(mivo::sceneNames()).c_str())(
      "trajectory", po::value(&g.trajectory)->default_value(g.trajectory)->value_name("NAME"),
      listed(mivo::CameraPath::names()).c_str())(
      "lighting", po::value(&g.lighting)->default_value(g.lighting)->value_name("NAME"),
      listed(mivo::SceneLighting::names()).c_str())("frames", number(g.frames, "150"),
                                                    "number of frames")(
      "rate", number(g.rate, "30"), "frames per second")("pace", number(g.pace, "1"),
                                                         "factor on the speed of the path")(
      "seed", number(g.seed, "1"), "seed of textures, motion and noise")(
      "width", number(request.width, "640"), "pixels")("height", number(request.height, "480"),
                                                       "pixels")(
      "blind", mivo::twoNumbers(&request.blind)->value_name("FIRST COUNT"),
      "scenes of one surface: add texture before and after these frames")(
      "lens", po::value(&request.lens)->default_value(request.lens)->value_name("NAME"),
      "polynomial (plumb_bob, rational_polynomial) or equidistant (fisheye)")(
      "distortion", po::value(&request.distortion)->value_name("K1,K2,P1,P2,K3[,K4,K5,K6]"),
      "lens distortion, five or eight numbers separated by commas without blanks, or K1,K2,K3,K4 "
      "of an equidistant lens (default: none)")(
      "field-of-view", number(request.field_of_view, "an Xtion's"),
      "horizontal, degrees, before polynomial distortion")(
      "threads", number(request.threads, "all cores"),
      "threads; the result does not depend on their number")(
      "force", po::bool_switch(&request.force), "replace an existing sequence");
}

void addColorOptions(mivo::CommandLine& line, Request& request) {
  mivo::SensorOptions& s = request.generator.sensor;
  line.options()("ideal", po::bool_switch(&request.ideal),
                 "no noise, no motion blur, no quantization of depth, no holes")(
      "exposure-time", number(s.exposure_time, "0.010"),
      "s, of the first frame (with --auto-exposure) or of all frames")(
      "gain", number(s.gain, "metered"), "fixed gain (default: metered on the first frame)")(
      "auto-exposure", po::bool_switch(&s.exposure_control.automatic),
      "adapt exposure time and gain to the images")("exposure-delay",
                                                    number(s.exposure_control.delay, "10"),
                                                    "frames until a measurement takes effect")(
      "target-gray", number(s.exposure_control.target_gray, "110"),
      "mean value targeted by metering")(
      "max-exposure-time", number(s.exposure_control.max_time, "0.030"), "s, with --auto-exposure")(
      "max-gain", number(s.exposure_control.max_gain, "16"), "with --auto-exposure")(
      "no-blur", po::bool_switch(&request.no_blur), "no motion blur")(
      "lens-blur", number(s.lens_blur, "0"), "standard deviation of a Gaussian lens blur, pixels")(
      "samples", number(s.samples, "4"), "rays per pixel; more where motion requires it")(
      "readout", number(s.readout, "0"), "s, rolling shutter: time from the first to the last row")(
      "no-noise", po::bool_switch(&request.no_noise), "no noise in color and depth")(
      "full-well", number(s.imager.full_well, "6000"), "electrons that saturate a pixel at gain 1")(
      "read-noise", number(s.imager.read_noise, "9"), "electrons")(
      "transfer", po::value(&request.transfer)->default_value("srgb")->value_name("NAME"),
      "srgb or linear")("vignetting", number(s.imager.vignetting, "0"),
                        "loss of light in the corners, 0..1")(
      "stereo", number(s.stereo_baseline, "none"),
      "baseline, m: also render a right camera, folder right and right.txt");
}

void addDepthOptions(mivo::CommandLine& line, Request& request) {
  mivo::SensorOptions& s = request.generator.sensor;
  line.options()("depth-noise", number(s.depth.noise, "0.06"),
                 "standard deviation of the disparity, pixels")(
      "disparity-step", number(s.depth.disparity_step, "0.125"), "pixels; 0: no quantization")(
      "no-holes", po::bool_switch(&request.no_holes),
      "valid depth at edges, in shadows and at grazing angles")(
      "min-depth", number(s.depth.min_depth, "0.4"), "m")(
      "max-depth", number(s.depth.max_depth, "5"), "m")("depth-units",
                                                        number(s.depth.units_per_meter, "5000"),
                                                        "units per meter in the depth images")(
      "depth-offset", mivo::twoNumbers(&request.depth_offset)->value_name("X Y"),
      "error of the depth registration, pixels (default: none)")(
      "depth-time-offset", number(s.depth_time_offset, "0"),
      "s, by which depth is taken later than color; negative: earlier");
}

std::vector<double> parseNumbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, ',');) {
    std::istringstream number(field);
    double value = 0.0;
    if (!(number >> value) || !number.eof()) {
      throw mivo::UsageError("--distortion: '" + field + "' is not a number");
    }
    numbers.push_back(value);
  }
  return numbers;
}

mivo::Distortion parseDistortion(const std::string& text, bool equidistant) {
  std::vector<double> d = parseNumbers(text);
  mivo::Distortion lens;
  if (equidistant) {
    if (!d.empty() && d.size() != 4) {
      throw mivo::UsageError("--distortion of an equidistant lens needs four numbers: k1,k2,k3,k4");
    }
    d.resize(4);
    lens.model = mivo::LensModel::kEquidistant;
    lens.k1 = d[0];
    lens.k2 = d[1];
    lens.k3 = d[2];
    lens.k4 = d[3];
    return lens;
  }
  if (!d.empty() && d.size() != 5 && d.size() != 8) {
    throw mivo::UsageError(
        "--distortion needs five numbers, k1,k2,p1,p2,k3, or eight with "
        "k4,k5,k6");
  }
  d.resize(8);
  return {d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]};
}

void setLens(const Request& request, mivo::Camera& camera) {
  const bool equidistant = request.lens == "equidistant";
  camera.distortion = parseDistortion(request.distortion, equidistant);
  const double degrees = request.field_of_view;
  if (degrees == 0.0) return;
  if (!(degrees >= 10.0 && degrees < (equidistant ? 180.0 : 170.0))) {
    throw mivo::UsageError("--field-of-view: degrees of a lens that there is are needed");
  }
  const double edge = 0.5 * degrees * M_PI / 180.0;  // rad, of the ray at the image's side
  const double radius = equidistant ? camera.distort({std::tan(edge), 0.0}).x() : std::tan(edge);
  camera.fx = camera.fy = 0.5 * camera.width / radius;
}

int wholeNumber(const std::string& option, double value) {
  if (value != std::floor(value) || std::abs(value) > 1e9) {
    throw mivo::UsageError(fmt::format("--{}: {} is not a whole number", option, value));
  }
  return static_cast<int>(value);
}

mivo::GeneratorOptions generatorOptions(Request& request, const mivo::CommandLine& line) {
  mivo::GeneratorOptions& g = request.generator;
  requireName("scene", g.scene, mivo::sceneNames());
  requireName("trajectory", g.trajectory, mivo::CameraPath::names());
  requireName("lighting", g.lighting, mivo::SceneLighting::names());
  requireName("transfer", request.transfer, {"srgb", "linear"});
  if (request.width < 16 || request.height < 16)
    throw mivo::UsageError("images must be at least 16 x 16");
  if (request.threads < 0) throw mivo::UsageError("--threads must not be negative");
  g.camera = mivo::xtionCamera(request.width, request.height);
  requireName("lens", request.lens, {"polynomial", "equidistant"});
  setLens(request, g.camera);
  if (!request.blind.empty()) {
    g.blind_from = wholeNumber("blind", request.blind[0]);
    g.blind_frames = wholeNumber("blind", request.blind[1]);
  }
  if (!request.depth_offset.empty())
    g.sensor.depth_offset = {request.depth_offset[0], request.depth_offset[1]};
  g.sensor.imager.transfer =
      request.transfer == "linear" ? mivo::Transfer::kLinear : mivo::Transfer::kSrgb;
  if (request.no_noise) {
    g.sensor.imager.noise = false;
    g.sensor.depth.noise = 0.0;
  }
  if (request.no_blur) g.sensor.motion_blur = false;
  if (request.no_holes) g.sensor.depth.holes = false;
  if (request.ideal) {
    for (const char* option : {"depth-noise", "disparity-step"}) {
      if (line.has(option))
        throw mivo::UsageError(fmt::format("--ideal and --{} exclude each other", option));
    }
    g.sensor.makeIdeal();
  }
  return g;
}

// What a sequence folder has beyond SequenceWriter's files: the light and exposure of each frame,
// and the images of the right camera.
class Extras {
 public:
  Extras(const Request& request, mivo::Overwrite overwrite)
      : folder_(request.folder), exposures_(path("exposure.txt"), overwrite) {
    exposures_.write("# stamp lux exposure_time gain\n");
    const double baseline = request.generator.sensor.stereo_baseline;
    if (baseline <= 0.0) return;
    if (overwrite == mivo::Overwrite::kYes) fs::remove_all(path("right"));
    fs::create_directories(path("right"));
    right_.emplace(path("right.txt"), overwrite);
    right_->write(fmt::format("# baseline {} m; stamp path\n", baseline));
  }

  void write(const mivo::SyntheticFrame& frame) {
    exposures_.write(fmt::format("{:.6f} {:.4f} {:.6f} {:.4f}\n", frame.stamp, frame.lux,
                                 frame.exposure.time, frame.exposure.gain));
    if (!right_) return;
    const std::string name = fmt::format("right/{:.6f}.png", frame.stamp);
    mivo::writePng(path(name), frame.right, mivo::Overwrite::kNo);
    right_->write(fmt::format("{:.6f} {}\n", frame.stamp, name));
  }

 private:
  std::string path(const std::string& name) const { return (fs::path(folder_) / name).string(); }

  std::string folder_;
  mivo::OutputFile exposures_;
  std::optional<mivo::OutputFile> right_;
};

void run(int argc, char** argv) {
  Request request;
  mivo::CommandLine line(
      "generate_sequence",
      "Renders a synthetic scene seen by an RGB-D camera with known poses, and writes a sequence "
      "folder.");
  line.argument("FOLDER", &request.folder, "sequence folder to write");
  addSequenceOptions(line, request);
  addColorOptions(line, request);
  addDepthOptions(line, request);
  if (!line.parse(argc, argv)) return;
  const mivo::GeneratorOptions options = generatorOptions(request, line);
  if (request.threads > 0) {
    cv::setNumThreads(std::min(request.threads, cv::getNumberOfCPUs()));
  }

  const mivo::Overwrite overwrite = request.force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo;
  std::unique_ptr<mivo::SequenceGenerator> generator;
  try {
    generator = std::make_unique<mivo::SequenceGenerator>(options);
  } catch (const mivo::Error& error) {
    throw mivo::UsageError(error.what());  // all it depends on are options
  }
  mivo::SequenceWriter writer(request.folder,
                              {options.camera, options.sensor.depth.units_per_meter}, overwrite);
  Extras extras(request, overwrite);
  mivo::ProgressBar progress(static_cast<std::size_t>(options.frames));
  // A frame is compressed and written while the next one is drawn.
  std::future<void> writing;
  while (!generator->atEnd()) {
    mivo::SyntheticFrame frame = generator->next();
    if (writing.valid()) writing.get();
    writing = std::async(std::launch::async, [&writer, &extras, frame = std::move(frame)] {
      writer.writeFrame(frame.stamp, frame.color, frame.stamp, frame.depth);
      writer.writePose({frame.stamp, frame.T_world_camera});
      extras.write(frame);
    });
    progress.advance();
  }
  if (writing.valid()) writing.get();
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("generate_sequence", [&] { run(argc, argv); });
}
