// Graphs of specular light, alone and beside diffuse light. No device is needed.

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/compile/compile.h"
#include "integration/denoise_graph.h"
#include "integration/registry.h"
#include "passes/guides/shared_guides.h"
#include "tests/error_text.h"

namespace walr::specular_graph_test {
namespace {

constexpr fg::Extent kExtent{64, 36};

/// @param kinds of each light: whether it is specular
DenoiseGraph declare(const std::vector<bool>& kinds, const HostConventions& host = {},
                     std::span<const VkFormat> formats = {}) {
  const auto method = makeDenoiser("accumulate");
  std::vector<DenoisedLight> lights;
  for (const bool specular : kinds) lights.push_back({method.get(), specular});
  return declareDenoiseGraph(lights, kExtent, {}, kComputeHost, formats, host);
}

std::set<std::string> passesOf(const DenoiseGraph& declared) {
  std::set<std::string> names;
  for (const fg::PassDecl& pass : declared.graph.desc().passes) names.insert(pass.name);
  return names;
}

TEST(SpecularGraph, RefusesWhatItCannotDo) {
  std::vector<VkFormat> noAlpha;
  for (const HostInput& input : kHostInputs) noAlpha.push_back(input.optional ? VK_FORMAT_UNDEFINED : input.format);
  noAlpha.front() = VK_FORMAT_B10G11R11_UFLOAT_PACK32;
  for (const std::vector<bool>& kinds : {std::vector{true}, {false, true}, {true, false}}) {
    const auto expectRefused = [&](const HostConventions& host, std::span<const VkFormat> formats,
                                   std::string_view why) {
      fg::test::expectError<std::invalid_argument>([&] { (void)declare(kinds, host, formats); }, {why});
    };
    expectRefused({.orthographic = true}, {}, "perspective camera");
    expectRefused({}, noAlpha, "'lighting' cannot be of format B10G11R11_UFLOAT_PACK32");
  }
}

// A rectangle of the host's textures is copied out of all of them.
TEST(SpecularGraph, MovesItsTexturesWithTheOtherInputs) {
  const auto passes = [](const std::vector<bool>& kinds, const HostConventions& host) {
    return declare(kinds, host).graph.desc().passes.size();
  };
  // Depth, normal, motion, lighting, albedo, roughness and the result.
  EXPECT_EQ(passes({true}, {.rectangle = true}), passes({true}, {}) + 7);
  // Also the other albedo, the other light and its result.
  EXPECT_EQ(passes({false, true}, {.rectangle = true}), passes({false, true}, {}) + 10);
}

TEST(SpecularGraph, SharesGuidesWithItsOwnKindOnly) {
  const std::string second = "second light: prepare guides";
  for (const bool first : {false, true}) {
    EXPECT_TRUE(passesOf(declare({first, !first})).contains(second));
    EXPECT_FALSE(passesOf(declare({first, first})).contains(second));
  }
}

TEST(SpecularGraph, ReadsTheAlbedoOfItsLobe) {
  const DenoiseGraph alone = declare({true});
  EXPECT_FALSE(alone.inputs.albedo.valid());
  const DenoiseGraph both = declare({false, true});
  const fg::CompileResult result = fg::compile(both.graph.desc(), fg::TableMemoryModel());
  ASSERT_TRUE(result.ok()) << result.text();
  for (const fg::Texture each : {both.inputs.albedo, both.inputs.specularAlbedo, both.inputs.roughness})
    EXPECT_TRUE(result.plan.resources[each.resource].used);
  EXPECT_FALSE(declare({false}).inputs.roughness.valid());
}

// A host that owns the graph gives each kind guides of its own.
TEST(SpecularGraph, TellsHostsThatShareGuidesWithAnotherKind) {
  fg::Graph graph;
  DenoiserInputs inputs = importInputs(graph, kExtent, {.specular = true}, kComputeHost.inputs);
  inputs.albedo = inputs.specularAlbedo;
  const auto method = makeDenoiser("accumulate");
  SharedGuides guides;
  Inspection inspection;
  const auto add = [&](std::string_view prefix) {
    const std::string name = std::string(prefix) + "output";
    (void)method->add({graph, inspection, {.guides = &guides, .prefix = prefix}}, inputs,
                      graph.texture(name, {kOutputFormat, kExtent}));
  };
  add("");
  inputs.conventions.specular = false;
  fg::test::expectError<std::invalid_argument>([&] { add("diffuse "); }, {"a SharedGuides of its own"});
}

// The registry has the two textures as ports, asks for them where they are read, and wants light that holds distances.
TEST(SpecularGraph, HasPortsInTheRegistry) {
  for (const bool specular : {false, true}) {
    const auto node = makePass("accumulate");
    node->setConventions({.specular = specular});
    const std::vector<Port> ports = node->ports();
    for (const char* const name : {"albedo", "specular_albedo", "roughness"}) {
      const auto port = std::ranges::find(ports, std::string_view(name), &Port::name);
      ASSERT_NE(port, ports.end()) << name;
      EXPECT_EQ(port->optional, specular == (port->name == "albedo")) << name;
    }
    fg::Graph graph;
    const fg::TextureDesc clamped{.format = VK_FORMAT_R16G16B16A16_UNORM, .extent = kExtent};
    node->connect(std::string(kLightingName), graph.import("light", clamped, kComputeHost.inputs));
    fg::test::expectError<std::invalid_argument>(
        [&] { (void)node->add(graph); }, {specular ? "stored as SFLOAT" : "nothing is connected to port 'depth'"});
  }
}

// What alpha means decides which formats hold it: in a graph of its own, as in the registry.
TEST(SpecularGraph, TakesLightInFormatsThatHoldItsAlpha) {
  constexpr std::string_view kAccepted = "nothing is connected to port 'depth'";
  const auto expect = [&](const LightPattern& light, VkFormat format, std::string_view why) {
    SCOPED_TRACE(why);
    fg::Graph graph;
    const auto node = makePass("accumulate");
    node->setConventions({.light = light});
    node->connect(std::string(kLightingName),
                  graph.import("light", {.format = format, .extent = kExtent}, kComputeHost.inputs));
    fg::test::expectError<std::invalid_argument>([&] { (void)node->add(graph); }, {why});

    fg::Graph own;
    std::array<VkFormat, kHostInputs.size()> formats{};
    for (std::size_t i = 0; i < formats.size(); ++i)
      formats.at(i) = kHostInputs.at(i).optional ? VK_FORMAT_UNDEFINED : kHostInputs.at(i).format;
    formats.front() = format;
    const auto import = [&] { (void)importInputs(own, kExtent, {.light = light}, kComputeHost.inputs, formats); };
    if (why == kAccepted) {
      EXPECT_NO_THROW(import());
    } else {
      fg::test::expectError<std::invalid_argument>(import, {why});
    }
  };
  constexpr VkFormat kThreeChannels = VK_FORMAT_B10G11R11_UFLOAT_PACK32;
  expect({}, kThreeChannels, kAccepted);
  expect({.masked = true}, kThreeChannels, "sampled as floats with 4 channels");
  expect({.masked = true}, VK_FORMAT_R16G16B16A16_UNORM, kAccepted);
  expect({.counted = true}, VK_FORMAT_R16G16B16A16_UNORM, "because alpha is a number of samples");
  expect({.counted = true}, VK_FORMAT_R32G32B32A32_SFLOAT, kAccepted);
}

}  // namespace
}  // namespace walr::specular_graph_test
