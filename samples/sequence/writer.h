#pragma once

#include <filesystem>
#include <string>

#include "samples/sequence/frame.h"

namespace walr {

/// File name of one frame: `prefix`_FFFF.`extension`, with at least four digits.
std::string frameFileName(const std::string& prefix, int number, const std::string& extension);

/// Write `noisy_FFFF.exr` in the project's own layout (samples/docs/sequences.md), completely or not at all. The frame
/// must follow the project's conventions: normals in view space; motion in pixels, y down, with its z; depth
/// `kBackgroundDepth` on sky. Empty direct light, emission, specular light and object ids are left
/// out. `reference` and `nonFinite` are
/// not written.
/// @throws OutputError
void writeFrame(const std::filesystem::path& directory, const Frame& frame);

/// Write `ref_FFFF.exr`. Empty images are left out.
/// @throws OutputError
void writeReference(const std::filesystem::path& directory, int number, const Reference& reference);

}  // namespace walr
