#pragma once

#include "passes/antilag.h"
#include "tests/passes/reference/temporal_accumulation.h"

namespace walr::reference {

/// Side of the tiles over which change is summed, pixels.
inline constexpr int kChangeTile = 8;

/// A number with a bound of what single-precision arithmetic adds to it.
struct Bounded {
  double value = 0.0;
  double error = 0.0;
};

/// What the samples of a tile differ by from history.
struct TileChange {
  Bounded sum;
  Bounded squares;
  bool undecided = false;  ///< One of the pixels is.
};
Image<TileChange> changeByTiles(const Image<Accumulated>& accumulated);

/// Antilag factor from the sums (x) and sums of squares (y) of tiles.
Image<Bounded> antilagOf(const Image<glm::dvec2>& tiles, const AntilagSettings& settings);

/// The same from what a frame's accumulation found, without the bounds.
Image<double> antilagOf(const Image<Accumulated>& accumulated, const AntilagSettings& settings);

/// The number of samples that history may count for at a position in the previous picture.
/// @param pixelError of the position, pixels
Bounded longestHistory(const Image<double>& antilag, glm::dvec2 pixel, double pixelError, double maxHistory);

}  // namespace walr::reference
