// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace mivo {

/// A folder with a short sequence and a control file for the virtual camera, which is plugged in.
class VirtualXtionTest : public ::testing::Test {
 protected:
  static constexpr int kFrames = 12;

  void SetUp() override {
    char name[] = "/tmp/mivo_virtual_XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder_ = name;
    writeSequence();
    control_["folder"] = folder_;
    writeControl();
    setenv("MIVO_VIRTUAL_XTION", controlPath().c_str(), 1);
  }

  void TearDown() override {
    unsetenv("MIVO_VIRTUAL_XTION");
    std::filesystem::remove_all(folder_);
  }

  template <typename Value>
  void control(const std::string& name, const Value& value) {
    std::ostringstream text;
    text << value;
    control_[name] = text.str();
    writeControl();
  }

  /// The sequence plays from its second image on.
  void play() { control("until", kFrames - 1); }

  std::string truthPath() const { return folder_ + "/truth.txt"; }

  // Every image differs from every other, and no two rows or columns are alike.
  static cv::Mat colorImage(int i) {
    cv::Mat image(480, 640, CV_8UC3);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        image.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(x / 4 + i),
                                     static_cast<std::uint8_t>(y / 2),
                                     static_cast<std::uint8_t>((x * y + 7 * i) % 251)};
      }
    }
    return image;
  }
  static cv::Mat depthImage(int i) {
    cv::Mat image(480, 640, CV_16UC1);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        image.at<std::uint16_t>(y, x) =
            static_cast<std::uint16_t>((x + y) % 50 == 0 ? 0 : 1000 + 3 * x + y + 10 * i);
      }
    }
    return image;
  }

  std::string folder_;

 private:
  std::string controlPath() const { return folder_ + "/control.txt"; }

  void writeControl() {
    const std::string path = controlPath();
    {
      std::ofstream file(path + ".new");
      for (const auto& [name, value] : control_) {
        file << name << ' ' << value << '\n';
      }
    }
    std::rename((path + ".new").c_str(), path.c_str());
  }

  void writeSequence() {
    std::filesystem::create_directory(folder_ + "/rgb");
    std::filesystem::create_directory(folder_ + "/depth");
    std::ofstream rgb(folder_ + "/rgb.txt");
    std::ofstream depth(folder_ + "/depth.txt");
    std::ofstream(folder_ + "/camera.txt") << "# width height fx fy cx cy units\n"
                                           << "640 480 525 525 319.5 239.5 1000\n";
    for (int i = 0; i < kFrames; ++i) {
      char stamp[32];
      std::snprintf(stamp, sizeof(stamp), "%.6f", 100.0 + i / 30.0);
      const std::string file = std::string(stamp) + ".png";
      cv::Mat bgr(480, 640, CV_8UC3);
      cv::mixChannels({colorImage(i)}, {bgr}, {0, 2, 1, 1, 2, 0});
      ASSERT_TRUE(cv::imwrite(folder_ + "/rgb/" + file, bgr));
      ASSERT_TRUE(cv::imwrite(folder_ + "/depth/" + file, depthImage(i)));
      rgb << stamp << " rgb/" << file << '\n';
      depth << stamp << " depth/" << file << '\n';
    }
  }

  std::map<std::string, std::string> control_;
};

}  // namespace mivo
