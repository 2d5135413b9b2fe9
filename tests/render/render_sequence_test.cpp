// `walr render`: from a scene to files that `walr denoise` can read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "samples/denoise/gpu_linter.h"
#include "samples/errors.h"
#include "samples/image/exr.h"
#include "samples/metrics/metrics.h"
#include "samples/render/instance.h"
#include "samples/render/load_scene.h"
#include "samples/render/reference.h"
#include "samples/render/render_sequence.h"
#include "samples/sequence/sequence.h"
#include "samples/sequence/writer.h"
#include "tests/error_text.h"
#include "tests/render/statistics.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render {
namespace {

namespace fs = std::filesystem;

RenderOptions smallBox(const fs::path& output) {
  RenderOptions options;
  options.scene = WALR_SCENES "/box.gltf";
  options.output = output;
  options.firstFrame = 3;
  options.lastFrame = 5;
  options.width = 32;
  options.height = 18;
  options.referenceSamples = 4;
  return options;
}

std::vector<std::string> render(const RenderOptions& options) {
  std::vector<std::string> lines;
  RenderObserver observer;
  observer.fileDone = [&](const std::string& line) { lines.push_back(line); };
  renderSequence(options, observer);
  EXPECT_EQ(lines.size(), options.files());
  return lines;
}

TEST(RenderSequence, IsReadBackInTheProjectsConventions) {
  const walr::test::TemporaryDirectory folder;
  render(smallBox(folder.path()));
  SequenceOptions options;
  options.light = kWholePicture;
  const Sequence sequence(folder.path(), options);
  ASSERT_EQ(sequence.entries().size(), 3U);
  EXPECT_TRUE(sequence.hasReferences());
  EXPECT_EQ(sequence.layout().layout, &projectLayout());
  // The camera starts to move in frame 4: that is motion, not a cut.
  EXPECT_FALSE(sequence.entries()[1].resetHistory);
  EXPECT_EQ(sequence.entries()[0].camera.view, sequence.entries()[0].camera.previousView);
  EXPECT_NE(sequence.entries()[1].camera.view, sequence.entries()[1].camera.previousView);
  EXPECT_EQ(sequence.entries()[1].camera.previousView, sequence.entries()[0].camera.view);

  const Frame frame = sequence.read(1);
  int sky = 0;
  double light = 0.0;
  for (std::size_t i = 0; i < frame.depth.pixelCount(); ++i) {
    const auto normal = frame.normal.pixel(i);
    const float squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    if (frame.depth.pixel(i)[0] >= kSkyDepth) {
      ++sky;
      EXPECT_EQ(squared, 0.0F);
      EXPECT_GT(frame.emission.pixel(i)[2], 0.0F);
    } else {
      // The tolerance is the rounding error of three half floats, with 11 bits each.
      EXPECT_NEAR(squared, 1.0F, 3e-3F);
    }
    light += frame.reference->indirect.pixel(i)[0];
  }
  EXPECT_GT(sky, 0);
  EXPECT_GT(light, 0.0);
  EXPECT_TRUE(frame.nonFinite.empty());
}

// The error of a frame against a reference that holds its own paths would be too small. The same number of samples
// gives light of the same mean and of other noise.
TEST(RenderSequence, ReferencesHoldOtherPathsThanNoisyFrames) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path());
  options.sampler = Sampler::Kind::Independent;
  options.samples = options.referenceSamples = 1;
  render(options);
  SequenceOptions composite;
  composite.light = kWholePicture;
  const Frame frame = Sequence(folder.path(), composite).read(0);
  int lit = 0, equal = 0;
  for (std::size_t i = 0; i < frame.indirect.pixelCount(); ++i) {
    const float light = frame.indirect.pixel(i)[0];
    lit += light > 0.0F ? 1 : 0;
    equal += light > 0.0F && light == frame.reference->indirect.pixel(i)[0] ? 1 : 0;
  }
  EXPECT_GT(lit, 100);
  EXPECT_EQ(equal, 0);
}

