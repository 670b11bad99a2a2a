// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>

#include "synthetic/texture.h"

// Materials of the synthetic scenes, made from a seed. Colors are linear reflectances (blue,
// green, red), 0..1. Each has structure at all scales down to its texel (1 to 3 mm).

namespace mivo {

using Reflectance = cv::Vec3f;

// Repeated materials.
Texture plasterTexture(const Reflectance& color, double contrast, std::uint64_t seed);
Texture brickTexture(std::uint64_t seed);
Texture plankTexture(std::uint64_t seed);                            ///< floor boards along x
Texture grainTexture(const Reflectance& color, std::uint64_t seed);  ///< furniture wood, along x
Texture wovenTexture(const Reflectance& color, const Reflectance& second, std::uint64_t seed);
Texture stoneTexture(const Reflectance& color, std::uint64_t seed);  ///< polished, veined
Texture terrazzoTexture(std::uint64_t seed);                         ///< speckled floor
Texture cardboardTexture(std::uint64_t seed);
Texture plainTexture(const Reflectance& color);  ///< no structure at all
/// Painted stripes of many widths: a function of x alone, or of y alone.
Texture stripesTexture(bool along_y, std::uint64_t seed);

// Pictures that are stretched over their surface, upright.
Texture paintingTexture(std::uint64_t seed);     ///< shapes and strokes, as on posters
Texture rugTexture(std::uint64_t seed);          ///< woven ornaments and borders
Texture printedPageTexture(std::uint64_t seed);  ///< headings, paragraphs and a figure
Texture bookRowTexture(std::uint64_t seed);      ///< the backs of books in a shelf
Texture screenTexture(std::uint64_t seed);       ///< a monitor showing windows with text
Texture keyboardTexture(std::uint64_t seed);

}  // namespace mivo
