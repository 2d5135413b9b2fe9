#pragma once

#include <string>
#include <vector>

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfCompression.h>

namespace walr::test {

/// A part of an OpenEXR file as the OpenEXR library writes it. Channel number c of a part has the value of `valueAt`.
struct ExrPart {
  std::vector<std::string> channels;
  Imath::Box2i data{{0, 0}, {5, 3}};
  std::string name = {};  ///< Of files with several parts.
  std::string view = {};
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  float factor = 1.0F;  ///< Of all values.
  int tile = 0;         ///< Pixels along the side of a tile; 0: scan lines.
};

/// What the parts of a file share.
struct ExrFileWish {
  std::vector<ExrPart> parts;
  Imath::Box2i display{{0, 0}, {5, 3}};
  std::vector<std::string> views = {};  ///< The attribute `multiView` of the first part.
  bool manyAttributes = false;          ///< One of each type whose size is in the file.
};

/// A value that a half holds, and that tells column, line and channel in pictures of up to 16 x 8 pixels.
inline float valueAt(int x, int y, int channel) {
  return static_cast<float>(x + 16 * y + 128 * channel);
}

/// The bytes of a file. All channels are halves.
std::string exrBytes(const ExrFileWish& wish);

}  // namespace walr::test
