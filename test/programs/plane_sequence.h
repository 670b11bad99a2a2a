// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "io/sequence_writer.h"
#include "mivo/io/camera_file.h"

namespace mivo {

/// The camera of the sequences below: 160 x 120 pixels, depth in millimeters.
SequenceCamera planeCamera();

/// Pose of frame `i`: a slow arc in front of the plane, starting at the identity.
Eigen::Isometry3d planePose(int i);

/// Stamp of frame `i`, at 30 Hz.
double planeStamp(int i);

/// Image and depth (meters) of a textured, slanted plane, in closed form.
void renderPlane(const Eigen::Isometry3d& T_world_camera, cv::Mat& image, cv::Mat& depth);

/// Writes a sequence folder of `frames` frames with its ground truth.
void writePlaneSequence(const std::string& folder, int frames);

/// The same as SUN3D lays it out, without the truth: times in the names, depth rotated by three
/// bits.
void writeSun3dPlaneSequence(const std::string& folder, int frames);

/// Largest distance (m) of the poses in a trajectory file from the truth, seen from frame
/// `first_frame`, where the estimate starts at the identity.
double largestPlaneError(const std::string& trajectory, int first_frame = 0);

}  // namespace mivo
