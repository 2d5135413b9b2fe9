#pragma once

#include <cstdint>
#include <functional>

namespace walr::render {

/// A rectangle of pixels: x0 <= x < x1, y0 <= y < y1.
struct Tile {
  std::uint32_t x0 = 0;
  std::uint32_t y0 = 0;
  std::uint32_t x1 = 0;
  std::uint32_t y1 = 0;
};

/// Divide an image into tiles and call `work` for every tile, on several threads. Returns when all tiles are done. The
/// first exception of `work` stops the work and is rethrown.
/// @param threads     number of threads; 0: one per core
/// @param pixelsDone  called after every tile with its number of pixels, by one thread at a time
void forEachTile(std::uint32_t width, std::uint32_t height, unsigned int threads,
                 const std::function<void(const Tile&)>& work, const std::function<void(std::uint64_t)>& pixelsDone);

}  // namespace walr::render