// Pixels without a sample have no indirect light; guides and direct light do not change.
TEST(RenderSequence, WritesSparseLight) {
  const walr::test::TemporaryDirectory full;
  const walr::test::TemporaryDirectory sparse;
  RenderOptions options = smallBox(full.path());
  options.sampler = Sampler::Kind::Independent;
  options.referenceSamples = 0;
  render(options);
  options.output = sparse.path();
  options.light = {.columns = 3, .rows = 3};
  render(options);
  SequenceOptions composite;
  composite.light = kWholePicture;
  const Sequence before(full.path(), composite);
  const Sequence sequence(sparse.path(), composite);
  std::set<std::pair<int, int>> offsets;
  for (std::size_t i = 0; i < sequence.entries().size(); ++i) {
    const Frame frame = sequence.read(i);
    EXPECT_EQ(frame.light, options.light);
    offsets.emplace(frame.lightOffset.x, frame.lightOffset.y);
    int lit = 0;
    for (int y = 0; y < frame.indirect.height(); ++y) {
      for (int x = 0; x < frame.indirect.width(); ++x) {
        const bool isLit = frame.indirect.at(x, y, 0) > 0.0F;
        const bool hasSample = x % 3 == frame.lightOffset.x && y % 3 == frame.lightOffset.y;
        ASSERT_FALSE(isLit && !hasSample) << x << ", " << y;
        lit += isLit ? 1 : 0;
      }
    }
    EXPECT_GT(lit, 0);
    EXPECT_TRUE(std::ranges::equal(frame.depth.values(), before.read(i).depth.values()));
    double direct = 0.0;
    for (const float value : frame.direct.values()) direct += value > 0.0F ? 1.0 : 0.0;
    EXPECT_GT(direct, 0.5 * static_cast<double>(frame.direct.values().size()));
  }
  EXPECT_EQ(offsets.size(), sequence.entries().size());
}

std::vector<std::string> namesOf(const std::vector<LintFinding>& findings) {
  std::vector<std::string> names;
  for (const LintFinding& finding : findings) names.emplace_back(finding.name);
  return names;
}

// Frames of a scene with metals pass the linter; each change that a host makes by mistake is found.
TEST(RenderSequence, WritesSpecularLightThatPassesTheLinter) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path());
  options.scene = WALR_SCENES "/gloss.gltf";
  options.width = 96;
  options.height = 54;
  options.specular = true;
  options.lastFrame = options.firstFrame;
  options.referenceSamples = 2;
  render(options);
  SequenceOptions reading;
  reading.light.specular = SpecularWish::IfHeld;
  const Sequence sequence(folder.path(), reading);
  const Frame frame = sequence.read(0);
  EXPECT_FALSE(frame.reference->specular.empty());
  EXPECT_FALSE(frame.reference->specularHalf.empty());
  for (std::size_t i = 0; i < frame.depth.pixelCount(); ++i) {
    const bool sky = frame.depth.pixel(i)[0] >= kSkyDepth;
    EXPECT_EQ(frame.specularDistance.pixel(i)[0] > 0.0F, !sky);
    EXPECT_EQ(frame.specularAlbedo.pixel(i)[0] >= 0.0199F, !sky);
  }
  ASSERT_FALSE(frame.specularMotion.empty());
  struct Case {
    std::vector<std::string> names;
    std::function<void(Frame&)> change;
  };
  const auto eachRoughness = [](Frame& spoiled, float (*change)(float)) {
    for (float& value : spoiled.roughness.values()) value = change(value);
  };
  const std::vector<Case> cases = {
      {{}, [](Frame&) {}},
      {{"specular-albedo-in-light"},
       [](Frame& spoiled) {
         const auto albedo = spoiled.specularAlbedo.values();
         for (std::size_t i = 0; i < albedo.size(); ++i) spoiled.specular.values()[i] *= albedo[i];
       }},
      {{"roughness-encoding"}, [&](Frame& spoiled) { eachRoughness(spoiled, [](float r) { return r * r; }); }},
      {{"roughness-encoding"}, [&](Frame& spoiled) { eachRoughness(spoiled, [](float r) { return std::sqrt(r); }); }},
      {{"roughness-range"}, [&](Frame& spoiled) { eachRoughness(spoiled, [](float r) { return 100.0F * r; }); }},
      {{"specular-distance"}, [](Frame& spoiled) { spoiled.specularDistance.at(9, 40, 0) = -1.0F; }},
      {{"specular-not-finite"}, [](Frame& spoiled) { spoiled.specularDistance.at(9, 40, 0) = NAN; }},
      {{"specular-not-finite"}, [](Frame& spoiled) { spoiled.specularMotion.at(9, 40, 2) = NAN; }},
      {{"lobes-swapped"}, [](Frame& spoiled) { std::swap(spoiled.specular, spoiled.indirect); }},
      {{"specular-negative"}, [](Frame& spoiled) { spoiled.specular.at(9, 40, 1) = -1.0F; }},
  };
  GpuDevice device({.device = {}, .validation = true});
  for (const Case& spoilt : cases) {
    Frame spoiled = frame;
    spoilt.change(spoiled);
    GpuLinter linter(device, sequence.extent(), projectLayout());
    linter.add(spoiled);
    EXPECT_EQ(namesOf(linter.findings()), spoilt.names);
  }
  // Another albedo does not tell how roughness is written.
  Layout otherAlbedo = projectLayout();
  otherAlbedo.ownSpecularAlbedo = false;
  Frame squared = frame;
  eachRoughness(squared, [](float r) { return r * r; });
  GpuLinter linter(device, sequence.extent(), otherAlbedo);
  linter.add(squared);
  EXPECT_EQ(namesOf(linter.findings()), std::vector<std::string>{});
  device.refuseMessages();
  // A folder with the light is not continued without it.
  options.specular = false;
  fg::test::expectError<InputError>([&] { render(options); }, {"'specular'"});
}

