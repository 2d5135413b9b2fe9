#include "samples/bench/response_scene.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace walr {
namespace {

constexpr float kWallDepth = 6.0F;
constexpr float kSecondWallDepth = 9.0F;
constexpr float kSlabDepth = 3.0F;
constexpr int kSlabSpeed = 4;
constexpr float kDimmed = 0.1F;
constexpr float kAlbedo = 0.5F;

/// A random number in [0, 1) for a pixel, frame and use (PCG hash of Jarzynski and Olano 2020).
float uniform(std::uint32_t pixel, int frame, std::uint32_t use) {
  std::uint32_t state = (pixel * 4U + use) * 747796405U + static_cast<std::uint32_t>(frame) * 2891336453U;
  state = state * 747796405U + 2891336453U;
  state = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
  state = (state >> 22U) ^ state;
  return static_cast<float>(state >> 8U) * 0x1p-24F;
}

struct Surface {
  float depth;
  glm::vec3 normal;
  glm::vec3 radiance;
  float motionX;
};

Surface wall(int x, int y) {
  const auto u = static_cast<float>(x);
  const auto v = static_cast<float>(y);
  const glm::vec3 normal = glm::normalize(glm::vec3(0.3F * std::sin(u / 6.0F), 0.3F * std::cos(v / 8.0F), 1.0F));
  const float light = 0.35F + 0.15F * std::sin(u / 40.0F + v / 55.0F) + 0.3F * normal.x;
  return {kWallDepth, normal, light * glm::vec3(1.0F, 0.9F, 0.8F), 0.0F};
}

/// The wall after the cut, with other bumps and other light.
Surface secondWall(int x, int y) {
  Surface surface = wall(2 * y + 7, x + 11);
  surface.depth = kSecondWallDepth;
  surface.radiance *= glm::vec3(0.2F, 0.3F, 0.4F);
  return surface;
}

/// Left edge of the slab in a frame; the slab enters at the left border of the image.
int slabLeft(fg::Extent extent, int frame) {
  return kSlabSpeed * frame - static_cast<int>(extent.width) / 4;
}

bool coveredBySlab(fg::Extent extent, int x, int y, int frame) {
  const int left = slabLeft(extent, frame);
  const int height = static_cast<int>(extent.height);
  return x >= left && x < left + static_cast<int>(extent.width) / 4 && y >= height / 8 && y < height - height / 8;
}

Frame emptyFrame(fg::Extent extent, int number) {
  const int width = static_cast<int>(extent.width);
  const int height = static_cast<int>(extent.height);
  Frame frame;
  frame.number = number;
  frame.resetHistory = number == 0;
  for (Image* image : {&frame.indirect, &frame.albedo, &frame.normal, &frame.motion}) *image = Image(width, height, 3);
  frame.depth = Image(width, height, 1);
  // A vertical field of view of 60 degrees.
  const float scale = std::sqrt(3.0F);
  frame.camera.projection = glm::mat4(0.0F);
  frame.camera.projection[0][0] = scale * static_cast<float>(height) / static_cast<float>(width);
  frame.camera.projection[1][1] = scale;
  frame.camera.projection[2][2] = -1.0F;
  frame.camera.projection[2][3] = -1.0F;
  frame.camera.projection[3][2] = -0.2F;
  frame.previousProjection = frame.camera.projection;
  return frame;
}

/// @param surfaceAt (x, y) -> Surface
template <typename Function>
KnownFrame render(fg::Extent extent, int number, Function surfaceAt) {
  Frame frame = emptyFrame(extent, number);
  Image truth = frame.indirect;
  for (int y = 0; y < truth.height(); ++y) {
    for (int x = 0; x < truth.width(); ++x) {
      const Surface surface = surfaceAt(x, y);
      const auto pixel = static_cast<std::uint32_t>(y * truth.width() + x);
      const bool lit = uniform(pixel, number, 0) < 0.25F;
      const float sample = lit ? 4.0F * (0.5F + uniform(pixel, number, 1)) : 0.0F;
      for (int c = 0; c < 3; ++c) {
        truth.at(x, y, c) = surface.radiance[c];
        frame.indirect.at(x, y, c) = sample * surface.radiance[c];
        frame.normal.at(x, y, c) = surface.normal[c];
        frame.albedo.at(x, y, c) = kAlbedo;
      }
      frame.depth.at(x, y, 0) = surface.depth;
      frame.motion.at(x, y, 0) = surface.motionX;
    }
  }
  std::vector<int> age(truth.pixelCount(), kAlwaysInView);
  return {packFrame(std::move(frame)), std::move(truth), std::move(age)};
}

}  // namespace

KnownFrame lightFrame(fg::Extent extent, int frame) {
  return render(extent, frame, [&](int x, int y) {
    Surface surface = wall(x, y);
    if (frame >= kLightChange) surface.radiance *= kDimmed;
    return surface;
  });
}

KnownFrame movingLightFrame(fg::Extent extent, int frame) {
  const glm::vec2 start = {0.25F * static_cast<float>(extent.width), 0.5F * static_cast<float>(extent.height)};
  const glm::vec2 centre = start + glm::vec2(kLightSpeed * static_cast<float>(frame), 0.0F);
  return render(extent, frame, [&](int x, int y) {
    Surface surface = wall(x, y);
    const glm::vec2 offset = (glm::vec2(x, y) - centre) / kLightSigma;
    surface.radiance *= 0.3F + 2.0F * std::exp(-0.5F * glm::dot(offset, offset));
    return surface;
  });
}

KnownFrame cutFrame(fg::Extent extent, int frame, bool told) {
  KnownFrame known = render(extent, frame, [&](int x, int y) { return frame < kCut ? wall(x, y) : secondWall(x, y); });
  known.packed.frame.resetHistory = frame == 0 || (told && frame == kCut);
  return known;
}

KnownFrame slabFrame(fg::Extent extent, int frame) {
  KnownFrame known = render(extent, frame, [&](int x, int y) {
    if (!coveredBySlab(extent, x, y, frame)) return wall(x, y);
    return Surface{kSlabDepth, {0.0F, 0.0F, 1.0F}, glm::vec3(1.2F, 0.6F, 0.5F), -static_cast<float>(kSlabSpeed)};
  });
  for (std::size_t i = 0; i < known.age.size(); ++i) {
    const int x = static_cast<int>(i % extent.width);
    const int y = static_cast<int>(i / extent.width);
    if (coveredBySlab(extent, x, y, frame)) {
      known.age[i] = -1;
      continue;
    }
    for (int before = frame - 1; before >= 0; --before) {
      if (!coveredBySlab(extent, x, y, before)) continue;
      known.age[i] = frame - before - 1;
      break;
    }
  }
  return known;
}

}  // namespace walr
