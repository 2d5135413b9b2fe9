#pragma once

#include <cstdint>
#include <span>

#include "samples/render/texture.h"

namespace walr::render {

/// Decode a PNG or JPEG image, the formats of glTF 2.0, to 8-bit RGBA.
/// @param bytes        the encoded file
/// @param texelBudget  number of texels that may still be decoded; reduced by those of the image
/// @throws SceneError if the image is invalid, has more than `kMostTexelsASide`, more texels than its bytes could hold,
/// or
///         exceeds the budget
Image decodeImage(std::span<const std::uint8_t> bytes, std::uint64_t& texelBudget);

}  // namespace walr::render
