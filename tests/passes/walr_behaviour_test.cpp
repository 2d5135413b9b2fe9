// Promises of WALR to a host, on a device: constant light, sky, first frames, broken input, repeatability.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/passes/comparison.h"
#include "tests/passes/hard_cases.h"
#include "tests/passes/reference/hash.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/walr_run.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::walr_behaviour_test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(98, 66);
constexpr glm::ivec2 kSmall(42, 34);
const glm::dvec3 kConstant(0.75, 0.5, 1.25);

/// A value is stored as a half six times (accumulation, three iterations, regression, anti-aliasing; or with blocks and
/// two iterations in place of three), and each store may move it by a unit in the last place. Averages of equal values
/// add no error. Raw moments keep constants only where features do not vary, because rounding the averages of products
/// leaves a slope.
double halvesTolerance(double value) {
  return 6.0 * 2.0 * reference::kHalfRoundoff * value;
}

/// Packed light is rounded stochastically unless a mantissa holds it exactly. A mantissa holds the constant, but not
/// the constant with the errors of halves, so the filtered colour errs by a step more. History is then clipped to a box
/// in YCoCg about the mean of such colours. The box's half size is their deviation, or at least 2^-7 of the brightest
/// channel, and three half sizes add up in a channel.
double constantTolerance(double value, const AnyWalr& settings) {
  const double halves = halvesTolerance(value);
  if (!settings.packsAntialiasing()) return halves;
  const double brightest = std::max({kConstant.r, kConstant.g, kConstant.b});
  const double filtered =
      halves + reference::packedStep(brightest + halvesTolerance(brightest), reference::kFilteredBits);
  const double historyShare = 1.0 - 1.0 / double(settings.antialiasing().maxHistory);
  return filtered + historyShare * 3.0 * std::max(filtered, 0x1p-7 * brightest);
}

/// Settings of `walr` without packed light, which keep constants more precisely.
WalrSettings blocksInHalves() {
  WalrSettings settings;
  settings.accumulation.storage = settings.antialiasing.storage = LightStorage::Half;
  return settings;
}

enum class Jitter { None, EveryFrame };

HostFrame constantFrame(const Scene& scene, std::uint32_t index, glm::ivec2 size, Jitter jitter = Jitter::None) {
  const auto at = [](double i) { return glm::dvec3(0.08 * i, -0.03 * i, 0.0); };
  const FrameDescription centred = cameraAt(at(index), at(index - 1.0), size, index);
  return renderFrame(
      scene, jitter == Jitter::EveryFrame ? jittered(centred, index) : centred, size,
      [](glm::dvec3, glm::dvec3) { return kConstant; }, Noise::None);
}

void expectConstant(const WalrStages& stages, const HostFrame& frame, const AnyWalr& settings) {
  Comparison comparison("output");
  reference::forEachPixel(frame.size(), [&](glm::ivec2 p) {
    comparison.compared();
    for (int c = 0; c < 3; ++c) {
      const double expected = frame.lighting[p][c];
      comparison.value(p, "radiance", stages.output[p][c], expected, constantTolerance(expected, settings));
    }
  });
  comparison.expect(0.0);
}

class WalrBehaviourTest : public fg::test::GpuTest {
 protected:
  [[nodiscard]] WalrRun makeRun(glm::ivec2 size, const AnyWalr& settings = robustWalr()) const {
    return {device(), size, settings, {}, false};
  }
};

TEST_F(WalrBehaviourTest, ConstantLightComesBackUnchanged) {
  const auto expectUnchanged = [&](const std::vector<NamedScene>& scenes, const AnyWalr& settings) {
    WalrRun run = makeRun(kSmall, settings);
    for (const NamedScene& named : scenes) {
      SCOPED_TRACE(named.name);
      run.resetHistory();
      for (std::uint32_t i = 0; i < 6; ++i) {
        const HostFrame frame = constantFrame(named.scene, i, kSmall);
        expectConstant(run.frame(frame), frame, settings);
      }
    }
  };
  expectUnchanged(allScenes(), robustWalr());
  expectUnchanged(allScenes(), WalrSettings{});
  expectUnchanged(allScenes(), walrWithoutShare());
  expectUnchanged(allScenes(), blocksInHalves());
  // The preset paper reads history with a bicubic filter and does not clip it, which takes in sky beside a surface.
  // These scenes have none.
  expectUnchanged({{"flat wall", flatWall()}, {"thin bars", thinBars()}}, paperWalr());
}

