// Compares the path tracer with Blender Cycles: frames of the same scenes and cameras, if they are at hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/image/exr.h"
#include "samples/image/image.h"
#include "samples/render/film.h"
#include "samples/render/gbuffer.h"
#include "samples/render/load_scene.h"
#include "tests/render/statistics.h"
#include "tests/shared_data.h"

namespace walr::render {
namespace {

constexpr int kWidth = 384;
constexpr int kHeight = 216;
constexpr double kFramesPerSecond = 24.0;

walr::Image readPlane(ExrReader& file, const std::string& name, const std::string& components) {
  walr::Image image(file.width(), file.height(), static_cast<int>(components.size()));
  std::vector<ExrReader::Target> targets;
  for (std::size_t c = 0; c < components.size(); ++c) {
    targets.push_back({name + "." + components[c], &image, static_cast<int>(c)});
  }
  file.read(targets);
  return image;
}

glm::vec3 pixelOf(const walr::Image& image, std::uint32_t x, std::uint32_t y) {
  const auto column = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  return {image.at(column, row, 0), image.at(column, row, 1), image.components() > 2 ? image.at(column, row, 2) : 0.0F};
}

// The quantile of order `share`, 0..1.
float quantile(std::vector<float> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

struct Case {
  std::string scene;
  int frame;
};

class SharedDataCycles : public testing::TestWithParam<Case> {};

TEST_P(SharedDataCycles, GBufferAgrees) {
  const auto [name, number] = GetParam();
  const walr::test::SharedData glb("scenes/" + name + ".glb");
  const walr::test::SharedData exr("sequences/" + name + "/noisy_00" + std::to_string(number) + ".exr");
  if (!glb) GTEST_SKIP() << glb.whyNot();
  if (!exr) GTEST_SKIP() << exr.whyNot();
  const Scene scene = loadScene(glb.path());
  World world(scene);
  world.moveTo(number / kFramesPerSecond, (number - 1) / kFramesPerSecond);
  const View view = viewFrom(world, findCamera(scene, ""), kWidth, kHeight, glm::vec2(0.0F), glm::vec2(0.0F));
  ExrReader file(exr.path());
  const walr::Image depth = readPlane(file, "Depth", "Z");
  const walr::Image position = readPlane(file, "Position", "XYZ");
  const walr::Image normal = readPlane(file, "Normal", "XYZ");
  const walr::Image motion = readPlane(file, "Vector", "XY");
  const walr::Image albedo = readPlane(file, "DiffCol", "RGB");

  std::vector<float> positionErrors;
  std::vector<float> normalErrors;
  std::vector<float> motionErrors;
  std::vector<float> albedoErrors;
  int otherSurface = 0;
  int bentNormals = 0;
  // Cycles' pixel filter is 0.01 pixel wide. Measured: its positions project to within 0.022 pixel of the centre.
  const float filterFootprint = 0.022F * 2.0F / (view.projection[1][1] * static_cast<float>(kHeight));
  constexpr float kPositionRounding = 0x1p-13F;  // Metres.
  const glm::mat3 rotation(view.viewFromWorld);
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const PrimaryHit hit = tracePrimary(world, view, x, y);
      const GBufferPixel& pixel = hit.pixel;
      const bool sky = depth.at(static_cast<int>(x), static_cast<int>(y), 0) > 1e9F;
      if (sky && !hit.surface) {
        continue;
      }
      const glm::vec3 expected(view.viewFromWorld * glm::vec4(pixelOf(position, x, y), 1.0F));
      const float distance = glm::length(expected);
      // At a silhouette the two rays, a fraction of a pixel apart, can hit different surfaces.
      if (sky || !hit.surface || glm::distance(expected, pixel.position) > 0.01F * distance) {
        ++otherSurface;
        continue;
      }
      positionErrors.push_back(glm::distance(expected, pixel.position) /
                               (distance * filterFootprint + kPositionRounding));
      const glm::vec3 vector = pixelOf(motion, x, y);
      motionErrors.push_back(glm::distance(glm::vec2(vector.x, -vector.y), glm::vec2(pixel.motion)));
      const glm::vec3 albedoError = glm::abs(pixelOf(albedo, x, y) - pixel.albedo);
      albedoErrors.push_back(glm::max(albedoError.x, glm::max(albedoError.y, albedoError.z)));
      // Cycles bends a normal whose mirror direction would lie below the surface; this project does not.
      const glm::vec3 mirrored = glm::reflect(-hit.surface->towardsViewer, hit.surface->shadingNormal);
      if (glm::dot(mirrored, hit.surface->geometricNormal) < 0.01F) {
        ++bentNormals;
        continue;
      }
      const glm::vec3 expectedNormal = rotation * glm::normalize(pixelOf(normal, x, y));
      normalErrors.push_back(glm::degrees(std::acos(glm::clamp(glm::dot(expectedNormal, pixel.normal), -1.0F, 1.0F))));
    }
  }
  std::cout << "position: 99.9 % within " << quantile(positionErrors, 0.999)
            << " of the filter's footprint; normal: half " << quantile(normalErrors, 0.5) << ", 95 % "
            << quantile(normalErrors, 0.95) << " degrees; motion: all " << quantile(motionErrors, 1.0)
            << " pixels; albedo: half " << quantile(albedoErrors, 0.5) << ", 90 % " << quantile(albedoErrors, 0.9)
            << "; another surface: " << otherSurface << ", a bent normal: " << bentNormals << " of " << kWidth * kHeight
            << " pixels\n";
  EXPECT_LE(otherSurface, kWidth * kHeight / 1000);
  EXPECT_LE(quantile(positionErrors, 0.999), 1.0F);
  EXPECT_LE(quantile(motionErrors, 1.0), 0.05F);
  // The files hold half floats, whose rounding error is 2^-11 per component.
  EXPECT_LE(quantile(normalErrors, 0.5), 0.06F);
  // The tolerance is two steps of an 8-bit normal map.
  EXPECT_LE(quantile(normalErrors, 0.95), 0.9F);
  EXPECT_LE(bentNormals, kWidth * kHeight / 20);
  // The tolerance is two steps of an 8-bit texture: Cycles interpolates sRGB values, glTF requires linear ones.
  EXPECT_LE(quantile(albedoErrors, 0.5), 0.5F / 255.0F);
  EXPECT_LE(quantile(albedoErrors, 0.9), 2.0F / 255.0F);
}

double average(const glm::vec3& color) {
  return (color.x + color.y + color.z) / 3.0;
}

TEST_P(SharedDataCycles, MeanLightAgrees) {
  const auto [name, number] = GetParam();
  const walr::test::SharedData glb("scenes/" + name + ".glb");
  const walr::test::SharedData exr("sequences/" + name + "/noisy_00" + std::to_string(number) + ".exr");
  if (!glb) GTEST_SKIP() << glb.whyNot();
  if (!exr) GTEST_SKIP() << exr.whyNot();
  Scene scene = loadScene(glb.path());
  // The frames were rendered with Blender's Principled BSDF, whose diffuse lobe is not Lambertian.
  scene.diffuseModel = DiffuseModel::Disney;
  World world(scene);
  world.moveTo(number / kFramesPerSecond, (number - 1) / kFramesPerSecond);
  const View view = viewFrom(world, findCamera(scene, ""), kWidth, kHeight, glm::vec2(0.0F), glm::vec2(0.0F));
  SamplingSettings sampling;
  sampling.samples = 2;
  const Film film = renderFilm(world, view, sampling);
  ExrReader file(exr.path());
  for (const auto& [plane, ours] : {std::pair("DiffInd", &film.indirect), std::pair("DiffDir", &film.direct)}) {
    const walr::Image theirs = readPlane(file, plane, "RGB");
    test::Statistics cycles;
    test::Statistics here;
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
      if (film.gbuffer[i].albedo != glm::vec3(0.0F)) {
        cycles.add(average(pixelOf(theirs, i % kWidth, i / kWidth)));
        here.add(average((*ours)[i]));
      }
    }
    const double error = std::hypot(cycles.standardError(), here.standardError());
    std::cout << plane << ": Cycles " << cycles.mean() << ", here " << here.mean() << ", ratio "
              << here.mean() / cycles.mean() << " +- " << error / cycles.mean() << '\n';
    // The sampling noise must be much smaller than the tolerance.
    EXPECT_LE(3.0 * error, 0.05 * cycles.mean());
    EXPECT_NEAR(here.mean(), cycles.mean(), 0.05 * cycles.mean());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedDataCycles,
                         testing::Values(Case{"sponza", 20}, Case{"sponza", 29}, Case{"cornell_fence", 10},
                                         Case{"cornell_fence", 17}),
                         [](const auto& info) { return info.param.scene + "_" + std::to_string(info.param.frame); });

}  // namespace
}  // namespace walr::render
