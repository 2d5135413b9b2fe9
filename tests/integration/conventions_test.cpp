// One scene, written by hosts with different conventions, gives the same result.
#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <map>
#include <random>

#include <glm/packing.hpp>

#include "tests/integration/hosted_run.h"
#include "tests/passes/comparison.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::conventions_test {
namespace {

using reference::forEachPixel;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(48, 36);
constexpr const char* kMethod = "svgf";  // Reads every input, and has few pipelines to create for each host.
constexpr std::uint32_t kFrames = 4;
constexpr glm::ivec2 kOffset(5, 3);
constexpr glm::ivec2 kMargin(18, 9);

/// The frames that a host renders.
struct Take {
  bool jittered = false;  ///< Samples are off the pixel centres.
  bool skips = false;     ///< The host denoises only some of the frames.

  friend auto operator<=>(const Take&, const Take&) = default;
};

/// The conventions of a host.
struct Host {
  Take take = {};
  WalrDepth depth = WALR_DEPTH_LINEAR;
  bool reversedInfinite = false;  ///< Device depth: 1 near, 0 at infinity; otherwise 0 near, 1 at a far plane.
  WalrNormals normals = WALR_NORMALS_SIGNED;
  bool world = false;
  bool pictures = false;       ///< Motion is in UV.
  bool motionForward = false;  ///< Motion is current - previous.
  bool motionUp = false;       ///< Motion has y up.
  bool motionDepthReversed = false;
  bool motionDepthFound = false;  ///< Motion has two channels.
  bool motionJittered = false;    ///< Motion includes the jitter of both frames.
  bool preExposed = false;
  bool rectangle = false;   ///< Only a rectangle of the images is denoised.
  bool remembered = false;  ///< The library remembers the previous camera.
};

/// A rotated camera that moves: view and world space differ, and motion has both signs.
FrameDescription walkingCamera(const Take& take, std::uint32_t frame) {
  const glm::dvec3 step(0.05, 0.03, -0.04);
  const auto timeOf = [&](std::uint32_t n) { return take.skips ? double(n * (n + 1)) / 3.0 : double(n); };
  const std::uint32_t before = frame > 0 ? frame - 1 : 0;
  FrameDescription camera = cameraAt(timeOf(frame) * step, timeOf(before) * step, kSize, frame);
  const auto jitterOf = [&](std::uint32_t n) {
    return take.jittered ? glm::vec2(n % 2 == 0 ? 0.25F : -0.375F, n % 3 == 0 ? -0.3125F : 0.125F) : glm::vec2(0.0F);
  };
  camera.jitter = jitterOf(frame);
  camera.previousJitter = jitterOf(before);
  return camera;
}

std::string nameOf(const Host& h) {
  return std::string(h.take.jittered ? "jittered, " : "") + (h.take.skips ? "skipping, " : "") + "depth " +
         std::to_string(h.depth) + (h.reversedInfinite ? " reversed" : "") + ", normals " + std::to_string(h.normals) +
         (h.world ? " world" : "") + (h.pictures ? ", pictures" : "") + (h.motionForward ? ", forward" : "") +
         (h.motionUp ? ", up" : "") + (h.motionDepthReversed ? ", z reversed" : "") +
         (h.motionDepthFound ? ", z found" : "") + (h.motionJittered ? ", motion jittered" : "") +
         (h.preExposed ? ", exposed" : "") + (h.rectangle ? ", rectangle" : "") + (h.remembered ? ", remembered" : "");
}

float exposureOf(const Host& host, std::uint32_t frame) {
  return host.preExposed ? std::exp2(float(frame) - 1.0F) : 1.0F;
}

/// The scene's rotation from view to world: three eighths of a turn about one axis and one about another. Normals
/// towards the camera then point down the world's z axis, where octahedral normals are folded.
glm::dmat3 worldFromView() {
  const double c = std::sqrt(0.5);
  return glm::dmat3(-c, 0, -c, 0, 1, 0, c, 0, -c) * glm::dmat3(1, 0, 0, 0, c, c, 0, -c, c);
}

constexpr float kNear = 0.5F;
constexpr float kFar = 200.0F;

FrameDescription cameraOf(const Host& host, std::uint32_t frame) {
  FrameDescription camera = walkingCamera(host.take, frame);
  // The scene is defined in a world with the axes of view space; rotate that world.
  const glm::mat4 turn(glm::mat3(glm::transpose(worldFromView())));
  camera.view = camera.view * turn;
  camera.previousView = camera.previousView * turn;
  for (glm::mat4* projection : {&camera.projection, &camera.previousProjection}) {
    (*projection)[2][2] = host.reversedInfinite ? 0.0F : kFar / (kNear - kFar);
    (*projection)[3][2] = host.reversedInfinite ? kNear : kNear * kFar / (kNear - kFar);
  }
  return camera;
}

float writtenDepth(const Host& host, double depth, const glm::mat4& projection) {
  if (host.depth == WALR_DEPTH_NEGATIVE_LINEAR) return static_cast<float>(-depth);
  if (host.depth == WALR_DEPTH_LINEAR) return static_cast<float>(depth);
  if (!std::isfinite(depth) || depth >= kFar) return host.reversedInfinite ? 0.0F : 1.0F;
  return static_cast<float>(double(projection[3][2]) / depth - double(projection[2][2]));
}

glm::vec4 writtenNormal(const Host& host, glm::dvec3 n) {
  if (n == glm::dvec3(0.0)) return glm::vec4(0.0F);
  if (host.world) n = worldFromView() * n;
  if (host.normals == WALR_NORMALS_OCTAHEDRAL_SIGNED || host.normals == WALR_NORMALS_OCTAHEDRAL_UNSIGNED) {
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const glm::dvec2 folded((1.0 - std::abs(n.y)) * (n.x < 0.0 ? -1.0 : 1.0),
                            (1.0 - std::abs(n.x)) * (n.y < 0.0 ? -1.0 : 1.0));
    n = glm::dvec3(n.z < 0.0 ? folded : glm::dvec2(n), 0.0);
  }
  const bool isUnsigned = host.normals == WALR_NORMALS_UNSIGNED || host.normals == WALR_NORMALS_OCTAHEDRAL_UNSIGNED;
  return {glm::vec3(isUnsigned ? n * 0.5 + 0.5 : n), 0.0F};
}

glm::vec4 writtenMotion(const Host& host, glm::dvec3 motion, glm::dvec2 jitterDelta) {
  if (!host.motionJittered) motion -= glm::dvec3(jitterDelta, 0.0);
  if (host.pictures) motion /= glm::dvec3(kSize, 1.0);
  if (host.motionForward) motion *= glm::dvec3(-1.0, -1.0, 1.0);
  if (host.motionUp) motion.y = -motion.y;
  if (host.motionDepthReversed) motion.z = -motion.z;
  return {glm::vec3(motion), 0.0F};
}

HostedRun::Options optionsOf(const Host& host) {
  HostedRun::Options options;
  WalrConventions& c = options.conventions;
  c.depth = host.depth;
  c.normals = host.normals;
  c.normal_space = host.world ? WALR_SPACE_WORLD : WALR_SPACE_VIEW;
  c.motion_unit = host.pictures ? WALR_MOTION_PICTURES : WALR_MOTION_PIXELS;
  c.motion_depth = host.motionDepthFound      ? WALR_MOTION_DEPTH_FOUND
                   : host.motionDepthReversed ? WALR_MOTION_DEPTH_REVERSED
                                              : WALR_MOTION_DEPTH_GIVEN;
  c.motion_scale[0] = host.motionForward ? -1.0F : 1.0F;
  c.motion_scale[1] = c.motion_scale[0] * (host.motionUp ? -1.0F : 1.0F);
  c.pre_exposed = host.preExposed ? VK_TRUE : VK_FALSE;
  c.motion_jittered = host.motionJittered ? VK_TRUE : VK_FALSE;
  options.rememberedCamera = host.remembered;
  if (host.rectangle) {
    options.offset = kOffset;
    options.margin = kMargin;
  }
  // 32-bit floats, so that the test compares conversions and not the host's rounding.
  constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
  options.formats = {kFloats, VK_FORMAT_R32_SFLOAT, kFloats, kFloats, kFloats};
  if (host.motionDepthFound) options.formats[3] = VK_FORMAT_R32G32_SFLOAT;
  return options;
}

void fill(HostedRun& run, const HostFrame& frame, const Host& host, const FrameDescription& camera, float exposure,
          double depthError) {
  std::vector<glm::vec4> lighting;
  std::vector<float> depth;
  std::vector<glm::vec4> normal;
  std::vector<glm::vec4> motion;
  std::vector<glm::vec4> albedo;
  forEachPixel(kSize, [&](glm::ivec2 p) {
    lighting.emplace_back(glm::vec3(frame.lighting[p]) * exposure, 0.0F);
    depth.push_back(writtenDepth(host, frame.depth[p] * (1.0 + depthError), camera.projection));
    normal.push_back(writtenNormal(host, frame.normal[p]));
    motion.push_back(writtenMotion(host, frame.motion[p], frame.constants.jitterDelta));
    albedo.emplace_back(glm::vec3(frame.albedo[p]), 0.0F);
  });
  const glm::ivec2 offset = host.rectangle ? kOffset : glm::ivec2(0);
  const auto hand = [&](const char* name, const auto& texels) {
    // Fill the surroundings of the rectangle with NaN.
    using Texel = std::decay_t<decltype(texels[0])>;
    const Texel around(std::numeric_limits<float>::quiet_NaN());
    run.fill(name, placed(texels, kSize, run.imageSize(), offset, around));
  };
  hand("lighting", lighting);
  hand("depth", depth);
  hand("normal", normal);
  if (host.motionDepthFound) {
    hand("motion", std::vector<glm::vec2>(motion.begin(), motion.end()));
  } else {
    hand("motion", motion);
  }
  hand("albedo", albedo);
}

class Conventions : public fg::test::GpuTest {
 protected:
  /// The last frame's result, divided by the exposure.
  Image<glm::dvec4> denoise(const Host& host, double depthError = 0.0) const {
    return denoise(host, optionsOf(host), depthError);
  }
  Image<glm::dvec4> denoise(const Host& host, const HostedRun::Options& options, double depthError) const {
    HostedRun run(device(), kMethod, kSize, options);
    Image<glm::dvec4> result(kSize);
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const FrameDescription camera = cameraOf(host, i);
      const float exposure = exposureOf(host, i);
      const HostFrame frame = renderFrame(skyBesideSurface(), walkingCamera(host.take, i), kSize);
      fill(run, frame, host, camera, exposure, depthError);
      const std::vector<std::uint16_t> texels = run.frame(camera, 0, host.preExposed ? exposure : 0.0F);
      const Image<glm::dvec4> image = decodeHalves(texels, run.imageSize());
      forEachPixel(kSize, [&](glm::ivec2 p) { result[p] = image[p + options.offset] / double(exposure); });
    }
    return result;
  }
};

