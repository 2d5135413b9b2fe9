// The linter of sequences on frames that lack what other frames have.

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/ext/matrix_clip_space.hpp>

#include "samples/denoise/gpu_linter.h"
#include "tests/samples/sequence_fixture.h"

namespace walr::gpu_linter_test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 90;

std::vector<std::string> found(const Frame& frame) {
  GpuDevice device({.device = {}, .validation = true});
  GpuLinter linter(device, {kWidth, kHeight}, projectLayout());
  linter.add(frame);
  device.refuseMessages();
  std::vector<std::string> names;
  for (const LintFinding& finding : linter.findings()) names.emplace_back(finding.name);
  return names;
}

// A checker in light and albedo would look like light that was not divided, if no roughness could explain it.
TEST(GpuLinter, TakesFramesWithoutDistanceAndRoughness) {
  Frame frame = test::projectFrame(0, kWidth, kHeight);
  frame.camera.projection = frame.previousProjection = glm::perspective(1.0F, float(kWidth) / kHeight, 0.1F, 100.0F);
  const std::vector<std::string> diffuse = found(frame);
  const auto withDiffuse = [&](std::vector<std::string> names) {
    names.insert(names.begin(), diffuse.begin(), diffuse.end());
    return names;
  };
  frame.specular = frame.specularAlbedo = Image(kWidth, kHeight, 3);
  for (std::size_t i = 0; i < frame.specular.values().size(); ++i) {
    frame.specular.values()[i] = frame.specularAlbedo.values()[i] = i / 3 % 2 == 0 ? 0.25F : 1.0F;
  }
  EXPECT_EQ(found(frame), diffuse);
  frame.roughness = Image(kWidth, kHeight, 1);
  std::ranges::fill(frame.roughness.values(), 0.5F);
  EXPECT_EQ(found(frame), withDiffuse({"specular-albedo-in-light"}));
  frame.roughness = {};
  frame.specular.at(9, 40, 1) = std::numeric_limits<float>::quiet_NaN();
  frame.specular.at(9, 41, 1) = -1.0F;
  EXPECT_EQ(found(frame), withDiffuse({"specular-not-finite", "specular-negative"}));
}

}  // namespace
}  // namespace walr::gpu_linter_test
