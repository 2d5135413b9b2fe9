#pragma once

#include <filesystem>

#include "samples/render/scene.h"

namespace walr::render {

/// Read an equirectangular sky from an OpenEXR file: R, G, B are linear radiance, the picture's middle lies along -Z,
/// its top along +Y, its right half along +X.
/// @throws InputError naming the file that is missing or damaged, lacks a channel, or holds values that are negative or
///         not finite
SkyMap loadSky(const std::filesystem::path& file);

}  // namespace walr::render
