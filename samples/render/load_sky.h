#pragma once

#include <filesystem>

#include "samples/render/scene.h"

namespace walr::render {

/// Read an equirectangular sky from an OpenEXR file. R, G, B are linear radiance. The image's middle lies along -Z, its
/// top along +Y, its right half along +X.
/// @throws InputError naming the file if it is missing or damaged, lacks a channel, or has values outside 0..1e9
SkyMap loadSky(const std::filesystem::path& file);

}  // namespace walr::render
