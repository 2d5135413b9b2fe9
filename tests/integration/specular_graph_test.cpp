// Graphs of specular light. No device is needed.

#include <array>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>

#include <gtest/gtest.h>

#include "integration/denoise_graph.h"
#include "tests/error_text.h"

namespace walr::specular_graph_test {
namespace {

DenoiseGraph declare(const HostConventions& host = {}, std::size_t lights = 1) {
  const auto method = makeDenoiser("accumulate");
  const std::array<Denoiser*, 2> methods{method.get(), method.get()};
  return declareDenoiseGraph(std::span(methods).first(lights), {64, 36}, {.specular = true}, kComputeHost, {}, host);
}

TEST(SpecularGraph, RefusesWhatItCannotDo) {
  const auto expectRefused = [](const HostConventions& host, std::size_t lights, std::string_view why) {
    fg::test::expectError<std::invalid_argument>([&] { (void)declare(host, lights); }, {why});
  };
  expectRefused({.orthographic = true}, 1, "perspective camera");
  expectRefused({}, 2, "for it alone");
}

// A rectangle of the host's textures is copied out of all of them.
TEST(SpecularGraph, MovesRoughnessWithTheOtherInputs) {
  const auto passes = [](const HostConventions& host) { return declare(host).graph.desc().passes.size(); };
  // Depth, normal, motion, lighting, albedo, roughness and the result.
  EXPECT_EQ(passes({.rectangle = true}), passes({}) + 7);
}

}  // namespace
}  // namespace walr::specular_graph_test
