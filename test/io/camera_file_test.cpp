// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/camera_file.h"

#include <gtest/gtest.h>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

TEST(CameraFileTest, CameraComesBackExactly) {
  const TemporaryFolder folder;
  SequenceCamera camera{{640, 480, 570.0 + 1.0 / 3.0, 571.1, 319.5, 239.5, {}}, 1000.0};
  writeCamera(folder / "camera.txt", camera, Overwrite::kNo);
  EXPECT_TRUE(readCamera(folder / "camera.txt").camera == camera.camera);
  EXPECT_EQ(readCamera(folder / "camera.txt").depth_units_per_meter, 1000.0);

  camera.camera.distortion = {0.1, -0.2, 1e-3, -1.0 / 7.0, 0.3};
  writeCamera(folder / "distorted.txt", camera, Overwrite::kNo);
  EXPECT_TRUE(readCamera(folder / "distorted.txt").camera == camera.camera);

  camera.camera.distortion = {0.6, -2.7, 5e-4, -2e-4, 1.5, 0.5, -2.6, 1.0 / 3.0};
  writeCamera(folder / "rational.txt", camera, Overwrite::kNo);
  EXPECT_TRUE(readCamera(folder / "rational.txt").camera == camera.camera);

  camera.camera.distortion = {0.1, 0.2, 0.0, 0.0, 0.3, 0.4, 0.0, 0.0, LensModel::kEquidistant};
  writeCamera(folder / "fisheye.txt", camera, Overwrite::kNo);
  EXPECT_TRUE(readCamera(folder / "fisheye.txt").camera == camera.camera);
}

TEST(CameraFileTest, ReadsTheFieldsInTheirOrder) {
  const TemporaryFolder folder;
  const SequenceCamera camera = readCamera(folder.write(
      "camera.txt", "# comment\n640 480 501 502 303 204 5000 0.01 0.02 0.003 0.004 0.05\n"));
  EXPECT_TRUE(camera.camera ==
              (Camera{640, 480, 501, 502, 303, 204, {0.01, 0.02, 0.003, 0.004, 0.05}}));
  EXPECT_EQ(camera.depth_units_per_meter, 5000.0);
}

TEST(CameraFileTest, AByteOrderMarkIsNoText) {
  const TemporaryFolder folder;
  for (const char* text : {"\xEF\xBB\xBF# comment\n640 480 500 500 320 240 5000\n",
                           "\xEF\xBB\xBF"
                           "640 480 500 500 320 240 5000\n"}) {
    EXPECT_EQ(readCamera(folder.write("camera.txt", text)).camera.width, 640);
  }
}

TEST(CameraFileTest, RefusesBadNumbersWithFileAndLine) {
  const TemporaryFolder folder;
  for (const char* line :
       {"640 480 500 500 320 240", "640 480 500 500 320 240 1000 0.1", "640 480 500 500 320 x 1000",
        "640 480 nan 500 320 240 1000", "0 480 500 500 320 240 1000",
        "640.5 480 500 500 320 240 1000", "-640 480 500 500 320 240 1000",
        "640 480 -500 500 320 240 1000", "640 480 500 500 320 240 0",
        "640 480 500 500 320 240 -1000", "1e12 480 500 500 320 240 1000"}) {
    const std::string path = folder.write("camera.txt", std::string("# comment\n") + line + "\n");
    EXPECT_EQ(errorText([&] { readCamera(path); }).find(path + ":2: "), 0U) << line;
  }
  const std::string twice =
      folder.write("camera.txt", "64 48 50 50 32 24 1000\n64 48 50 50 32 24 1000\n");
  EXPECT_EQ(errorText([&] { readCamera(twice); }).find(twice + ":2: "), 0U);
  const std::string empty = folder.write("camera.txt", "# comment\n");
  EXPECT_EQ(errorText([&] { readCamera(empty); }).find(empty), 0U);
}

TEST(CameraFileTest, KnowsThePublishedCameras) {
  EXPECT_EQ(tumCamera("rgbd_dataset_freiburg1_desk")->camera.fx, 517.3);
  EXPECT_EQ(tumCamera("rgbd_dataset_freiburg2_xyz")->camera.distortion.k3, 0.9172);
  EXPECT_TRUE(tumCamera("rgbd_dataset_freiburg3_office")->camera.distortion.isZero());
  EXPECT_EQ(tumCamera("rgbd_dataset_freiburg3_office")->depth_units_per_meter, 5000.0);
  EXPECT_FALSE(tumCamera("office"));
}

}  // namespace
}  // namespace mivo
