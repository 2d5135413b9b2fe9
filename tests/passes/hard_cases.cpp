#include "tests/passes/hard_cases.h"

#include <cmath>
#include <functional>
#include <limits>

#include <glm/geometric.hpp>

#include "tests/passes/reference/hash.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/synthetic_scene.h"

namespace walr::test {
namespace {

using reference::HostFrame;

constexpr glm::ivec2 kSize(48, 36);
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Two still frames, both changed in the same way.
std::vector<HostFrame> framesOf(const Scene& scene, const std::function<void(HostFrame&)>& change = {}) {
  std::vector<HostFrame> frames{renderStill(scene, kSize, 0), renderStill(scene, kSize, 1)};
  if (change) {
    for (HostFrame& frame : frames) change(frame);
  }
  return frames;
}

/// A scattered number per pixel, uniform in [0, 1).
double scatter(glm::ivec2 p) {
  return reference::pcg4d({p, 5, 9}).x * 0x1p-32;
}

/// A wall whose normals vary along only one diagonal of the feature space.
Scene collinearWall() {
  return [wall = flatWall()](glm::dvec3 origin, glm::dvec3 direction) {
    auto hit = wall(origin, direction);
    const glm::dvec3 p = origin + hit->distance * direction;
    const double bump = 0.2 * std::sin(5.0 * p.x + 3.0 * p.y);
    hit->shadingNormal = glm::dvec3(bump, bump, 1.0);
    return hit;
  };
}

std::function<void(HostFrame&)> scaleLight(double scale) {
  return [scale](HostFrame& frame) {
    for (glm::dvec3& l : frame.lighting.pixels())
      for (int c = 0; c < 3; ++c) l[c] = reference::roundToHalf(l[c] * scale);
  };
}

std::function<void(HostFrame&)> scaleDepth(const std::function<double(glm::ivec2)>& scale) {
  return [scale](HostFrame& frame) {
    reference::forEachPixel(kSize,
                            [&](glm::ivec2 p) { frame.depth[p] = reference::roundToFloat(frame.depth[p] * scale(p)); });
  };
}

/// A high value in every 37th pixel.
std::function<void(HostFrame&)> fireflies(double value) {
  return [value](HostFrame& frame) {
    for (std::size_t i = 11; i < frame.lighting.pixels().size(); i += 37)
      frame.lighting.pixels()[i] = glm::dvec3(reference::roundToHalf(value), 0.25, 0.5);
  };
}

/// Pixels without a finite sample, the same in all frames.
std::function<void(HostFrame&)> unsampled(double share) {
  return [share](HostFrame& frame) {
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      if (scatter(p) < share) frame.lighting[p].g = kNaN;
    });
  };
}

/// Normals replaced by the given ones, in stripes 3 pixels wide.
std::function<void(HostFrame&)> stripesOf(const std::vector<glm::dvec3>& normals) {
  return [normals](HostFrame& frame) {
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      const glm::dvec3 n = normals[static_cast<std::size_t>(p.x / 3 + p.y / 7) % normals.size()];
      for (int c = 0; c < 3; ++c) frame.normal[p][c] = reference::roundToHalf(n[c]);
    });
  };
}

void onlyOnePixel(HostFrame& frame) {
  const glm::ivec2 one(17, 20);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (p != one) frame.depth[p] = 1e10;
  });
}

void zeroLight(HostFrame& frame) {
  for (glm::dvec3& l : frame.lighting.pixels()) l = glm::dvec3(0.0);
}

}  // namespace

std::vector<HardCase> hardCases() {
  const Scene wall = bumpyWall(0.1);
  std::vector<HardCase> cases{{"flat wall", framesOf(flatWall())}};
  for (const double variation : {1e-4, 1e-3, 1e-2, 0.3})
    cases.push_back({"normals vary by " + std::to_string(variation), framesOf(bumpyWall(variation))});
  cases.push_back({"sphere", framesOf(sphere())});
  cases.push_back({"collinear features", framesOf(collinearWall())});
  cases.push_back({"sky but for one pixel", framesOf(wall, onlyOnePixel)});
  cases.push_back({"isolated pixels", framesOf(wall, scaleDepth([](glm::ivec2 p) { return 1.0 + scatter(p); }))});
  cases.push_back(
      {"some isolated pixels", framesOf(wall, scaleDepth([](glm::ivec2 p) { return scatter(p) < 0.05 ? 0.5 : 1.0; }))});
  for (const double value : {1e4, 6e4, kInfinity, kNaN})
    cases.push_back({"fireflies of " + std::to_string(value), framesOf(wall, fireflies(value))});
  for (const double share : {0.1, 0.5})
    cases.push_back({"no sample in " + std::to_string(share) + " of the pixels", framesOf(wall, unsampled(share))});
  cases.push_back({"isolated pixels, half of them without a sample", framesOf(wall, [](HostFrame& frame) {
                     scaleDepth([](glm::ivec2 p) { return 1.0 + scatter(p + 100); })(frame);
                     unsampled(0.5)(frame);
                   })});
  cases.push_back({"no light", framesOf(wall, zeroLight)});
  for (const double scale : {1e-6, 1e4, 1e6})
    cases.push_back({"radiance times " + std::to_string(scale), framesOf(wall, scaleLight(scale))});
  cases.push_back({"depth 1e-3", framesOf(wall, scaleDepth([](glm::ivec2) { return 2e-4; }))});
  cases.push_back({"depth 1e6", framesOf(wall, scaleDepth([](glm::ivec2) { return 2e5; }))});
  cases.push_back(
      {"depth 1e-3 beside 1e6", framesOf(wall, scaleDepth([](glm::ivec2 p) { return p.x < 21 ? 2e-4 : 2e5; }))});
  cases.push_back({"grazing plane", framesOf(grazingFloor())});
  cases.push_back({"normals on the fold", framesOf(wall, stripesOf({{0.6, 0.8, 0.0},
                                                                    {1.0, 0.0, 0.0},
                                                                    {0.0, -1.0, 0.0},
                                                                    {0.7, 0.7, -0.01},
                                                                    {-0.8, 0.6, 0.01},
                                                                    {0.8, 0.0, 0.01}}))});
  cases.push_back({"degenerate normals", framesOf(wall, stripesOf({{0.0, 0.0, 0.0},
                                                                   {0.0, 0.0, 1e-7},
                                                                   {6e4, 6e4, 6e4},
                                                                   {0.0, 0.0, -1.0},
                                                                   {0.001, 0.002, 0.003},
                                                                   {0.0, kNaN, 1.0}}))});
  return cases;
}

}  // namespace walr::test
