#pragma once

#include "passes/temporal/antilag.h"
#include "tests/passes/reference/temporal_accumulation.h"

namespace walr::reference {

/// Side of the tiles over which differences are summed, pixels.
inline constexpr int kChangeTile = 8;

/// A number with a bound of what single-precision arithmetic adds to it.
struct Bounded {
  double value = 0.0;
  double error = 0.0;
};

/// Sums over a tile of the differences d between new light and history (passes/WALR.md, 3).
struct TileChange {
  Bounded sum;
  Bounded squares;
  bool undecided = false;  ///< Whether any of the tile's pixels is undecided.
};
Image<TileChange> changeByTiles(const Image<Accumulated>& accumulated);

/// The antilag factor a of passes/WALR.md, 3, from the sums (x) and sums of squares (y) of tiles.
Image<Bounded> antilagOf(const Image<glm::dvec2>& tiles, const AntilagSettings& settings);

/// The antilag factor computed from an accumulated frame, without error bounds.
Image<double> antilagOf(const Image<Accumulated>& accumulated, const AntilagSettings& settings);

/// The largest history length at a position in the previous image, (1 - a) M of passes/WALR.md, 2, with a read
/// bilinearly; at least 1 without a sample.
/// @param pixelError error bound of the position, pixels
Bounded longestHistory(const Image<double>& antilag, glm::dvec2 pixel, double pixelError, double maxHistory,
                       bool hasSample);

/// The mean m of passes/WALR.md, 2, with at most `longest` frames of history in it (section 3).
/// @param mean      rgb: m; a: N, frames
/// @param light     this frame's, y; not finite where it does not count
glm::dvec4 withLongestHistory(const glm::dvec4& mean, const glm::dvec3& light, double longest);

}  // namespace walr::reference
