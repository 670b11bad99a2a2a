// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/sequence_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/camera_doubt.h"
#include "io/depth_coding.h"
#include "io/image_file.h"
#include "io/sequence_listing.h"
#include "mivo/core/error.h"
#include "session/depth_enlargement.h"
#include "session/gray_range.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

/// The text without what differs from frame to frame.
std::string withoutPath(std::string text, const std::string& path, const char* name) {
  const std::size_t begin = text.find(path);
  return begin == std::string::npos ? text : text.replace(begin, path.size(), name);
}

std::string sizeText(const cv::Size& size) {
  return fmt::format("{}x{}", size.width, size.height);
}

cv::Size sizeOf(const Camera& camera) {
  return {camera.width, camera.height};
}

/// The camera of the same images at another size; pixel centers are at whole numbers.
Camera resized(const Camera& camera, const cv::Size& size) {
  Camera result = camera;
  const double x = static_cast<double>(size.width) / camera.width;
  const double y = static_cast<double>(size.height) / camera.height;
  result.width = size.width;
  result.height = size.height;
  result.fx *= x;
  result.fy *= y;
  result.cx = (camera.cx + 0.5) * x - 0.5;
  result.cy = (camera.cy + 0.5) * y - 0.5;
  return result;
}

SequenceListing list(const std::string& folder) {
  try {
    return listSequence(folder);
  } catch (const fs::filesystem_error& error) {
    throw Error("cannot read " + error.path1().string() + ": " + error.code().message());
  }
}

/// Says so when the times between images cannot be seconds.
void doubtInterval(SequenceListing& listing) {
  constexpr double kLongest = 10.0;  // s, at the median; nothing that far apart can be tracked
  std::vector<double> gaps;
  for (std::size_t i = 1; i < listing.frames.size(); ++i) {
    gaps.push_back(listing.frames[i].stamp - listing.frames[i - 1].stamp);
  }
  if (gaps.empty()) return;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  if (*middle < kLongest) return;
  listing.notices.push_back(
      fmt::format("the images are {:.4g} s apart at the median: stamps are expected in seconds; "
                  "are these milliseconds?",
                  *middle));
}

/// A part of what is listed.
void restrict(std::vector<ListedFrame>& frames, const FrameRange& range,
              const std::string& folder) {
  if (range.count == 0 || range.start >= frames.size()) {
    throw Error(fmt::format(
        "no frame left of {}: it has {}, numbered from 0, and frames from {} on were asked for",
        folder, frames.size(), range.start));
  }
  const std::size_t count = std::min(range.count, frames.size() - range.start);
  frames.erase(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(range.start));
  frames.resize(count);
}

}  // namespace

/// Makes frames of what is listed.
class SequenceReader::Images {
 public:
  /// Looks at the first frame that can be read: what the others have to be like. Throws Error when
  /// there is none, or when its images do not fit the camera or each other.
  explicit Images(SequenceListing listing) : listing_(std::move(listing)) {
    std::string first_fault;
    for (const ListedFrame& listed : listing_.frames) {
      SequenceImages images;
      try {
        images = decode(listed);
        toGrayLevels(images.color, listed.image_path);
      } catch (const Error& error) {
        if (first_fault.empty()) first_fault = error.what();
        continue;
      }
      fit(images, listed);
      const std::string doubt = doubtOf(listing_.camera.camera);
      if (!doubt.empty()) listing_.notices.push_back(listing_.camera_file + ": " + doubt);
      return;
    }
    throw Error(
        fmt::format("none of the {} frames can be read: {}", listing_.frames.size(), first_fault));
  }

  const SequenceListing& listing() const { return listing_; }

  /// Throws Error when an image cannot be read, or is not what the first ones were.
  SequenceImages readImages(const ListedFrame& listed) {
    SequenceImages images = read(listed);
    if (fit_ == Fit::kReduceColor) reduceToDepth(images.color);
    return images;
  }

  /// The same with gray levels for color, which are reduced as such.
  Frame readFrame(const ListedFrame& listed) {
    SequenceImages images = read(listed);
    Frame frame;
    frame.stamp = images.stamp;
    frame.image = toGrayLevels(images.color, listed.image_path);
    if (fit_ == Fit::kReduceColor) reduceToDepth(frame.image);
    frame.depth = images.depth;
    frame.depth_unit = depthUnit();
    return frame;
  }

 private:
  /// How color and depth come to one size.
  enum class Fit { kSame, kReduceColor, kEnlargeDepth };

  double depthUnit() const { return 1.0 / listing_.camera.depth_units_per_meter; }

  void reduceToDepth(cv::Mat& color) const {
    cv::resize(color, color, depth_size_, 0.0, 0.0, cv::INTER_AREA);
  }

  /// Depth of the size of the camera; color may be larger.
  SequenceImages read(const ListedFrame& listed) {
    SequenceImages images = decode(listed);
    requireSize(listed.image_path, images.color, image_size_, "color");
    requireSize(listed.depth_path, images.depth, depth_size_, "depth");
    if (fit_ == Fit::kEnlargeDepth) {
      images.depth = enlargeDepth(images.depth, depthUnit(), image_size_);
    }
    return images;
  }

  /// Images as they are stored, with the values of depth as a frame has them.
  SequenceImages decode(const ListedFrame& listed) const {
    SequenceImages images;
    images.stamp = listed.stamp;
    images.depth_stamp = listed.depth_stamp;
    images.color = readImage(listed.image_path);
    images.depth = readImage(listed.depth_path);
    if (images.depth.type() != CV_16UC1) {
      throw Error(listed.depth_path + " is no 16-bit image with one channel, as depth has to be");
    }
    decodeDepth(images.depth, listing_.depth_coding);
    return images;
  }

