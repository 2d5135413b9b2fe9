#pragma once

#include <cstdint>
#include <span>

#include "samples/render/texture.h"

namespace walr::render {

/// Decode a PNG or JPEG picture, which is what glTF 2.0 knows, to 8-bit RGBA.
/// @param bytes        the encoded file
/// @param texelBudget  texels that may still be decoded; what is used is taken off
/// @throws SceneError if the bytes are no such picture, or one of more than 16384 texels a side or than the budget
Image decodeImage(std::span<const std::uint8_t> bytes, std::uint64_t& texelBudget);

}  // namespace walr::render
