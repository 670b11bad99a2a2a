// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/camera_file.h"

#include <fmt/format.h>

#include <cmath>

#include "io/table_reader.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

const char* const kFormat =
    "width height fx fy cx cy depth_units_per_meter [k1 k2 p1 p2 k3 [k4 k5 k6] | equidistant k1 k2 "
    "k3 k4]";
constexpr std::size_t kPinholeFields = 7;
constexpr std::size_t kDistortedFields = 12;
constexpr std::size_t kRationalFields = 15;
const char* const kEquidistant = "equidistant";
constexpr int kMaxSize = 65536;  // pixels; a larger number is a mistake and would not fit

int size(const TableReader& table, std::size_t field) {
  const double value = table.number(field);
  if (value != std::floor(value) || value < 1.0 || value > kMaxSize) {
    table.refuse("'" + table.text(field) + "' is no image size in pixels");
  }
  return static_cast<int>(value);
}

Distortion lens(const TableReader& table) {
  const auto k = [&](std::size_t i) { return table.number(kPinholeFields + i); };
  if (table.text(kPinholeFields) == kEquidistant) {
    return {k(1), k(2), 0.0, 0.0, k(3), k(4), 0.0, 0.0, LensModel::kEquidistant};
  }
  Distortion polynomial = {k(0), k(1), k(2), k(3), k(4)};
  if (table.size() == kRationalFields) {
    polynomial.k4 = k(5);
    polynomial.k5 = k(6);
    polynomial.k6 = k(7);
  }
  return polynomial;
}

std::string lensText(const Distortion& d) {
  if (d.isZero()) return {};
  if (d.model == LensModel::kEquidistant) {
    return fmt::format(" {} {:.17g} {:.17g} {:.17g} {:.17g}", kEquidistant, d.k1, d.k2, d.k3, d.k4);
  }
  std::string text =
      fmt::format(" {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", d.k1, d.k2, d.p1, d.p2, d.k3);
  if (d.isRational()) text += fmt::format(" {:.17g} {:.17g} {:.17g}", d.k4, d.k5, d.k6);
  return text;
}

}  // namespace

SequenceCamera readCamera(const std::string& path) {
  TableReader table(path);
  if (!table.next()) throw Error(path + " has no line '" + std::string(kFormat) + "'");
  if (table.size() != kPinholeFields && table.size() != kDistortedFields &&
      table.size() != kRationalFields) {
    table.refuse(fmt::format("expected 7, 12 or 15 numbers '{}', found {}", kFormat, table.size()));
  }
  SequenceCamera result;
  Camera& camera = result.camera;
  camera.width = size(table, 0);
  camera.height = size(table, 1);
  camera.fx = table.number(2);
  camera.fy = table.number(3);
  camera.cx = table.number(4);
  camera.cy = table.number(5);
  result.depth_units_per_meter = table.number(6);
  if (table.size() > kPinholeFields) camera.distortion = lens(table);
  if (camera.fy < 0.0) {
    table.refuse(fmt::format(
        "fy is {:g}: ICL-NUIM, among others, gives it so for a y axis that points up, with images "
        "that lie as all do. Write {:g}; in the true poses ty, qx and qz change their signs then",
        camera.fy, -camera.fy));
  }
  if (!(result.depth_units_per_meter > 0.0)) table.refuse("depth_units_per_meter is not positive");
  try {
    camera.validate();
  } catch (const Error& error) {
    table.refuse(error.what());
  }
  if (table.next()) table.refuse("a second camera; one line is expected");
  return result;
}

void writeCamera(const std::string& path, const SequenceCamera& camera, Overwrite overwrite) {
  const Camera& c = camera.camera;
  const std::string text =
      fmt::format("# {}\n{} {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", kFormat, c.width, c.height,
                  c.fx, c.fy, c.cx, c.cy, camera.depth_units_per_meter);
  OutputFile(path, overwrite).write(text + lensText(c.distortion) + "\n");
}

std::optional<SequenceCamera> tumCamera(const std::string& folder_name) {
  // https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats, section on calibration. The
  // images of freiburg3 have been undistorted by the publishers.
  constexpr int kWidth = 640;
  constexpr int kHeight = 480;
  constexpr double kUnitsPerMeter = 5000.0;
  const auto has = [&](const char* name) { return folder_name.find(name) != std::string::npos; };
  if (has("freiburg1")) {
    return SequenceCamera{
        {kWidth, kHeight, 517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}},
        kUnitsPerMeter};
  }
  if (has("freiburg2")) {
    return SequenceCamera{
        {kWidth, kHeight, 520.9, 521.0, 325.1, 249.7, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}},
        kUnitsPerMeter};
  }
  if (has("freiburg3")) {
    return SequenceCamera{{kWidth, kHeight, 535.4, 539.2, 320.1, 247.6, {}}, kUnitsPerMeter};
  }
  return std::nullopt;
}

}  // namespace mivo
