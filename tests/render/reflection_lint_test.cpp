// Frames with mirrors pass the linter, and each mistake in what is said of the things that they show is found.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "samples/denoise/gpu_linter.h"
#include "samples/denoise/packed_frame.h"
#include "samples/render/render_sequence.h"
#include "samples/sequence/sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render {
namespace {

std::vector<Frame> rendered(const std::string& scene, const std::string& camera) {
  const walr::test::TemporaryDirectory folder;
  RenderOptions options;
  options.scene = std::filesystem::path(WALR_SCENES) / scene;
  options.camera = camera;
  options.output = folder.path();
  options.firstFrame = 8;
  options.lastFrame = 10;
  options.width = 192;
  options.height = 108;
  options.referenceSamples = 0;
  options.specular = true;
  renderSequence(options, {});
  SequenceOptions reading;
  reading.light.specular = SpecularWish::IfHeld;
  const Sequence sequence(folder.path(), reading);
  return {sequence.read(0), sequence.read(1), sequence.read(2)};
}

using Change = std::function<void(Frame&)>;

std::vector<LintFinding> lint(std::vector<Frame> frames, const Change& change) {
  GpuDevice device({.device = {}, .validation = true});
  const walr::Image& depth = frames.front().depth;
  GpuLinter linter(device, {static_cast<std::uint32_t>(depth.width()), static_cast<std::uint32_t>(depth.height())},
                   projectLayout());
  for (Frame& frame : frames) {
    change(frame);
    linter.add(frame);
  }
  device.refuseMessages();
  return linter.findings();
}

/// The names of the findings; their text goes to the test's record.
std::vector<std::string> found(const std::vector<Frame>& frames, const Change& change) {
  std::vector<std::string> names;
  for (const LintFinding& finding : lint(frames, change)) {
    names.emplace_back(finding.name);
    ::testing::Test::RecordProperty(names.back(), finding.what);
  }
  return names;
}

using Names = std::vector<std::string>;

void eachMotion(Frame& frame, const std::function<glm::vec3(glm::vec3)>& change) {
  for (std::size_t i = 0; i < frame.depth.pixelCount(); ++i) {
    const auto motion = frame.specularMotion.pixel(i);
    const glm::vec3 changed = change({motion[0], motion[1], motion[2]});
    for (int c = 0; c < 3; ++c) motion[static_cast<std::size_t>(c)] = changed[c];
  }
}

TEST(GpuLinter, FindsDistancesOfAnotherRay) {
  const std::vector<Frame> frames = rendered("gloss.gltf", "");
  EXPECT_EQ(found(frames, [](Frame&) {}), Names{});
  const Names wrong{"specular-distance-of-another-ray"};
  EXPECT_EQ(found(frames,
                  [](Frame& frame) {
                    for (float& d : frame.specularDistance.values()) d *= 0.5F;
                  }),
            wrong);
  // Metres beside centimetres.
  EXPECT_EQ(found(frames,
                  [](Frame& frame) {
                    for (float& d : frame.specularDistance.values()) d *= 0.01F;
                  }),
            Names{"specular-distance-short"});
  // The distance from the eye.
  const Change fromEye = [](Frame& frame) {
    const FrameConstants constants = frameConstantsOf(frame, glm::vec2(1.0F));
    for (int y = 0; y < frame.depth.height(); ++y) {
      for (int x = 0; x < frame.depth.width(); ++x) {
        const glm::vec2 position(float(x) + 0.5F, float(y) + 0.5F);
        const glm::vec2 offset(constants.rayFromPixel.z, constants.rayFromPixel.w);
        const glm::vec3 ray(position * glm::vec2(constants.rayFromPixel) + offset, -1.0F);
        float& distance = frame.specularDistance.at(x, y, 0);
        if (distance > 0.0F && distance < kSkyDepth) distance += glm::length(ray) * frame.depth.at(x, y, 0);
      }
    }
  };
  EXPECT_EQ(found(frames, fromEye), wrong);
  EXPECT_NE(lint(frames, fromEye).at(0).cause.find("from the eye"), std::string_view::npos);
}

// A ball that moves before a mirror, seen both ways.
TEST(GpuLinter, FindsMotionsTheWrongWay) {
  const std::vector<Frame> frames = rendered("gloss.gltf", "mirror");
  EXPECT_EQ(found(frames, [](Frame&) {}), Names{});
  EXPECT_EQ(found(frames, [](Frame& frame) { eachMotion(frame, [](glm::vec3 m) { return -m; }); }),
            Names{"specular-motion-sign"});
  EXPECT_EQ(found(frames, [](Frame& frame) { eachMotion(frame, [](glm::vec3) { return glm::vec3(0.0F); }); }),
            Names{"specular-motion-missing"});
  EXPECT_EQ(found(frames,
                  [](Frame& frame) {
                    const glm::mat3 turn(frame.camera.view);
                    eachMotion(frame, [&](glm::vec3 m) { return turn * m; });
                  }),
            Names{"specular-motion-space"});
}

}  // namespace
}  // namespace walr::render