// Exposed light is within the range of halves, but the light itself is not, as in daylight in physical units.
TEST_F(Conventions, LightAboveTheLargestHalfCountsAsThat) {
  const Host host{.preExposed = true};
  HostedRun run(device(), kMethod, kSize, optionsOf(host));
  const FrameDescription camera = cameraOf(host, 0);
  HostFrame frame = renderFrame(skyBesideSurface(), walkingCamera(host.take, 0), kSize);
  for (glm::dvec3& light : frame.lighting.pixels()) light = glm::dvec3(2e5);
  constexpr float kExposure = 1e-5F;
  fill(run, frame, host, camera, kExposure, 0.0);
  const Image<glm::dvec4> result = decodeHalves(run.frame(camera, 0, kExposure), run.imageSize());
  // The largest half is stored exactly between passes; only the exposed result is rounded.
  const double expected = reference::kLargestHalf * double(kExposure);
  const double tolerance = halfTolerance(expected, 0.0);
  forEachPixel(kSize, [&](glm::ivec2 p) { EXPECT_NEAR(result[p].x, expected, tolerance) << p.x << " " << p.y; });
}

/// Root mean square difference of colours.
double difference(const Image<glm::dvec4>& a, const Image<glm::dvec4>& b) {
  double sum = 0.0;
  forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 d = glm::dvec3(a[p]) - glm::dvec3(b[p]);
    sum += glm::dot(d, d);
  });
  return std::sqrt(sum / (3.0 * kSize.x * kSize.y));
}

