#pragma once

#include <filesystem>

#include "samples/image/image.h"

namespace walr {

/// Write an image as a NumPy array of half floats with shape (height, width, components), completely or not at all
/// (NumPy Enhancement Proposal 1, version 1.0).
/// @throws OutputError
void writeNpy(const std::filesystem::path& path, const Image& image);

}  // namespace walr
