// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

namespace mivo {

/// Images of more pixels are refused: four times those of the largest RGB-D cameras.
constexpr std::uint64_t kMaxImagePixels = std::uint64_t{1} << 26;

/// What an encoded image is by its first bytes: "PNG", "JPEG" and "PGM", which are read, or
/// another name; empty when they say nothing.
std::string imageFormat(const unsigned char* bytes, std::size_t count);

/// The image of a PNG, JPEG or binary PGM with its own channels and depth; color in the order
/// blue, green, red. Throws Error, which begins with `name`, when it is something else, truncated
/// or damaged: a decoder on its own may return the part of the image that it could make sense of.
/// Bytes behind the end of the image, with which some encoders pad it, do not matter.
cv::Mat decodeImage(const unsigned char* bytes, std::size_t count, const std::string& name);

}  // namespace mivo