/// Whether a pixel takes the pass-through: sky or no diffuse lobe.
bool passesThrough(const HostFrame& frame, glm::ivec2 p) {
  return frame.depth[p] > 1e9 || frame.albedo[p] == glm::dvec3(0.0);
}

/// A frame whose pass-through has values that any filter would change, the same in every frame.
HostFrame frameThatPassesThrough(std::uint32_t index) {
  HostFrame frame = renderFrame(skyBesideSurface(), cameraAt({}, {}, kSize, index), kSize);
  int passing = 0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (!passesThrough(frame, p)) return;
    ++passing;
    const int k = p.y * kSize.x + p.x;
    frame.lighting[p] = glm::dvec3(reference::roundToHalf(0.01 * k), 3.0 * (k % 2), 0x1p-20);
  });
  EXPECT_GT(passing, 333);
  return frame;
}

TEST_F(WalrBehaviourTest, SkyAndPixelsWithoutDiffuseLobeKeepEveryBit) {
  for (const AnyWalr& settings : {AnyWalr(robustWalr()), AnyWalr(blocksInHalves())}) {
    WalrRun run = makeRun(kSize, settings);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const HostFrame frame = frameThatPassesThrough(i);
      const WalrStages stages = run.frame(frame);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        if (!passesThrough(frame, p)) return;
        EXPECT_EQ(glm::dvec3(stages.output[p]), frame.lighting[p]) << p.x << ", " << p.y;
      });
    }
  }
}

// Packed light of the pass-through is rounded to nearest, in every frame alike.
TEST_F(WalrBehaviourTest, PackedSkyAndPixelsWithoutDiffuseLobeAreRoundedToNearestAndDoNotFlicker) {
  WalrRun run = makeRun(kSize, WalrSettings{});
  std::vector<std::uint16_t> firstBits;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const HostFrame frame = frameThatPassesThrough(i);
    const WalrStages stages = run.frame(frame);
    if (i == 0) firstBits = stages.outputBits;
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      if (!passesThrough(frame, p)) return;
      SCOPED_TRACE(std::to_string(p.x) + ", " + std::to_string(p.y));
      const glm::dvec3 light = frame.lighting[p];
      for (int c = 0; c < 3; ++c) {
        const double tolerance = reference::passThroughError(light[c], std::max({light.r, light.g, light.b}));
        EXPECT_NEAR(stages.output[p][c], light[c], tolerance);
        const std::size_t texel = 4 * (std::size_t(p.y) * kSize.x + p.x) + c;
        EXPECT_EQ(stages.outputBits[texel], firstBits[texel]);
      }
    });
  }
}

TEST_F(WalrBehaviourTest, TheSkysLightStaysInTheSky) {
  for (AnyWalr settings : {AnyWalr(robustWalr()), AnyWalr(WalrSettings{}), AnyWalr(blocksInHalves())}) {
    for (const bool spatialOnly : {false, true}) {
      SCOPED_TRACE(spatialOnly ? "single frame" : "with history");
      settings.change([&](auto& s) { s.spatialOnly = spatialOnly; });
      WalrRun run = makeRun(kSmall, settings);
      HostFrame frame = constantFrame(skyBesideSurface(), 0, kSmall);
      for (std::size_t i = 0; i < frame.depth.pixels().size(); ++i)
        if (frame.depth.pixels()[i] > 1e9) frame.lighting.pixels()[i] = glm::dvec3(1000.0);
      expectConstant(run.frame(frame), frame, settings);
    }
  }
}

/// Variance of the output relative to its squared mean, for constant light.
double relativeVariance(const WalrStages& stages) {
  double sum = 0.0;
  double squares = 0.0;
  for (const glm::dvec4& v : stages.output.pixels()) {
    sum += v.g;
    squares += v.g * v.g;
  }
  const double count = double(stages.output.pixels().size());
  const double mean = sum / count;
  return squares / count / (mean * mean) - 1.0;
}

// In a corner of the image, which is 64 pixels high, four iterations average at least a quarter of their window, 41 x
// 41 pixels. Replaced taps count samples again, up to four times along a border. A sample's relative variance is 1, so
// at most 4 / 41^2 remains.
TEST_F(WalrBehaviourTest, FirstFramesAreDenoisedSpatially) {
  const auto noisy = [](std::uint32_t index) {
    return renderFrame(
        flatWall(), cameraAt({}, {}, kSize, index), kSize, [](glm::dvec3, glm::dvec3) { return kConstant; },
        Noise::Exponential);
  };
  WalrRun run = makeRun(kSize);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_LE(relativeVariance(run.frame(noisy(i))), 4.0 / (41.0 * 41.0)) << i;
  run.resetHistory();
  const WalrStages afterReset = run.frame(noisy(7));
  EXPECT_LE(relativeVariance(afterReset), 4.0 / (41.0 * 41.0));
  // The reset leaves nothing of the frames before.
  WalrRun fresh = makeRun(kSize);
  EXPECT_EQ(afterReset.outputBits, fresh.frame(noisy(7)).outputBits);
}