// What reflections show moves only where an object does.
TEST(RenderSequence, WritesTheMotionOfWhatIsReflected) {
  for (const auto& [scene, moves] : {std::pair("turntable.gltf", true), std::pair("mirrors.gltf", false)}) {
    const walr::test::TemporaryDirectory folder;
    RenderOptions options = smallBox(folder.path());
    options.scene = std::string(WALR_SCENES "/") + scene;
    options.specular = true;
    options.firstFrame = options.lastFrame = 5;
    render(options);
    SequenceOptions reading;
    reading.light.specular = SpecularWish::IfHeld;
    const Frame frame = Sequence(folder.path(), reading).read(0);
    ASSERT_EQ(frame.specularMotion.components(), 3);
    const auto moving = std::ranges::count_if(frame.specularMotion.values(), [](float value) { return value != 0.0F; });
    EXPECT_EQ(moving > 0, moves) << scene;
  }
}

TEST(RenderSequence, ReplacesMirrors) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path());
  options.scene = WALR_SCENES "/gloss.gltf";
  options.camera = "mirror";
  options.specular = options.replaceMirrors = true;
  options.lastFrame = options.firstFrame;
  render(options);
  // A mirror, which has no albedo, fills the centre. It shows a wall of .73, times .95 and Schlick's term.
  EXPECT_NEAR(Sequence(folder.path(), {}).read(0).albedo.at(16, 9, 0), 0.73F * 0.95F, 0.001F);
  options.replaceMirrors = false;
  fg::test::expectError<InputError>([&] { render(options); }, {"'replace_mirrors'"});
}

TEST(RenderSequence, WritesTheObjectOfEveryPixel) {
  const walr::test::TemporaryDirectory folder;
  render(smallBox(folder.path()));
  ExrReader file(folder.path() / "noisy_0003.exr");
  walr::Image ids(file.width(), file.height(), 1);
  walr::Image depth(file.width(), file.height(), 1);
  file.read(std::vector<ExrReader::Target>{{"ObjectId.Y", &ids, 0}, {"Depth.Z", &depth, 0}});
  const Scene scene = loadScene(WALR_SCENES "/box.gltf");
  const std::vector<Instance> instances = makeInstances(scene);
  std::set<std::string> seen;
  for (std::size_t i = 0; i < ids.pixelCount(); ++i) {
    const float id = ids.pixel(i)[0];
    ASSERT_EQ(id < 0.0F, depth.pixel(i)[0] >= kSkyDepth);
    if (id >= 0.0F) {
      seen.insert(scene.nodes[instances.at(static_cast<std::size_t>(id)).node].name);
    }
  }
  EXPECT_TRUE(seen.contains("red wall"));
  EXPECT_TRUE(seen.contains("blue block"));
}

