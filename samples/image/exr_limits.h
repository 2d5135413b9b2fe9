#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "samples/image/file_limit.h"
#include "samples/image/pixel_rect.h"

namespace walr {

inline constexpr FileLimit kMostPixelsASide{16384, "pixels along a side of a window or of a tile"};
inline constexpr FileLimit kMostPixels{std::int64_t{8192} * 8192, "pixels in a window"};
inline constexpr FileLimit kFarthestCorner{1 << 20, "pixels from the origin to a corner of a window"};
inline constexpr FileLimit kMostParts{1024, "parts"};
inline constexpr FileLimit kMostChannels{4096, "channels of all parts"};
inline constexpr FileLimit kMostViews{256, "views"};
inline constexpr FileLimit kLargestBlock{1 << 29, "bytes in a block of lines or in a tile, decompressed"};
inline constexpr FileLimit kLargestAttribute{1 << 24, "bytes in an attribute of a header"};
inline constexpr FileLimit kLargestHeaders{1 << 26, "bytes in all headers"};
/// All of them, for the manual.
inline constexpr std::array kExrLimits{kMostPixelsASide, kMostPixels,       kFarthestCorner,
                                       kMostParts,       kMostChannels,     kMostViews,
                                       kLargestBlock,    kLargestAttribute, kLargestHeaders};

/// @throws std::runtime_error naming the limit if there is more
void requireWithin(const FileLimit& limit, std::int64_t number);

/// Require that a window is within the limits on windows.
/// @throws std::runtime_error naming the limit
void requireWithinLimits(const PixelRect& window);

/// Scan lines that a compression stores together, by its number in files.
/// @throws std::runtime_error if there is no such compression
std::int64_t exrLinesInBlock(std::uint8_t compression);

/// Check all headers of a file: the limits above, that every attribute has the size that its type has by the
/// specification of OpenEXR and lies within the file, and that the file has room for its tables of blocks. The OpenEXR
/// library allocates what headers claim, so this comes before it sees the file.
/// @throws InputError naming the file and what is wrong
void checkExrHeaders(const std::filesystem::path& path);

}  // namespace walr