TEST_F(WalrBehaviourTest, TwoRunsGiveTheSameBits) {
  for (const AnyWalr& settings : {AnyWalr(robustWalr()), AnyWalr(paperWalr()), AnyWalr(WalrSettings{})}) {
    WalrRun first = makeRun(kSmall, settings);
    WalrRun second = makeRun(kSmall, settings);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const HostFrame frame =
          renderFrame(thinBars(), cameraAt({0.05 * i, 0.0, 0.0}, {0.05 * (i - 1.0), 0.0, 0.0}, kSmall, i), kSmall);
      EXPECT_EQ(first.frame(frame).outputBits, second.frame(frame).outputBits);
    }
  }
}

/// A broken value in one of the inputs.
struct Damage {
  const char* name;
  std::function<void(HostFrame&, glm::ivec2)> apply;
};

std::vector<Damage> allDamage() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{"lighting NaN", [](HostFrame& f, glm::ivec2 p) { f.lighting[p].g = kNaN; }},
          {"lighting inf", [](HostFrame& f, glm::ivec2 p) { f.lighting[p] = glm::dvec3(kInfinity); }},
          {"lighting -inf", [](HostFrame& f, glm::ivec2 p) { f.lighting[p].b = -kInfinity; }},
          {"depth NaN", [](HostFrame& f, glm::ivec2 p) { f.depth[p] = kNaN; }},
          {"depth inf", [](HostFrame& f, glm::ivec2 p) { f.depth[p] = kInfinity; }},
          {"depth 0", [](HostFrame& f, glm::ivec2 p) { f.depth[p] = 0.0; }},
          {"depth negative", [](HostFrame& f, glm::ivec2 p) { f.depth[p] = -3.0; }},
          {"depth subnormal", [](HostFrame& f, glm::ivec2 p) { f.depth[p] = 0x1p-140; }},
          {"depth smallest", [](HostFrame& f, glm::ivec2 p) { f.depth[p] = 0x1p-126; }},
          {"depth whose square vanishes", [](HostFrame& f, glm::ivec2 p) { f.depth[p] = 0x1p-70; }},
          {"normal NaN", [](HostFrame& f, glm::ivec2 p) { f.normal[p].x = kNaN; }},
          {"normal inf", [](HostFrame& f, glm::ivec2 p) { f.normal[p].z = kInfinity; }},
          {"normal zero", [](HostFrame& f, glm::ivec2 p) { f.normal[p] = glm::dvec3(0.0); }},
          {"motion NaN", [](HostFrame& f, glm::ivec2 p) { f.motion[p].x = kNaN; }},
          {"motion inf", [](HostFrame& f, glm::ivec2 p) { f.motion[p].y = kInfinity; }},
          {"motion depth NaN", [](HostFrame& f, glm::ivec2 p) { f.motion[p].z = kNaN; }},
          {"motion depth -inf", [](HostFrame& f, glm::ivec2 p) { f.motion[p].z = -kInfinity; }},
          {"albedo NaN", [](HostFrame& f, glm::ivec2 p) { f.albedo[p].r = kNaN; }},
          {"albedo inf", [](HostFrame& f, glm::ivec2 p) { f.albedo[p].b = kInfinity; }}};
}

// Under constant light, any effect of a broken value on another pixel shows. All other pixels must keep the constant,
// in the same frame and in the following ones.
TEST_F(WalrBehaviourTest, BrokenInputStaysFiniteAndDoesNotSpread) {
  const glm::ivec2 broken(19, 13);
  // The raw moments of the preset paper keep a constant only on a flat wall.
  struct Case {
    AnyWalr settings;
    Scene scene;
    Jitter jitter;
  };
  const Case cases[] = {
      {robustWalr(), bumpyWall(0.1), Jitter::None},         {WalrSettings{}, bumpyWall(0.1), Jitter::None},
      {WalrSettings{}, bumpyWall(0.1), Jitter::EveryFrame}, {blocksInHalves(), bumpyWall(0.1), Jitter::EveryFrame},
      {walrWithoutShare(), bumpyWall(0.1), Jitter::None},   {paperWalr(), flatWall(), Jitter::None}};
  for (const auto& [settings, scene, jitter] : cases) {
    WalrRun run = makeRun(kSmall, settings);
    for (const Damage& damage : allDamage()) {
      SCOPED_TRACE(damage.name);
      run.resetHistory();
      for (std::uint32_t i = 0; i < 4; ++i) {
        SCOPED_TRACE(i);
        HostFrame frame = constantFrame(scene, i, kSmall, jitter);
        if (i == 1) damage.apply(frame, broken);
        const WalrStages stages = run.frame(frame);
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(stages.output[broken][c]));
        // The pixel itself may take the pass-through like sky, where a value that is not finite becomes 0.
        HostFrame expected = frame;
        expected.lighting[broken] = i == 1 ? glm::dvec3(stages.output[broken]) : kConstant;
        expectConstant(stages, expected, settings);
      }
    }
  }
}

