#include "samples/bench/hard_case_scenes.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace walr {
namespace {

constexpr int kSize = static_cast<int>(kHardCaseExtent.width);
constexpr float kHalfTangent = 0.57735F;  // For a field of view of 60 degrees.
constexpr float kDepth = 4.0F;

struct Point {
  float depth = kDepth;
  glm::vec3 normal{0.0F, 0.0F, 1.0F};
  float level = 1.0F;  ///< Multiplies radiance.
};

/// Uniform random numbers in -1..1 that are the same on every platform, unlike `std::uniform_real_distribution`.
class Random {
 public:
  float operator()() { return static_cast<float>(engine_()) * 0x1p-31F - 1.0F; }

 private:
  std::mt19937 engine_{1};
};

using Scene = std::function<Point(int x, int y, Random& random)>;

Point sky() {
  return {kBackgroundDepth, glm::vec3(0.0F), 0.0F};
}

Scene bumpy(float amplitude) {
  return [=](int, int, Random& random) {
    return Point{.normal = glm::normalize(glm::vec3(amplitude * random(), amplitude * random(), 1.0F))};
  };
}

Scene lit(float level, float depth = kDepth) {
  return [=](int, int, Random& random) {
    return Point{depth, glm::normalize(glm::vec3(0.1F * random(), 0.1F * random(), 1.0F)), level};
  };
}

Point sphere(int x, int y, Random& /*random*/) {
  const glm::vec2 p = (glm::vec2(x, y) + 0.5F) / (0.5F * kSize) - 1.0F;
  const float squared = glm::dot(p, p);
  return squared < 0.98F ? Point{.normal = glm::normalize(glm::vec3(p.x, -p.y, std::sqrt(1.0F - squared)))} : sky();
}

/// A plane whose normal is at 85 degrees to the direction of view; sky above its horizon.
Point grazing(int /*x*/, int y, Random& /*random*/) {
  const glm::vec3 normal = {0.0F, std::sin(1.4835F), std::cos(1.4835F)};
  const glm::vec3 ray = {0.0F, kHalfTangent * (1.0F - 2.0F * (static_cast<float>(y) + 0.5F) / kSize), -1.0F};
  const float facing = -glm::dot(normal, ray);
  return facing > 0.01F ? Point{.depth = 0.5F / facing, .normal = normal} : sky();
}

Point onTheFold(int /*x*/, int /*y*/, Random& random) {
  const float angle = 3.14159265F * random();
  return {.normal = glm::normalize(glm::vec3(std::cos(angle), std::sin(angle), 1e-3F * random()))};
}

HardCase make(std::string name, const Scene& scene) {
  const auto image = [](int components) { return Image(kSize, kSize, components); };
  Frame frame;
  frame.indirect = frame.albedo = frame.normal = frame.motion = image(3);
  frame.depth = image(1);
  frame.resetHistory = true;
  frame.camera.projection = glm::mat4(0.0F);
  frame.camera.projection[0][0] = frame.camera.projection[1][1] = 1.0F / kHalfTangent;
  frame.camera.projection[2][2] = frame.camera.projection[2][3] = -1.0F;
  frame.previousProjection = frame.camera.projection;
  HardCase made{std::move(name), {}, image(3), std::vector<std::uint8_t>(frame.depth.pixelCount())};
  Random random;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Point point = scene(x, y, random);
      const auto pixel = static_cast<std::size_t>(y * kSize + x);
      const float sample = -std::log(std::max(0.5F - 0.5F * random(), 1e-7F));
      const bool surface = point.depth < kSkyDepth && point.normal != glm::vec3(0.0F);
      const glm::vec3 unit = surface ? glm::normalize(point.normal) : glm::vec3(0.0F);
      const float light = surface ? point.level * (0.55F + 0.4F * unit.x + 0.3F * unit.y) : 0.0F;
      const glm::vec3 radiance = light * glm::vec3(1.0F, 0.8F, 0.6F);
      for (int c = 0; c < 3; ++c) {
        made.truth.at(x, y, c) = radiance[c];
        frame.indirect.at(x, y, c) = sample * radiance[c];
        frame.normal.at(x, y, c) = point.normal[c];
        frame.albedo.at(x, y, c) = surface ? 0.5F : 0.0F;
      }
      frame.depth.at(x, y, 0) = point.depth;
      made.counted[pixel] = surface ? 1 : 0;
    }
  }
  made.packed.frame = std::move(frame);
  return made;
}

/// A wall whose central sample is replaced.
HardCase withSample(std::string name, float value) {
  HardCase made = make(std::move(name), lit(1.0F));
  for (int c = 0; c < 3; ++c) made.packed.frame.indirect.at(kSize / 2, kSize / 2, c) = value;
  return made;
}

}  // namespace

std::vector<HardCase> hardCases() {
  std::vector<HardCase> cases;
  const auto add = [&](const char* name, const Scene& scene) { cases.push_back(make(name, scene)); };
  add("flat wall", bumpy(0.0F));
  for (const auto& [name, amplitude] : {std::pair{"normals vary by 0.0001", 1e-4F},
                                        {"normals vary by 0.001", 1e-3F},
                                        {"normals vary by 0.01", 1e-2F},
                                        {"normals vary by 0.1", 0.1F},
                                        {"normals vary by 0.3", 0.3F}}) {
    add(name, bumpy(amplitude));
  }
  add("normals of a sphere", sphere);
  add("collinear features", [](int, int, Random& random) {
    const float slope = 0.2F * random();
    return Point{.normal = glm::normalize(glm::vec3(slope, slope, 1.0F))};
  });
  add("one pixel in the sky", [](int x, int y, Random&) { return x == kSize / 2 && y == kSize / 2 ? Point{} : sky(); });
  add("isolated pixels", [](int x, int y, Random& random) {
    return x % 5 == 2 && y % 5 == 2 ? Point{.depth = 1.0F, .level = 0.2F} : bumpy(0.1F)(x, y, random);
  });
  cases.push_back(withSample("firefly of 10,000", 1e4F));
  cases.push_back(withSample("firefly of 60,000", 6e4F));
  cases.push_back(withSample("infinite sample", std::numeric_limits<float>::infinity()));
  cases.push_back(withSample("sample that is not a number", std::numeric_limits<float>::quiet_NaN()));
  cases.push_back(make("normal that is not a number", lit(1.0F)));
  cases.back().packed.frame.normal.at(kSize / 2, kSize / 2, 0) = std::numeric_limits<float>::quiet_NaN();
  cases.back().counted[static_cast<std::size_t>(kSize / 2 * kSize + kSize / 2)] = 0;
  add("no light", lit(0.0F));
  add("radiance of 0.00001", lit(1e-5F));
  add("radiance of 10,000", lit(1e4F));
  add("depth of 0.001", lit(1.0F, 1e-3F));
  add("depth of 1,000,000", lit(1.0F, 1e6F));
  add("both depths",
      [](int x, int y, Random& random) { return lit(1.0F, x < kSize / 2 ? 1e-3F : 1e6F)(x, y, random); });
  add("grazing plane", grazing);
  add("normals on the octahedral fold", onTheFold);
  add("normals of length 2", [](int x, int y, Random& random) {
    Point point = bumpy(0.1F)(x, y, random);
    point.normal *= 2.0F;
    return point;
  });
  for (HardCase& made : cases) made.packed = packFrame(std::move(made.packed.frame));
  return cases;
}

}  // namespace walr