TEST(RenderSequence, ResumesAnInterruptedRun) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path());
  options.lastFrame = 4;
  render(options);
  const fs::path kept = folder.path() / "noisy_0004.exr";
  const fs::path lost = folder.path() / "ref_0004.exr";
  const fs::file_time_type before = fs::last_write_time(kept);
  fs::remove(lost);
  options.lastFrame = 5;
  const std::vector<std::string> lines = render(options);
  int skipped = 0;
  for (const std::string& line : lines) {
    skipped += line.find("already exists") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(skipped, 3);
  EXPECT_EQ(fs::last_write_time(kept), before);
  EXPECT_TRUE(fs::exists(lost));
}

// Resampled light depends on the frames before, the existing ones among them.
TEST(RenderSequence, ResumesAResampledSequence) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path());
  options.referenceSamples = 0;
  options.resampledFrames = 20;
  render(options);
  const auto lastLight = [&] {
    const Frame frame = Sequence(folder.path(), {}).read(2);
    return std::vector<float>(frame.indirect.values().begin(), frame.indirect.values().end());
  };
  const std::vector<float> whole = lastLight();
  fs::remove(folder.path() / frameFileName("noisy", 5, "exr"));
  render(options);
  EXPECT_EQ(lastLight(), whole);

  // In two calls, of which the second goes on where the first one ended.
  fs::remove(folder.path() / frameFileName("noisy", 5, "exr"));
  options.firstFrame = 5;
  render(options);
  EXPECT_EQ(lastLight(), whole);

  options.resampledFrames = 0;
  fg::test::expectError<InputError>([&] { render(options); }, {"'resampled_frames'"});
}

TEST(RenderSequence, RendersReferencesOfTheSelectedFrames) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path());
  options.referenceFrames = {4, 9};
  render(options);
  for (const int frame : {3, 4, 5}) {
    EXPECT_TRUE(fs::exists(folder.path() / frameFileName("noisy", frame, "exr")));
    EXPECT_EQ(fs::exists(folder.path() / frameFileName("ref", frame, "exr")), frame >= 4);
  }
}

TEST(RenderSequence, RendersSomeSquaresOfAReferenceOnly) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path() / "some");
  options.lastFrame = options.firstFrame;
  options.width = 256;
  options.height = 144;
  options.referenceCoverage.oneSquareIn = 4;
  render(options);
  RenderOptions whole = options;
  whole.output = folder.path() / "all";
  whole.referenceCoverage.oneSquareIn = 1;
  render(whole);

  const Frame some = Sequence(options.output, {}).read(0);
  const Frame all = Sequence(whole.output, {}).read(0);
  EXPECT_TRUE(some.nonFinite.empty());
  std::size_t known = 0;
  for (std::size_t i = 0; i < some.depth.pixelCount(); ++i) {
    const auto pixel = some.reference->indirect.pixel(i);
    if (std::isnan(pixel[0])) continue;
    ++known;
    EXPECT_TRUE(std::ranges::equal(pixel, all.reference->indirect.pixel(i)));
  }
  // The image has two rows of 4 squares and a row of 4 that its lower edge cuts to 64 x 16. One square of each row is
  // rendered.
  EXPECT_EQ(known, 2U * 64 * 64 + 64 * 16);
}

TEST(RenderSequence, HalvesGiveTheNoiseOfReferences) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path() / "a");
  options.lastFrame = options.firstFrame;
  options.width = 128;
  options.height = 72;
  options.referenceSamples = 32;
  render(options);
  RenderOptions other = options;
  other.output = folder.path() / "b";
  other.seed = 7;
  render(other);

  const Frame frame = Sequence(options.output, {}).read(0);
  const walr::Image& reference = frame.reference->indirect;
  const walr::Image otherReference = Sequence(other.output, {}).read(0).reference->indirect;
  ExrReader file(options.output / "ref_0003.exr");
  walr::Image half(file.width(), file.height(), 3);
  file.read(
      std::vector<ExrReader::Target>{{"IndirectA.R", &half, 0}, {"IndirectA.G", &half, 1}, {"IndirectA.B", &half, 2}});
  const PixelMask mask = diffuseMask(frame.albedo, frame.normal, frame.depth, kSkyDepth, reference);
  const double estimated = referenceNoise(reference, half, mask).value();
  // Two independent references differ by sqrt(2) times the noise of one.
  const double measured = compare(reference, otherReference, mask).rmse.value() / std::numbers::sqrt2;
  // Over eight pairs of seeds the ratio was 0.97 on average, with a standard deviation of 0.01. It is below 1 because
  // the tone map compresses the larger noise of the halves.
  EXPECT_NEAR(estimated, measured, 0.1 * measured);
}