// A share of the first frame's pixels has no sample. Only the light of the others may show. The share is drawn anew in
// each channel, so that a sample counted as black in one of them would also show as a tint.
TEST_F(WalrBehaviourTest, PixelsWithoutASampleDoNotDarken) {
  WalrPaperSettings raw11 = paperWalr();
  raw11.regression.storage = MomentStorage::Raw11;
  raw11.regression.regularisation.ridge = 1e-2F;
  for (const double share : {0.1, 0.5}) {
    for (const AnyWalr& settings : {AnyWalr(robustWalr()), AnyWalr(paperWalr()), AnyWalr(raw11),
                                    AnyWalr(WalrSettings{}), AnyWalr(blocksInHalves())}) {
      const WalrPaperSettings* const pixels = settings.pixels();
      SCOPED_TRACE(std::to_string(share) + ", " +
                   (pixels ? "storage " + std::to_string(int(pixels->regression.storage)) : "blocks"));
      WalrRun run = makeRun(kSmall, settings);
      HostFrame frame = constantFrame(flatWall(), 0, kSmall);
      int without = 0;
      reference::forEachPixel(kSmall, [&](glm::ivec2 p) {
        const glm::uvec4 dice = reference::pcg4d({p, 17, 3});
        if (dice.x * 0x1p-32 >= share) return;
        ++without;
        frame.lighting[p][int(dice.y % 3)] = std::numeric_limits<double>::quiet_NaN();
      });
      EXPECT_GT(without, int(0.8 * share * kSmall.x * kSmall.y));
      const WalrStages stages = run.frame(frame);
      const auto tolerance = [&](double value) {
        const bool raw11 = pixels != nullptr && pixels->regression.storage == MomentStorage::Raw11;
        return raw11 ? 6.0 * reference::kFloat10Roundoff * value : constantTolerance(value, settings);
      };
      for (const glm::dvec4& v : stages.output.pixels())
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(v[c], kConstant[c], tolerance(kConstant[c]));
    }
  }
}

TEST_F(WalrBehaviourTest, AFirstFrameWithoutSamplesIsBlackAndTheNextOneFinite) {
  for (const AnyWalr& settings : {AnyWalr(robustWalr()), AnyWalr(WalrSettings{})}) {
    WalrRun run = makeRun(kSmall, settings);
    HostFrame frame = constantFrame(bumpyWall(0.1), 0, kSmall);
    for (glm::dvec3& l : frame.lighting.pixels()) l = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    const WalrStages first = run.frame(frame);
    for (const glm::dvec4& v : first.output.pixels()) EXPECT_EQ(glm::dvec3(v), glm::dvec3(0.0));
    const HostFrame next = constantFrame(bumpyWall(0.1), 1, kSmall);
    const WalrStages stages = run.frame(next);
    for (const glm::dvec4& v : stages.output.pixels()) EXPECT_TRUE(std::isfinite(v.r));
  }
}

// Tests of the stages compare `robust` with its reference on these cases. The output of blocks must be finite and never
// negative.
TEST_F(WalrBehaviourTest, BlocksAreFiniteAndNotNegativeOnHardCases) {
  const std::vector<HardCase> cases = hardCases();
  WalrRun run = makeRun(cases.front().frames.front().size(), WalrSettings{});
  for (const HardCase& hard : cases) {
    SCOPED_TRACE(hard.name);
    run.resetHistory();
    for (const HostFrame& frame : hard.frames) {
      const WalrStages stages = run.frame(frame);
      for (const glm::dvec4& v : stages.output.pixels()) {
        for (int c = 0; c < 3; ++c) {
          ASSERT_TRUE(std::isfinite(v[c]));
          ASSERT_GE(v[c], 0.0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace walr::test::walr_behaviour_test
