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

/// Cut an image into tiles and call `work` for every one, on several threads at once. Returns when all are done; the
/// first exception that `work` throws ends the work and is thrown on.
/// @param threads     0: one for every core
/// @param pixelsDone  told after every tile how many pixels it has; by one thread at a time
void forEachTile(std::uint32_t width, std::uint32_t height, unsigned int threads,
                 const std::function<void(const Tile&)>& work, const std::function<void(std::uint64_t)>& pixelsDone);

}  // namespace walr::render
