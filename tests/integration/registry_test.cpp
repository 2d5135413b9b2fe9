#include "integration/registry.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/compile/compile.h"
#include "framegraph/declare/access.h"
#include "framegraph/inspect/inspect.h"
#include "integration/denoise_graph.h"
#include "tests/error_text.h"

namespace walr::registry_test {
namespace {

using fg::test::errorText;
using fg::test::expectError;

constexpr fg::Extent kExtent{640, 360};

const PassType& typeOf(std::string_view name) {
  return *std::ranges::find(passTypes(), name, &PassType::name);
}

void connectHost(PassNode& node, const DenoiserInputs& inputs) {
  for (const Port& port : node.ports()) {
    if (port.output) continue;
    if (port.name == kFrameName) node.connect(port.name, inputs.frame);
    for (const HostInput& input : kHostInputs) {
      if (input.name == port.name && (inputs.*input.texture).valid()) {
        node.connect(port.name, inputs.*input.texture);
      }
    }
  }
}

void connect(PassNode& node, const Connections& outputs) {
  for (const Port& port : node.ports()) {
    const auto found = outputs.textures.find(port.name);
    if (!port.output && found != outputs.textures.end()) node.connect(port.name, found->second);
  }
}

std::string compiled(const fg::Graph& graph) {
  const fg::CompileResult result = fg::compile(graph.desc(), fg::TableMemoryModel());
  return result.ok() ? fg::toText(graph.desc(), result.plan) : "does not compile: " + result.text();
}

/// A graph with the host's textures. Tests add nodes to it.
struct HostGraph {
  HostGraph() {
    inputs = importInputs(graph, kExtent, {}, kComputeHost.inputs);
    output = graph.import(std::string(kOutputName), {kOutputFormat, kExtent}, kComputeHost.outputBefore);
  }
  fg::Graph graph;
  DenoiserInputs inputs;
  fg::Texture output;
};

TEST(Registry, ListsEveryMethodAndEveryTypeCompilesByItself) {
  for (const std::string& method : denoiserNames()) EXPECT_TRUE(typeOf(method).composition) << method;
  for (const PassType& type : passTypes()) {
    SCOPED_TRACE(type.name);
    EXPECT_FALSE(type.description.empty());
    EXPECT_FALSE(type.passes.empty());
    EXPECT_TRUE(std::ranges::any_of(type.ports, &Port::output));
    HostGraph host;
    const auto node = makePass(type.name);
    connectHost(*node, host.inputs);
    for (const Port& port : node->ports()) {
      if (port.output || port.optional || port.buffer) continue;
      if (std::ranges::find(kHostInputs, std::string_view(port.name), &HostInput::name) != kHostInputs.end()) continue;
      node->connect(port.name, host.graph.import(port.name, {port.format, kExtent}, kComputeHost.inputs));
    }
    for (const auto& [name, texture] : node->add(host.graph).textures) {
      if (texture.version > 0) host.graph.exported(texture, kComputeHost.outputAfter);
    }
    const std::string plan = compiled(host.graph);
    EXPECT_FALSE(plan.starts_with("does not compile")) << plan;
  }
}

TEST(Registry, PortsHaveTheUsageThatThePlanHas) {
  for (const std::string& method : denoiserNames()) {
    DenoiseGraph declared = declareDenoiseGraph(*makeDenoiser(method), {1920, 1080}, {}, kComputeHost);
    const fg::CompileResult result = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
    ASSERT_TRUE(result.ok()) << result.text();
    for (const Port& port : typeOf(method).ports) {
      // This host does not have them.
      const HostInput* input = hostInputNamed(port.name);
      if (input != nullptr && (input->optional || input->of == HostInput::Of::SpecularLight)) continue;
      const auto& resources = declared.graph.desc().resources;
      const auto found = std::ranges::find(resources, port.name, &fg::ResourceDecl::name);
      ASSERT_NE(found, resources.end()) << port.name;
      const fg::PlannedResource& planned = result.plan.resources[static_cast<std::size_t>(found - resources.begin())];
      // The plan also includes the host's own accesses.
      VkImageUsageFlags imageUsage = port.imageUsage;
      VkBufferUsageFlags bufferUsage = port.bufferUsage;
      const auto addBorder = [&](const fg::ExternalState& state) {
        if (std::holds_alternative<fg::TextureDesc>(found->desc)) {
          imageUsage |= fg::imageUsageIn(state);
        } else {
          bufferUsage |= fg::bufferUsageIn(state);
        }
      };
      if (found->acquire) addBorder(*found->acquire);
      if (port.output) addBorder(kComputeHost.outputAfter);
      EXPECT_EQ(imageUsage, planned.imageUsage) << method << ": " << port.name;
      EXPECT_EQ(bufferUsage, planned.bufferUsage) << method << ": " << port.name;
      EXPECT_EQ(port.optional, port.output || !planned.used) << method << ": " << port.name;
    }
  }
}

/// A stage of a chain, with the settings that the whole method derives for an image of 360 lines or sets itself.
struct Link {
  const char* type;
  std::vector<std::pair<const char*, const char*>> settings;
};

void expectPlannedAs(const Link& wholeMethod, const char* preset, const std::vector<Link>& chain) {
  const char* name = wholeMethod.type;
  HostGraph whole;
  const auto method = makePass(name);
  if (preset != nullptr) method->usePreset(preset);
  for (const auto& [setting, value] : wholeMethod.settings) method->set(setting, value);
  connectHost(*method, whole.inputs);
  method->connect(kOutputName, whole.output);
  whole.graph.exported(method->add(whole.graph).textures.at(std::string(kOutputName)), kComputeHost.outputAfter);

  HostGraph parts;
  Connections made;
  for (const Link& link : chain) {
    const auto node = makePass(link.type);
    for (const auto& [name, value] : link.settings) node->set(name, value);
    connectHost(*node, parts.inputs);
    connect(*node, made);
    if (std::string_view(link.type) == "temporal_antialiasing_with_taps") node->connect(kOutputName, parts.output);
    made.textures.merge(node->add(parts.graph).textures);
  }
  parts.graph.exported(made.textures.at(std::string(kOutputName)), kComputeHost.outputAfter);
  EXPECT_TRUE(compiled(parts.graph) == compiled(whole.graph)) << name;
}

TEST(Registry, StagesConnectedByNameArePlannedAsTheWholeMethodIs) {
  // With packed accumulation the whole method prepares guides and accumulates in one pass, which stages cannot.
  expectPlannedAs(
      {"walr", {{"accumulation.storage", "half"}, {"blocks.residual", "off"}}}, nullptr,
      {{"prepare_guides_with_occlusion", {}},
       {"temporal_accumulation_with_taps",
        {{"accumulation.max-history", "8"}, {"accumulation.antilag", "on"}, {"antialiasing.storage", "packed"}}},
       {"block_regression",
        {{"blocks.iterations", "2"},
         {"accumulation.max-history", "8"},
         {"accumulation.antilag", "on"},
         {"antialiasing.storage", "packed"}}},
       {"temporal_antialiasing_with_taps", {{"antialiasing.clip-gamma", "5"}, {"antialiasing.storage", "packed"}}}});
  expectPlannedAs({"walr_paper", {}}, "robust",
                  {{"prepare_guides", {}},
                   {"temporal_accumulation_with_taps", {}},
                   {"weighted_regression", {{"regression.iterations", "3"}}},
                   {"temporal_antialiasing_with_taps", {}}});
}

TEST(Registry, TheFilterTakesThisFramesLightIfItsShareIsMeasured) {
  for (const std::string share : {"off", "on"}) {
    HostGraph host;
    const auto filter = makePass("block_regression");
    filter->set("accumulation.storage", "half");
    filter->set("blocks.residual", share);
    const std::vector<Port> ports = filter->ports();
    EXPECT_EQ(std::ranges::count(ports, "lighting", &Port::name), share == "on" ? 1 : 0);
    connectHost(*filter, host.inputs);
    for (const Port& port : ports) {
      if (port.output || port.buffer || port.name == "lighting") continue;
      filter->connect(port.name, host.graph.import(port.name, {port.format, kExtent}, kComputeHost.inputs));
    }
    static_cast<void>(filter->add(host.graph));
    const auto& passes = host.graph.desc().passes;
    EXPECT_EQ(std::ranges::count(passes, "residual statistics", &fg::PassDecl::name), share == "on" ? 1 : 0);
  }
}

// Taps with and without pass-through light have the same format, so only their ports tell them apart.
TEST(Registry, TapsForAnotherStorageDoNotConnect) {
  for (const std::string kept : {"half", "packed"}) {
    for (const std::string taken : {"half", "packed"}) {
      HostGraph host;
      const auto accumulation = makePass("temporal_accumulation_with_taps");
      accumulation->set("antialiasing.storage", kept);
      const auto antialiasing = makePass("temporal_antialiasing_with_taps");
      antialiasing->set("antialiasing.storage", taken);
      std::vector<std::string> outputs;
      for (const Port& port : accumulation->ports())
        if (port.output) outputs.push_back(port.name);
      int taps = 0;
      for (const Port& port : antialiasing->ports()) taps += int(std::ranges::count(outputs, port.name));
      EXPECT_EQ(taps, kept == taken ? 1 : 0) << kept << ", " << taken;
      if (kept == taken) continue;
      const std::string error = errorText([&] {
        for (const Port& port : antialiasing->ports()) {
          if (port.buffer) antialiasing->connect(port.name, host.inputs.frame);
          if (port.name == "filtered")
            antialiasing->connect(port.name, host.graph.texture("filtered", {port.format, {640, 360}}));
        }
        (void)antialiasing->add(host.graph);
      });
      EXPECT_NE(error.find("'history-taps"), std::string::npos) << error;
      EXPECT_NE(error.find("temporal_accumulation_with_taps"), std::string::npos) << error;
    }
  }
}

// Guides with occlusion have no geometric normals of their own: their depth holds them. What reads histories takes
// both kinds; a filter that needs the other kind says so.
TEST(Registry, GeometricNormalsMayBeBesideDepth) {
  const auto geometricNormal = [](const char* type) {
    const std::vector<Port>& ports = typeOf(type).ports;
    return std::ranges::find(ports, "guides.geometric-normal", &Port::name);
  };
  const std::vector<Port>& withOcclusion = typeOf("prepare_guides_with_occlusion").ports;
  EXPECT_EQ(geometricNormal("prepare_guides_with_occlusion"), withOcclusion.end());
  EXPECT_NE(geometricNormal("prepare_guides"), typeOf("prepare_guides").ports.end());
  EXPECT_TRUE(geometricNormal("temporal_accumulation")->optional);
  EXPECT_FALSE(geometricNormal("weighted_regression")->optional);

  const auto specialization = [](bool connectNormals) {
    HostGraph host;
    const auto node = makePass("temporal_accumulation");
    connectHost(*node, host.inputs);
    for (const Port& port : node->ports()) {
      if (port.output || port.buffer || !port.name.starts_with("guides.")) continue;
      if (connectNormals || !port.optional)
        node->connect(port.name, host.graph.texture(port.name, {port.format, kExtent}));
    }
    (void)node->add(host.graph);
    return std::get<fg::ComputeDispatch>(host.graph.desc().passes.back().work).specialization;
  };
  EXPECT_NE(specialization(true), specialization(false));

  HostGraph host;
  const auto node = makePass("weighted_regression");
  for (const Port& port : node->ports()) {
    if (port.output) continue;
    if (port.buffer) node->connect(port.name, host.inputs.frame);
    if (!port.buffer) node->connect(port.name, host.graph.texture(port.name, {port.format, kExtent}));
  }
  node->connect("guides.geometric-normal", host.graph.texture("short", {VK_FORMAT_R16_UINT, kExtent}));
  expectError([&] { node->add(host.graph); }, {"takes R32_UINT, but R16_UINT"});
}

TEST(Registry, ConventionsReachThePasses) {
  const auto specialization = [](const InputConventions& conventions) {
    HostGraph host;
    const auto node = makePass("prepare_guides");
    node->setConventions(conventions);
    connectHost(*node, host.inputs);
    (void)node->add(host.graph);
    return std::get<fg::ComputeDispatch>(host.graph.desc().passes.back().work).specialization;
  };
  EXPECT_NE(specialization({.normal = InputConventions::Space::World}), specialization({}));
}

TEST(Registry, ErrorsNameTheFaultAndTheValidChoices) {
  expectError([] { (void)makePass("wlr"); }, {"\"wlr\"; known types: prepare_guides"});
  HostGraph host;
  const auto node = makePass("weighted_regression");
  expectError([&] { node->connect("acumulated", host.inputs.lighting); }, {"known ports: "});
  expectError([&] { node->connect("accumulated", host.inputs.frame); }, {"takes a texture"});
  expectError([&] { node->add(host.graph); }, {"nothing is connected to port"});
  expectError([&] { node->set("regression.iterations", "9"); }, {"1..5"});
  expectError([&] { node->usePreset("paper"); }, {"\"paper\""});

  const auto guides = makePass("prepare_guides");
  connectHost(*guides, host.inputs);
  guides->connect("depth", host.graph.import("ids", {VK_FORMAT_R32_UINT, kExtent}, kComputeHost.inputs));
  expectError([&] { guides->add(host.graph); }, {"input 'depth' cannot be of format R32_UINT"});
  guides->connect("depth", host.graph.import("z", {VK_FORMAT_D32_SFLOAT, kExtent}, kComputeHost.inputs));
  EXPECT_EQ(errorText([&] { guides->add(host.graph); }), "");

  const auto antialiasing = makePass("temporal_antialiasing");
  connectHost(*antialiasing, host.inputs);
  for (const Port& port : antialiasing->ports()) {
    if (!port.output && port.name.starts_with("guides.")) {
      antialiasing->connect(port.name, host.graph.texture(port.name, {port.format, kExtent}));
    }
  }
  antialiasing->connect("filtered", host.inputs.depth);
  expectError([&] { antialiasing->add(host.graph); }, {"takes R16G16B16A16_SFLOAT, but R32_SFLOAT"});
}

// An optional input is a port that may be left unconnected. Its passes are declared only if it is connected.
TEST(Registry, ObjectIdsAreAnOptionalPort) {
  const auto portOf = [](PassNode& node) {
    const std::vector<Port> ports = node.ports();
    return *std::ranges::find(ports, std::string("object_id"), &Port::name);
  };
  const auto keeps = [](PassNode& node) {
    const std::vector<std::string> passes = node.passNames();
    return std::ranges::find(passes, "keep object ids") != passes.end();
  };
  for (const std::string& method : denoiserNames()) {
    const auto node = makePass(method);
    EXPECT_TRUE(portOf(*node).optional) << method;
    EXPECT_EQ(portOf(*node).format, VK_FORMAT_R32_UINT) << method;
    EXPECT_EQ(portOf(*node).accesses.empty(), method != "joint_bilateral") << method;
    EXPECT_FALSE(keeps(*node)) << method;
  }
  HostGraph host;
  const auto node = makePass("joint_bilateral");
  connectHost(*node, host.inputs);
  node->connect("object_id", host.graph.import("floats", {VK_FORMAT_R32_SFLOAT, kExtent}, kComputeHost.inputs));
  expectError([&] { node->add(host.graph); }, {"sampled as unsigned integers with 1 channel or more"});
  node->connect("object_id", host.graph.import("stencil", {VK_FORMAT_D24_UNORM_S8_UINT, kExtent}, kComputeHost.inputs));
  expectError([&] { node->add(host.graph); }, {"cannot be of format D24_UNORM_S8_UINT"});
  node->connect("object_id", host.graph.import("ids", {VK_FORMAT_R16_UINT, kExtent}, kComputeHost.inputs));
  EXPECT_TRUE(keeps(*node));
  host.graph.exported(node->add(host.graph).textures.at(std::string(kOutputName)), kComputeHost.outputAfter);
  const std::string plan = compiled(host.graph);
  EXPECT_NE(plan.find("keep object ids"), std::string::npos) << plan;
}

TEST(Registry, SettingsAreDescribedWithTheirCurrentValues) {
  const PassType& walr = typeOf("walr_paper");
  const auto find = [&](const char* name) {
    return *std::ranges::find(walr.settings, std::string(name), &SettingDescription::name);
  };
  const SettingDescription iterations = find("regression.iterations");
  EXPECT_EQ(iterations.kind, SettingKind::Integer);
  EXPECT_EQ(iterations.value, "4");
  EXPECT_EQ(iterations.least, 1.0);
  EXPECT_EQ(iterations.most, 5.0);
  EXPECT_EQ(find("regression.moments").choices.size(), 4U);
  EXPECT_EQ(find("regression.trace-edges").kind, SettingKind::Switch);
  EXPECT_EQ(find("accumulation.max-history").unit, "frames");
  // Setting the listed value changes nothing.
  for (const PassType& type : passTypes()) {
    const auto node = makePass(type.name);
    for (const SettingDescription& setting : type.settings) node->set(setting.name, setting.value);
    const std::vector<SettingDescription> again = describeSettings(*node);
    for (std::size_t i = 0; i < again.size(); ++i) EXPECT_EQ(again[i].value, type.settings[i].value) << again[i].name;
  }
}

TEST(Registry, TheListingNamesEveryTypePortAndSetting) {
  const std::string listing = "\n" + passListing();
  for (const PassType& type : passTypes()) {
    EXPECT_NE(listing.find("\n" + type.name), std::string::npos);
    for (const Port& port : type.ports) EXPECT_NE(listing.find(" " + port.name + ": "), std::string::npos);
    for (const auto& setting : type.settings) EXPECT_NE(listing.find("set " + setting.name), std::string::npos);
  }
}

}  // namespace
}  // namespace walr::registry_test