TEST(RenderSequence, AveragesReferencesOverThePixel) {
  const Scene scene = loadScene(WALR_SCENES "/box.gltf", {});
  World world(scene);
  world.moveTo(0.0, 0.0);
  View view = viewFrom(world, findCamera(scene, ""), 16, 9, {}, {});
  SamplingSettings sampling;
  sampling.samples = 1024;
  std::uint64_t rays = 0;
  const Reference area = renderReference(world, view, sampling, {.wholePixel = true}, rays);

  // The same average from points on a grid within the pixel. A point without a diffuse surface does not count.
  constexpr int kGrid = 8;
  walr::Image sum(16, 9, 3);
  std::vector<int> points(sum.pixelCount());
  sampling.samples = 1024 / (kGrid * kGrid);
  for (int i = 0; i < kGrid * kGrid; ++i) {
    view.jitter = (glm::vec2(i % kGrid, i / kGrid) + 0.5F) / static_cast<float>(kGrid) - 0.5F;
    sampling.seed = 2 * static_cast<std::uint32_t>(i) + 2;
    const Reference point = renderReference(world, view, sampling, {}, rays);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto light = point.indirect.pixel(p);
      if (light[0] + light[1] + light[2] == 0.0F) continue;
      for (std::size_t c = 0; c < 3; ++c) sum.pixel(p)[c] += light[c];
      ++points[p];
    }
  }
  test::Statistics difference;
  test::Statistics squares;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p] == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = sum.pixel(p)[c] / static_cast<float>(points[p]);
      difference.add(area.indirect.pixel(p)[c] - expected);
      // The square of half the difference of the two halves estimates the variance of their mean.
      squares.add(std::pow(area.indirect.pixel(p)[c] - area.indirectHalf.pixel(p)[c], 2));
    }
  }
  // Both have 1024 samples per pixel, so that the difference has twice the variance.
  EXPECT_NEAR(difference.mean(), 0.0, test::kConfidence * difference.standardError());
  EXPECT_LT(difference.variance(), 2.0 * 2.0 * squares.mean());
  EXPECT_GT(difference.count(), 300U);
}

TEST(RenderSequence, RefusesToMixSettings) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path());
  options.lastFrame = options.firstFrame;
  render(options);
  options.bounces = 2;
  fg::test::expectError<InputError>([&] { render(options); }, {"'bounces'"});
}

TEST(RenderSequence, RefusesToMixStatesOfAScene) {
  const walr::test::TemporaryDirectory folder;
  const walr::test::TemporaryDirectory scenes;
  RenderOptions options = smallBox(folder.path());
  options.scene = scenes.path() / "box.gltf";
  options.lastFrame = options.firstFrame;
  fs::copy_file(WALR_SCENES "/box.gltf", options.scene);
  render(options);
  render(options);  // Nothing has changed.
  // The same length, and another light.
  std::ifstream before(options.scene);
  std::string text(std::istreambuf_iterator<char>(before), {});
  const std::size_t colour = text.find("\"emissiveFactor\"");
  ASSERT_NE(colour, std::string::npos);
  const std::size_t digit = text.find_first_of("123456789", colour);
  text[digit] = text[digit] == '1' ? '0' : '1';
  std::ofstream(options.scene) << text;
  fg::test::expectError<InputError>([&] { render(options); }, {"box.gltf", "changed", "--output"});
}

TEST(RenderSequence, NamesAMissingScene) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options = smallBox(folder.path());
  options.scene = folder.path() / "none.glb";
  EXPECT_THROW(render(options), InputError);
}

}  // namespace
}  // namespace walr::render
