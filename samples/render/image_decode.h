#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "samples/render/texture.h"

namespace walr::render {

/// Decode a PNG or JPEG image, the formats of glTF 2.0, to 8-bit RGBA.
/// @param bytes        the encoded file
/// @param texelBudget  number of texels that may still be decoded; reduced by those of the image
/// @param warning      receives what looks wrong in an image that can be decoded, such as a checksum
/// @throws SceneError if the image is invalid, is beyond a limit of scene_limits.h or the budget, or has more texels
///         than its bytes could hold
Image decodeImage(std::span<const std::uint8_t> bytes, std::uint64_t& texelBudget, std::string& warning);

}  // namespace walr::render
