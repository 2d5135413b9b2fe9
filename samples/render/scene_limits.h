#pragma once

#include <array>

#include "samples/image/file_limit.h"

/// What a scene's files may make the loader allocate.
namespace walr::render {

inline constexpr FileLimit kLargestSceneFile{0x7fffffff, "bytes in a file"};  // tinygltf has 32-bit sizes.
inline constexpr FileLimit kMostSceneBytes{std::int64_t{1} << 32,
                                           "bytes in all files, each counted as often as it is named"};
/// The parser recurses once a level. glTF itself needs about ten.
inline constexpr FileLimit kDeepestJson{128, "levels of JSON"};
/// A parsed value takes up to 40 bytes, also if it takes two in the file. A node with a matrix has about 20 values.
inline constexpr FileLimit kMostJsonValues{1 << 25, "values of JSON"};
inline constexpr FileLimit kMostTexelsASide{16384, "texels along a side of an image"};
inline constexpr FileLimit kMostTexels{1 << 28, "texels of all images, of 4 bytes each"};
/// libjpeg writes ten.
inline constexpr FileLimit kMostScans{64, "scans of a JPEG"};
inline constexpr FileLimit kMostElements{1 << 27, "vertices, indices and animation keys, counted once for each use"};
inline constexpr FileLimit kMostZeros{1 << 22, "of these in accessors without a buffer view"};
inline constexpr FileLimit kMostTriangles{1 << 26, "triangles, counted once for each node"};
inline constexpr FileLimit kMostDracoElements{1 << 26, "faces and points of all meshes of Draco"};
inline constexpr FileLimit kMostDracoElementsOfAByte{256, "faces or points of Draco for each byte of their data"};
inline constexpr FileLimit kMostMeshoptBytesOfAByte{64, "bytes into which a byte of meshoptimizer expands"};
/// All of them, for the manual.
inline constexpr std::array kSceneLimits{kLargestSceneFile,
                                         kMostSceneBytes,
                                         kDeepestJson,
                                         kMostJsonValues,
                                         kMostTexelsASide,
                                         kMostTexels,
                                         kMostScans,
                                         kMostElements,
                                         kMostZeros,
                                         kMostTriangles,
                                         kMostDracoElements,
                                         kMostDracoElementsOfAByte,
                                         kMostMeshoptBytesOfAByte};

}  // namespace walr::render
