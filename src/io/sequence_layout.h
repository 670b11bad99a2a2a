// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/sequence_listing.h"

// The layouts of sequence folders, for listSequence().

namespace mivo {

/// Lists of images: TUM's layout, and what ICL-NUIM, Bonn and ETH3D-SLAM have made of it.
bool hasImageLists(const std::filesystem::path& folder);
SequenceListing readImageLists(const std::filesystem::path& folder);

/// Images whose names have numbers: 7-Scenes, 3DMatch, ScanNet, SUN3D, and a color and a depth
/// folder beside a camera.txt. Nothing when the folder is none of these.
std::optional<SequenceListing> readNumberedImages(const std::filesystem::path& folder);

/// The numbers in the names of a folder's files that have one of the endings: frame-000012.pose.txt
/// and 12.txt have 12. A folder that does not exist has none.
std::map<long, std::filesystem::path> numberedFiles(const std::filesystem::path& folder,
                                                    const std::vector<std::string>& endings);

// Of recordings that have numbers instead of times: a frame's stamp is its number over this.
constexpr double kAssumedFrameRate = 30.0;  // Hz

/// An image of a list.
struct ListedImage {
  double stamp;
  std::string path;
};

/// Pairs color with depth by their stamps, both lists in order, and counts those that stay alone.
/// Throws Error, with what was measured, when none is near another, or when the stamps of the two
/// differ by the same time throughout, image for image: equal ones would not belong together.
void pairImages(const std::vector<ListedImage>& images, const std::vector<ListedImage>& depths,
                const std::string& whose, SequenceListing& listing);

/// The camera of camera.txt, if there is one; whether there is.
bool takeCameraFile(const std::filesystem::path& folder, SequenceListing& listing);

/// Focal lengths and principal point of a file with the 3 x 3 matrix K, or a larger one around it.
/// Throws Error for a file that holds no such matrix.
Camera readIntrinsics(const std::filesystem::path& file);

}  // namespace mivo
