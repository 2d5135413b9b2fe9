#include "samples/denoise/averaged_frame.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "samples/metrics/metrics.h"

namespace walr {
namespace {

// Calls `visit` with the number of every pixel of the square that a pixel of the picture stands for.
template <typename Visit>
void visitSquare(int width, int side, int x, int y, Visit visit) {
  for (int row = y * side; row < (y + 1) * side; ++row) {
    for (int column = x * side; column < (x + 1) * side; ++column) {
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column));
    }
  }
}

// The mean over those pixels of every square that are counted, or over all of a square without one.
Image meanOf(const Image& image, int side, const PixelMask& counted) {
  if (image.empty()) return {};
  Image mean(image.width() / side, image.height() / side, image.components());
  std::vector<double> sum(static_cast<std::size_t>(image.components()));
  for (int y = 0; y < mean.height(); ++y) {
    for (int x = 0; x < mean.width(); ++x) {
      std::size_t number = 0;
      visitSquare(image.width(), side, x, y, [&](std::size_t pixel) { number += counted[pixel] != 0 ? 1 : 0; });
      const bool all = number == 0;
      std::ranges::fill(sum, 0.0);
      visitSquare(image.width(), side, x, y, [&](std::size_t pixel) {
        if (!all && counted[pixel] == 0) return;
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += image.pixel(pixel)[c];
      });
      const auto pixels = static_cast<double>(all ? static_cast<std::size_t>(side * side) : number);
      for (std::size_t c = 0; c < sum.size(); ++c) {
        mean.at(x, y, static_cast<int>(c)) = static_cast<float>(sum[c] / pixels);
      }
    }
  }
  return mean;
}

// The number of the first counted pixel of every square, or of the first of all in a square without one.
std::vector<std::size_t> firstPixels(int width, int height, int side, const PixelMask& counted) {
  std::vector<std::size_t> first;
  for (int y = 0; y < height / side; ++y) {
    for (int x = 0; x < width / side; ++x) {
      std::vector<std::size_t> square;
      visitSquare(width, side, x, y, [&](std::size_t pixel) { square.push_back(pixel); });
      const auto found = std::ranges::find_if(square, [&](std::size_t pixel) { return counted[pixel] != 0; });
      first.push_back(found == square.end() ? square.front() : *found);
    }
  }
  return first;
}

// An image whose pixels are some of another one's.
Image chosen(const Image& image, int side, const std::vector<std::size_t>& pixels) {
  Image result(image.width() / side, image.height() / side, image.components());
  for (std::size_t i = 0; i < pixels.size(); ++i) std::ranges::copy(image.pixel(pixels[i]), result.pixel(i).begin());
  return result;
}

// Of the counted pixels those that have a sample of the frame's indirect light.
PixelMask sampled(const Frame& frame, PixelMask counted) {
  if (frame.light.everyPixel()) return counted;
  for (int y = 0; y < frame.depth.height(); ++y) {
    for (int x = 0; x < frame.depth.width(); ++x) {
      if (frame.light.hasSample({x, y}, frame.lightOffset)) continue;
      counted[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.depth.width()) +
              static_cast<std::size_t>(x)] = 0;
    }
  }
  return counted;
}

}  // namespace

fg::Extent averagedExtent(fg::Extent extent, int side) {
  const auto step = static_cast<std::uint32_t>(side);
  if (extent.width % step != 0 || extent.height % step != 0) {
    throw std::invalid_argument("squares of " + std::to_string(side) + " x " + std::to_string(side) +
                                " pixels do not fill frames of " + std::to_string(extent.width) + " x " +
                                std::to_string(extent.height));
  }
  return {extent.width / step, extent.height / step};
}

Image averaged(const Image& image, int side) {
  return meanOf(image, side, PixelMask(image.pixelCount(), 1));
}

DenoisedFrame averagedLights(const DenoisedFrame& denoised, int side) {
  const Frame& frame = denoised.frame;
  const PixelMask diffuse = diffuseMask(frame.albedo, frame.normal, frame.depth, kSkyDepth);
  const auto light = [&](const Image& image) { return meanOf(image, side, diffuse); };
  const std::vector<std::size_t> first = firstPixels(frame.depth.width(), frame.depth.height(), side, diffuse);
  const auto guide = [&](const Image& image) { return chosen(image, side, first); };

  DenoisedFrame small;
  small.frame.number = frame.number;
  small.frame.resetHistory = frame.resetHistory;
  small.frame.albedo = guide(frame.albedo);
  small.frame.normal = guide(frame.normal);
  small.frame.depth = guide(frame.depth);
  small.frame.indirect = meanOf(frame.indirect, side, sampled(frame, diffuse));
  small.frame.direct = light(frame.direct);
  if (frame.reference) {
    small.frame.reference = {light(frame.reference->indirect), light(frame.reference->direct),
                             light(frame.reference->indirectHalf)};
  }
  small.indirect = light(denoised.indirect);
  small.direct = light(denoised.direct);
  small.gpuMilliseconds = denoised.gpuMilliseconds;
  small.counters = denoised.counters;
  return small;
}

}  // namespace walr