  cv::Mat toGrayLevels(const cv::Mat& color, const std::string& path) {
    try {
      return toGray(color, ChannelOrder::kBgr, range_.include(color));
    } catch (const Error& error) {
      throw Error(path + ": " + error.what());
    }
  }

  /// All images are as large as the first ones.
  void requireSize(const std::string& path, const cv::Mat& image, const cv::Size& first,
                   const char* kind) const {
    if (image.size() == first) return;
    if (first == sizeOf(listing_.camera.camera)) refuseSize(path, image);
    throw Error(fmt::format("{} has {} pixels, but the first {} image {}", path,
                            sizeText(image.size()), kind, sizeText(first)));
  }

  void fit(const SequenceImages& images, const ListedFrame& listed) {
    image_size_ = images.color.size();
    depth_size_ = images.depth.size();
    Camera& camera = listing_.camera.camera;
    fit_ = fitOf(camera);
    if (camera.width == 0) setSize(camera, fit_ == Fit::kReduceColor ? depth_size_ : image_size_);
    if (sizeOf(camera) != image_size_ &&
        !(fit_ == Fit::kReduceColor && sizeOf(camera) == depth_size_)) {
      refuseSize(listed.image_path, images.color);
    }
    if (fit_ == Fit::kSame && depth_size_ != image_size_) {
      throw Error(
          fmt::format("{} has {} pixels, but the color image {}: the depth is not registered to "
                      "the color camera",
                      listed.depth_path, sizeText(depth_size_), sizeText(image_size_)));
    }
    if (fit_ == Fit::kReduceColor) {
      camera = resized(camera, depth_size_);
      tell("color", image_size_, "reduced to the size of depth", depth_size_);
    } else if (fit_ == Fit::kEnlargeDepth) {
      tell("depth", depth_size_, "enlarged to the size of color", image_size_);
    }
  }

  /// Depth that is smaller by a whole factor is enlarged, as in bags, unless the camera is that of
  /// the depth.
  Fit fitOf(const Camera& camera) const {
    if (image_size_ == depth_size_) return Fit::kSame;
    if (listing_.is_color_reduced) return Fit::kReduceColor;
    if (!isWholeMultiple(image_size_, depth_size_)) return Fit::kSame;
    return sizeOf(camera) == depth_size_ ? Fit::kReduceColor : Fit::kEnlargeDepth;
  }

  void tell(const char* image, const cv::Size& from, const char* action, const cv::Size& to) {
    listing_.notices.push_back(
        fmt::format("{} of {} pixels is {}, {}", image, sizeText(from), action, sizeText(to)));
  }

  /// Of an intrinsics file, which does not say for which size it is.
  void setSize(Camera& camera, const cv::Size& size) const {
    camera.width = size.width;
    camera.height = size.height;
    try {
      camera.validate();
    } catch (const Error& error) {
      throw Error(listing_.camera_file + ": " + error.what());
    }
  }

  [[noreturn]] void refuseSize(const std::string& path, const cv::Mat& image) const {
    throw Error(fmt::format("{} has {} pixels, but the camera {}", path, sizeText(image.size()),
                            sizeText(sizeOf(listing_.camera.camera))));
  }

  SequenceListing listing_;
  cv::Size image_size_;
  cv::Size depth_size_;
  Fit fit_ = Fit::kSame;
  GrayRange range_;
};

SequenceReader::SequenceReader(const std::string& folder, const FrameRange& range) {
  std::error_code ignored;  // what cannot be looked at fails, with its reason, when it is listed
  if (!fs::exists(folder, ignored)) throw Error("there is no folder " + folder);
  if (!fs::is_directory(folder, ignored)) throw Error(folder + " is no folder");
  SequenceListing listing = list(folder);
  doubtInterval(listing);
  restrict(listing.frames, range, folder);
  images_ = std::make_unique<Images>(std::move(listing));
  camera_ = images_->listing().camera;
  count_ = images_->listing().frames.size();
  notice_ = fmt::format("{}", fmt::join(images_->listing().notices, "; "));
}

SequenceReader::~SequenceReader() = default;

template <typename Read>
FrameSource::Status SequenceReader::readNext(const Read& read, FrameFault& fault) {
  if (next_ >= count_) return Status::kEnd;
  const ListedFrame& listed = images_->listing().frames[next_++];
  try {
    read(listed);
    return Status::kFrame;
  } catch (const Error& error) {
    fault.text = error.what();
  }
  fault.reason = withoutPath(withoutPath(fault.text, listed.image_path, "the color image"),
                             listed.depth_path, "the depth image");
  return Status::kSkipped;
}

FrameSource::Status SequenceReader::next(Frame& frame, FrameFault& fault) {
  return readNext([&](const ListedFrame& listed) { frame = images_->readFrame(listed); }, fault);
}

FrameSource::Status SequenceReader::nextImages(SequenceImages& images, FrameFault& fault) {
  return readNext([&](const ListedFrame& listed) { images = images_->readImages(listed); }, fault);
}

const SequenceListing& SequenceReader::listing() const {
  return images_->listing();
}

const std::map<std::string, std::size_t>& SequenceReader::leftOut() const {
  return listing().left_out;
}

std::string SequenceReader::depthUnit() const {
  return fmt::format("{}: {} units per meter", listing().camera_file,
                     camera_.depth_units_per_meter);
}

}  // namespace mivo
