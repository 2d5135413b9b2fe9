#include "tests/passes/reference/antilag.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace walr::reference {

Image<TileChange> changeByTiles(const Image<Accumulated>& accumulated) {
  Image<TileChange> tiles((accumulated.size() + kChangeTile - 1) / kChangeTile);
  forEachPixel(accumulated.size(), [&](glm::ivec2 p) {
    const Accumulated& pixel = accumulated[p];
    TileChange& tile = tiles[p / kChangeTile];
    const double d = pixel.difference;
    tile.sum.value += d;
    tile.squares.value += d * d;
    // A sum of 64 terms by halves is six additions deep.
    tile.sum.error += pixel.differenceError + 6.0 * kFloatRoundoff * std::abs(d);
    tile.squares.error +=
        pixel.differenceError * (2.0 * std::abs(d) + pixel.differenceError) + 8.0 * kFloatRoundoff * d * d;
    tile.undecided |= pixel.undecided;
  });
  return tiles;
}

Image<Bounded> antilagOf(const Image<glm::dvec2>& tiles, const AntilagSettings& settings) {
  Image<Bounded> antilag(tiles.size());
  const int radius = static_cast<int>(settings.radius);
  const double range = double(settings.scoreHigh) - double(settings.scoreLow);
  forEachPixel(tiles.size(), [&](glm::ivec2 t) {
    glm::dvec2 sum(0.0);
    double magnitudes = 0.0;
    int count = 0;
    for (int y = t.y - radius; y <= t.y + radius; ++y) {
      for (int x = t.x - radius; x <= t.x + radius; ++x) {
        if (!tiles.contains({x, y})) continue;
        sum += tiles[{x, y}];
        magnitudes += std::abs(tiles[{x, y}].x);
        ++count;
      }
    }
    if (sum.y <= 0.0) return;
    const double score = std::abs(sum.x) / std::sqrt(sum.y);
    antilag[t].value = std::clamp((score - settings.scoreLow) / range, 0.0, 1.0);
    // Vulkan allows an inverse square root two units in the last place. A sum errs by a roundoff of each partial sum.
    const double scoreError =
        count * kFloatRoundoff * magnitudes / std::sqrt(sum.y) + (count + 8.0) * kFloatRoundoff * score;
    const double rounding = kHalfRoundoff * antilag[t].value;  // It is stored as a half.
    antilag[t].error = (scoreError + 4.0 * kFloatRoundoff * (score + settings.scoreHigh)) / range + rounding;
  });
  return antilag;
}

Image<double> antilagOf(const Image<Accumulated>& accumulated, const AntilagSettings& settings) {
  const Image<TileChange> tiles = changeByTiles(accumulated);
  Image<glm::dvec2> sums(tiles.size());
  Image<double> antilag(tiles.size());
  forEachPixel(tiles.size(), [&](glm::ivec2 t) { sums[t] = {tiles[t].sum.value, tiles[t].squares.value}; });
  const Image<Bounded> bounded = antilagOf(sums, settings);
  forEachPixel(tiles.size(), [&](glm::ivec2 t) { antilag[t] = bounded[t].value; });
  return antilag;
}

Bounded longestHistory(const Image<double>& antilag, glm::dvec2 pixel, double pixelError, double maxHistory,
                       bool hasSample) {
  const glm::dvec2 position = pixel / double(kChangeTile) - 0.5;
  const glm::dvec2 base = glm::floor(position);
  const glm::dvec2 f = position - base;
  double value = 0.0;
  double least = 1.0;
  double most = 0.0;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 offset(i % 2, i / 2);
    const glm::ivec2 tile = glm::clamp(glm::ivec2(base) + offset, glm::ivec2(0), antilag.size() - 1);
    value += (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y) * antilag[tile];
    least = std::min(least, antilag[tile]);
    most = std::max(most, antilag[tile]);
  }
  // A position error of one pixel moves the weights of an axis by an eighth.
  const double error = 4.0 * pixelError / kChangeTile * (most - least) + 8.0 * kFloatRoundoff;
  const double frames = 1.0 - value < 0x1p-10 ? 0.0 : maxHistory * (1.0 - value);
  return {std::max(frames, hasSample ? 0.0 : 1.0), maxHistory * error + 4.0 * kFloatRoundoff * maxHistory};
}

glm::dvec4 withLongestHistory(const glm::dvec4& mean, const glm::dvec3& light, double longest) {
  const bool counts = std::isfinite(light.r + light.g + light.b);
  const double frames = mean.a - (counts ? 1.0 : 0.0);
  if (frames <= 1.125 * longest) return mean;  // Not longer by more than packed lengths are rounded.
  const glm::dvec3 m(mean);
  const glm::dvec3 history = counts ? glm::max((mean.a * m - light) / frames, 0.0) : m;
  if (!counts) return {history, longest};
  return {(longest * history + light) / (longest + 1.0), longest + 1.0};
}

}  // namespace walr::reference
