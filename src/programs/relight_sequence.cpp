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
#include "io/table_reader.h"
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

struct Image {
  double stamp;
  fs::path path;  // relative to the folder
};

struct Contents {
  std::vector<Image> color;  // by stamp, each once
  std::vector<fs::path> depth;
};

fs::path relativePath(const mivo::TableReader& table, std::size_t field) {
  const fs::path path = fs::path(table.text(field)).lexically_normal();
  if (path.is_absolute() || path.begin() == path.end() || *path.begin() == "..") {
    table.refuse("the path '" + table.text(field) + "' leaves the sequence folder");
  }
  return path;
}

// The images that any of the lists names.
Contents listImages(const fs::path& folder) {
  Contents contents;
  std::set<fs::path> seen;
  const auto add = [&](const char* list, std::size_t stamp_field, bool color) {
    if (!fs::exists(folder / list)) return;
    mivo::TableReader table((folder / list).string());
    while (table.next()) {
      if (table.size() < stamp_field + 2) table.refuse("expected a stamp and a path");
      const fs::path path = relativePath(table, stamp_field + 1);
      if (!seen.insert(path).second) continue;
      if (color) {
        contents.color.push_back({table.number(stamp_field), path});
      } else {
        contents.depth.push_back(path);
      }
    }
  };
  add("rgb.txt", 0, true);
  add("associations.txt", 0, true);
  add("depth.txt", 0, false);
  add("associations.txt", 2, false);
  std::stable_sort(contents.color.begin(), contents.color.end(),
                   [](const Image& a, const Image& b) { return a.stamp < b.stamp; });
  return contents;
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

// Everything but the color images: untouched, byte for byte.
void copyRest(const fs::path& in, const fs::path& out, const Contents& contents,
              const mivo::SequenceReader& reader) {
  for (const char* list : kLists) copyInto(in, out, list);
  for (const fs::path& depth : contents.depth) copyInto(in, out, depth);
  // The camera may have been known by the folder's name, which the copy does not have.
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
  const Contents contents = listImages(in);
  const std::size_t count = contents.color.size();
  prepareFolder(in, out, force);
  copyRest(in, out, contents, reader);
  const double duration = contents.color.back().stamp - contents.color.front().stamp;
  mivo::Relighting relighting(
      lighting,
      {static_cast<int>(count), count > 1 ? duration / static_cast<double>(count - 1) : 1.0}, seed);
  mivo::ProgressBar progress(count);
  for (const Image& image : contents.color) {
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
