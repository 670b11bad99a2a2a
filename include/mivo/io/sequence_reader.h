// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "mivo/io/camera_file.h"
#include "mivo/io/frame_range.h"
#include "mivo/io/frame_source.h"

namespace mivo {

struct SequenceListing;

/// The images of one frame, before color becomes gray.
struct SequenceImages {
  double stamp = 0.0;        ///< s, of color
  double depth_stamp = 0.0;  ///< s
  cv::Mat color;             ///< channels and bits as stored, of the size of depth
  cv::Mat depth;             ///< CV_16UC1, in depth units, 0: no reading
};

/// A recording as a folder in the layout of the TUM RGB-D benchmark:
///
///   rgb.txt, depth.txt   lines `stamp path`, paths relative to the folder, PNG, JPEG or PGM; depth
///                        in 16 bits, registered to the color camera, 0 where there is no reading
///   associations.txt     optional: lines `stamp_rgb path stamp_depth path`. Without it each color
///                        image gets the depth image nearest in time, 20 ms away at most
///   camera.txt           see readCamera; may be missing when the folder's name or another of its
///                        files tells the camera
///
/// or as ICL-NUIM, Bonn, ETH3D-SLAM, 7-Scenes, ScanNet and SUN3D have it, see doc/file_formats.md.
///
/// The stamp of a frame is that of its color image. The frames come in the order of their stamps,
/// whatever the order of the lines; of lines with the same stamp the first counts. Depth that is
/// smaller than color by a whole factor is enlarged. All this is told by notice().
class SequenceReader : public FrameSource {
 public:
  /// Opens the folder and looks at the first images. Throws Error when the folder or one of its
  /// files is missing or malformed, the camera cannot be right, all stamps of a file are the same,
  /// the range has no frame, no frame can be read, or the images of the first one that can be read
  /// do not fit the camera or each other.
  explicit SequenceReader(const std::string& folder, const FrameRange& range = {});
  ~SequenceReader() override;

  const Camera& camera() const override { return camera_.camera; }
  std::size_t size() const override { return count_; }

  /// The depth is handed on as it is stored, with Frame::depth_unit. A frame is skipped when one of
  /// its images is missing, damaged, of the wrong type or of the wrong size.
  Status next(Frame& frame, FrameFault& fault) override;

  /// As next(), for programs that copy a recording.
  Status nextImages(SequenceImages& images, FrameFault& fault);

  double depthUnitsPerMeter() const { return camera_.depth_units_per_meter; }

  /// Where the images of the frames lie: io/sequence_listing.h.
  const SequenceListing& listing() const;

  std::string depthUnit() const override;
  const std::string& notice() const override { return notice_; }
  const std::map<std::string, std::size_t>& leftOut() const override;

 private:
  class Images;  // read, decoded, brought to one size
  template <typename Read>
  Status readNext(const Read& read, FrameFault& fault);

  SequenceCamera camera_;
  std::string notice_;
  std::unique_ptr<Images> images_;
  std::size_t count_ = 0;
  std::size_t next_ = 0;
};

}  // namespace mivo