std::vector<Host> hosts() {
  std::vector<Host> all{
      {.depth = WALR_DEPTH_NEGATIVE_LINEAR},
      {.depth = WALR_DEPTH_DEVICE},
      {.depth = WALR_DEPTH_DEVICE, .reversedInfinite = true},
      {.normals = WALR_NORMALS_UNSIGNED},
      {.normals = WALR_NORMALS_OCTAHEDRAL_SIGNED},
      {.normals = WALR_NORMALS_OCTAHEDRAL_UNSIGNED},
      {.normals = WALR_NORMALS_OCTAHEDRAL_SIGNED, .world = true},
      {.world = true},
      {.pictures = true},
      {.motionForward = true},
      {.motionUp = true},
      {.motionDepthReversed = true},
      {.motionDepthFound = true},
      {.pictures = true, .motionDepthFound = true, .rectangle = true},
      {.preExposed = true},
      {.rectangle = true},
      {.remembered = true},
      {.take = {.jittered = true}, .motionJittered = true},
      {.take = {.jittered = true}, .remembered = true},
      {.take = {.skips = true}, .remembered = true},
  };
  std::mt19937 random(7);
  const auto coin = [&] { return random() % 2 == 0; };
  for (int i = 0; i < 16; ++i) {
    all.push_back({.take = {.jittered = coin(), .skips = coin()},
                   .depth = static_cast<WalrDepth>(random() % 3),
                   .reversedInfinite = coin(),
                   .normals = static_cast<WalrNormals>(random() % 4),
                   .world = coin(),
                   .pictures = coin(),
                   .motionForward = coin(),
                   .motionUp = coin(),
                   .motionDepthReversed = coin(),
                   .motionJittered = coin(),
                   .preExposed = coin(),
                   .rectangle = coin(),
                   .remembered = coin()});
  }
  return all;
}

