// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/usb_access.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace mivo {
namespace {

TEST(UsbNodeTest, UriOfAnXtionNamesItsNode) {
  EXPECT_EQ(usbNode("1d27/0601@1/5").value_or(""), "/dev/bus/usb/001/005");
  EXPECT_EQ(usbNode("1d27/0600@12/107", "/x").value_or(""), "/x/012/107");
}

TEST(UsbNodeTest, OtherUrisHaveNone) {
  for (const char* uri : {"", "Dummy", "virtual_xtion://0", "/tmp/a.oni", "1d27/0601@1",
                          "1d27/0601@1/5x", "1d27/0601@1/5/6"}) {
    EXPECT_FALSE(usbNode(uri).has_value()) << uri;
  }
}

class UsbPermissionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/mivo_usb_XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    root_ = name;
    ASSERT_EQ(chmod(name, 0755), 0);
    ASSERT_EQ(mkdir((root_ + "/001").c_str(), 0755), 0);
    node_ = root_ + "/001/005";
    std::ofstream(node_) << "node";
    ASSERT_EQ(chmod(node_.c_str(), 0444), 0);
  }
  void TearDown() override {
    unlink(node_.c_str());
    rmdir((root_ + "/001").c_str());
    rmdir(root_.c_str());
  }

  // As an ordinary user: root may write everything.
  DeviceFault classifyAsUser() const {
    const pid_t child = fork();
    if (child == 0) {
      if (geteuid() == 0 && setuid(65534) != 0) {
        _exit(255);
      }
      _exit(static_cast<int>(
          classifyOpenFailure("1d27/0601@1/5", "Failed to open the USB device!", root_)));
    }
    int status = 0;
    waitpid(child, &status, 0);
    return static_cast<DeviceFault>(WEXITSTATUS(status));
  }

  std::string root_;
  std::string node_;
};

TEST_F(UsbPermissionTest, NodeThatMayNotBeWrittenIsAMatterOfPermission) {
  EXPECT_EQ(classifyAsUser(), DeviceFault::kNoPermission);
}

TEST_F(UsbPermissionTest, NodeThatMayBeWrittenIsNot) {
  ASSERT_EQ(chmod(node_.c_str(), 0666), 0);
  EXPECT_EQ(classifyAsUser(), DeviceFault::kUsb);
}

TEST(ClassifyOpenFailureTest, SaysWhatTheSdkMeans) {
  const auto classify = [](const std::string& text) {
    return classifyOpenFailure("1d27/0601@99/99", text, "/nowhere");
  };
  EXPECT_EQ(classify("USB access is denied!"), DeviceFault::kNoPermission);
  EXPECT_EQ(classify("Could not open: Failed to set USB interface!"), DeviceFault::kInUse);
  EXPECT_EQ(classify("USB is busy!"), DeviceFault::kInUse);
  EXPECT_EQ(classify("USB transfer timeout!"), DeviceFault::kUsb);
  EXPECT_EQ(classify("DeviceOpen using default: no devices found"), DeviceFault::kNoDevice);
  EXPECT_EQ(classify("DeviceOpen: Couldn't open device 'x'"), DeviceFault::kWrongAddress);
}

TEST(DeviceErrorTest, EveryFaultSaysWhatToDo) {
  for (int i = 0; i <= static_cast<int>(DeviceFault::kUnexpected); ++i) {
    const auto fault = static_cast<DeviceFault>(i);
    EXPECT_STRNE(toString(fault), "unknown") << i;
    EXPECT_GT(std::string(adviceFor(fault)).size(), 20U) << i;
    const DeviceError error(fault, "It broke");
    EXPECT_EQ(std::string(error.what()).find("It broke. "), 0U);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace mivo
