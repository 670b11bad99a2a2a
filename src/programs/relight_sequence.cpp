// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <vector>

#include "io/image_file.h"
#include "io/sequence_listing.h"
#include "mivo/core/error.h"
#include "mivo/io/camera_file.h"
#include "mivo/io/output_file.h"
#include "mivo/io/sequence_reader.h"
#include "programs/command_line.h"
#include "programs/progress_bar.h"
#include "synthetic/relighting.h"

namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

const char* const kLists[] = {"rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt",
                              "camera.txt"};
const char* const kImageFolders[] = {"rgb", "depth"};

/// A color image: its stamp (s) and its path in the folder.
struct Image {
  double stamp;
  fs::path path;
};

/// Of a path that a list names, in the folder.
fs::path relativePath(const fs::path& folder, const std::string& listed) {
  fs::path path = fs::path(listed).lexically_normal().lexically_relative(folder.lexically_normal());
  if (path.empty() || path.is_absolute() || *path.begin() == "..") {
    throw mivo::Error("the path '" + listed + "' leaves the sequence folder");
  }
  return path;
}

/// The color images of all frames, by stamp, each once.
std::vector<Image> listColor(const fs::path& folder, const mivo::SequenceListing& listing) {
  std::vector<Image> images;
  std::set<fs::path> seen;
  for (const mivo::ListedFrame& frame : listing.frames) {
    const fs::path path = relativePath(folder, frame.image_path);
    relativePath(folder, frame.depth_path);
    if (seen.insert(path).second) images.push_back({frame.stamp, path});
  }
  return images;
}

/// The images of an earlier sequence in a folder that is to hold another one.
void removeImages(const fs::path& folder) {
  mivo::SequenceListing listing;
  try {
    listing = mivo::listSequence(folder.string());
  } catch (const mivo::Error&) {
    return;  // it holds none
  }
  for (const mivo::ListedFrame& frame : listing.frames) {
    fs::remove(folder / relativePath(folder, frame.image_path));
    fs::remove(folder / relativePath(folder, frame.depth_path));
  }
}

void prepareFolder(const fs::path& in, const fs::path& out, bool force) {
  if (fs::exists(out) && fs::equivalent(in, out)) {
    throw mivo::UsageError("IN and OUT are the same folder");
  }
  fs::create_directories(out);
  if (!force) {
    if (!fs::is_empty(out)) {
      throw mivo::Error(
          out.string() +
          " is not empty: choose another folder, or --force to replace the sequence in it");
    }
    return;
  }
  removeImages(out);
  for (const char* list : kLists) fs::remove(out / list);
  for (const char* images : kImageFolders) {
    if (!fs::is_directory(out / images)) continue;
    std::vector<fs::path> old;
    for (const fs::directory_entry& entry : fs::directory_iterator(out / images)) {
      if (entry.path().extension() == ".png") old.push_back(entry.path());
    }
    for (const fs::path& path : old) fs::remove(path);
  }
}

void copyInto(const fs::path& in, const fs::path& out, const fs::path& file) {
  if (!fs::exists(in / file)) return;  // a reader skips the frame, in the copy as in the original
  fs::create_directories((out / file).parent_path());
  fs::copy_file(in / file, out / file, fs::copy_options::overwrite_existing);
}

/// Everything but the color images: untouched, byte for byte.
void copyRest(const fs::path& in, const fs::path& out, const std::vector<Image>& color,
              const mivo::SequenceReader& reader) {
  std::set<fs::path> relit;
  for (const Image& image : color) relit.insert(image.path);
  constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
  const fs::recursive_directory_iterator end;
  for (fs::recursive_directory_iterator entry(in, kFollow); entry != end; ++entry) {
    if (entry->is_directory()) {
      if (fs::equivalent(entry->path(), out)) entry.disable_recursion_pending();
      continue;
    }
    const fs::path file = entry->path().lexically_relative(in);
    if (entry->is_regular_file() && relit.count(file) == 0) copyInto(in, out, file);
  }
  // The camera may have been known by the folder's name or by a file beside the folder, which the
  // copy does not have.
  if (!fs::exists(in / "camera.txt")) {
    mivo::writeCamera((out / "camera.txt").string(), {reader.camera(), reader.depthUnitsPerMeter()},
                      mivo::Overwrite::kYes);
  }
}

void run(int argc, char** argv) {
  std::string in;
  std::string out;
  std::string lighting;
  std::uint64_t seed = 1;
  bool force = false;
  std::string known;
  for (const std::string& name : mivo::Relighting::names())
    known += (known.empty() ? "" : ", ") + name;
  mivo::CommandLine line(
      "relight_sequence",
      "Copies a sequence folder and changes the lighting of its color images; everything else is "
      "copied unchanged.");
  line.argument("IN", &in, "sequence folder to read");
  line.argument("OUT", &out, "sequence folder to write");
  line.options()("lighting", po::value(&lighting)->required()->value_name("NAME"), known.c_str())(
      "seed", po::value(&seed)->default_value(seed)->value_name("N"),
      "seed of the noise and of the initial phase of the lights")("force", po::bool_switch(&force),
                                                                  "replace an existing sequence");
  if (!line.parse(argc, argv)) return;
  const std::vector<std::string>& names = mivo::Relighting::names();
  if (std::find(names.begin(), names.end(), lighting) == names.end()) {
    throw mivo::UsageError(
        fmt::format("--lighting: unknown '{}', expected one of {}", lighting, known));
  }

  const mivo::SequenceReader reader(in);
  if (!reader.notice().empty()) std::cerr << "relight_sequence: " << reader.notice() << "\n";
  const std::vector<Image> color = listColor(in, reader.listing());
  const std::size_t count = color.size();
  prepareFolder(in, out, force);
  copyRest(in, out, color, reader);
  const double duration = color.back().stamp - color.front().stamp;
  mivo::Relighting relighting(
      lighting,
      {static_cast<int>(count), count > 1 ? duration / static_cast<double>(count - 1) : 1.0}, seed);
  mivo::ProgressBar progress(count);
  for (const Image& image : color) {
    cv::Mat pixels;
    try {
      pixels = mivo::readImage((fs::path(in) / image.path).string());
    } catch (const mivo::Error& error) {
      progress.clear();
      std::cerr << "relight_sequence: copied unchanged: " << error.what() << "\n";
      copyInto(in, out, image.path);
      relighting.skip();
      progress.advance();
      continue;
    }
    fs::create_directories((fs::path(out) / image.path).parent_path());
    mivo::writePng((fs::path(out) / image.path).string(), relighting.relight(pixels),
                   mivo::Overwrite::kYes);
    progress.advance();
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("relight_sequence", [&] { run(argc, argv); });
}