/// The result of a host with walr's own conventions, and the tolerance for rounding.
struct Usual {
  Image<glm::dvec4> result;
  double roundoff = 0.0;
};

TEST_F(Conventions, OneSceneGivesOneResult) {
  std::map<Take, Usual> usual;
  for (const Host& host : hosts()) {
    const Host plain{.take = host.take};
    Usual& expected = usual[host.take];
    if (expected.roundoff == 0.0) {
      expected.result = denoise(plain);
      // The tolerance is the effect of one rounding step of packed depth, of which surface.glsl keeps 19 bits.
      // Conversions round in single precision, which is finer. A wrong convention gives a far larger difference.
      expected.roundoff = std::max(difference(expected.result, denoise(plain, 0x1p-18)),
                                   difference(expected.result, denoise(plain, -0x1p-18)));
      ASSERT_GT(expected.roundoff, 0.0);
    }
    EXPECT_LE(difference(expected.result, denoise(host)), 2.0 * expected.roundoff) << nameOf(host);
  }
  EXPECT_EQ(usual.size(), 4U);

  // The test detects a wrongly stated convention.
  const auto misstated = [&](const Host& host, auto&& misstate) {
    HostedRun::Options options = optionsOf(host);
    misstate(options);
    return difference(usual[host.take].result, denoise(host, options, 0.0)) / usual[host.take].roundoff;
  };
  EXPECT_GT(misstated({.motionForward = true}, [](auto& o) { o.conventions.motion_scale[0] = 1.0F; }), 10.0);
  EXPECT_GT(misstated({.take = {.jittered = true}}, [](auto& o) { o.conventions.motion_jittered = VK_TRUE; }), 10.0);
  EXPECT_GT(misstated({.rectangle = true}, [](auto& o) { o.offset.x += 1; }), 10.0);
}

}  // namespace
}  // namespace walr::test::conventions_test
