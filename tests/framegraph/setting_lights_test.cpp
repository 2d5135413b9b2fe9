// Whether every setting acts on the lights that it says it acts on, and on no other: by the graphs that methods declare
// with one value and with another.

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/declare/same_topology.h"
#include "integration/denoise_graph.h"
#include "integration/setting_info.h"

namespace walr {
namespace {

using Setting = std::pair<std::string, std::string>;

/// All inputs, those that are optional, too.
std::vector<VkFormat> allFormats() {
  std::vector<VkFormat> formats;
  for (const HostInput& input : kHostInputs) formats.push_back(input.format);
  return formats;
}

/// The graph of a method; nothing where it refuses the settings.
/// @throws std::invalid_argument if a value is out of range
std::optional<fg::Graph> declared(const std::string& name, std::span<const Setting> settings, fg::Extent extent,
                                  bool specular) {
  const std::unique_ptr<Denoiser> method = makeDenoiser(name);
  const auto known = method->settings();
  for (const auto& [setting, value] : settings) {
    const bool has = std::ranges::find(known, setting, &SettingText::name) != known.end();
    if (has) method->set(setting, value);
  }
  const std::vector<VkFormat> formats = allFormats();
  const DenoisedLight light{.method = method.get(), .specular = specular};
  try {
    return declareDenoiseGraph(std::span(&light, 1), extent, {.specular = specular}, kComputeHost, formats).graph;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// Whether two graphs do the same work, also by the values of their constants.
bool same(const fg::GraphDesc& a, const fg::GraphDesc& b) {
  if (!fg::sameTopology(a, b)) return false;
  return std::ranges::equal(a.passes, b.passes, [](const fg::PassDecl& x, const fg::PassDecl& y) {
    const auto* one = std::get_if<fg::ComputeDispatch>(&x.work);
    const auto* other = std::get_if<fg::ComputeDispatch>(&y.work);
    if (one == nullptr || other == nullptr) return one == other;
    return one->specialization == other->specialization && one->constants == other->constants &&
           std::ranges::equal(one->groups, other->groups);
  });
}

template <typename Number>
std::string text(Number value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// Values that a setting may take instead of its own.
std::vector<std::string> otherValues(const SettingDescription& setting) {
  std::vector<std::string> values = setting.choices;
  if (setting.kind == SettingKind::Number) {
    values = {text(setting.least), text(setting.most), text(0.5 * std::stod(setting.value))};
  } else if (setting.kind == SettingKind::Integer) {
    values = {text(setting.least), text(setting.least + 1.0), text(setting.most)};
  }
  std::erase(values, setting.value);
  return values;
}

/// Settings and sizes in which a setting may act; some act only beside others.
struct Situation {
  std::vector<Setting> settings;
  fg::Extent extent{640, 360};
};

const std::vector<Situation>& situations() {
  static const std::vector<Situation> all{
      {},
      {{}, {1920, 1080}},
      {{{"walr.fit-window", "off"}}},
      {{{"accumulation.antilag", "on"}}},
      {{{"scene.jitter", "off"}}},
      {{{"svgf.lobe-share", "0"}}},
  };
  return all;
}

/// Whether any other value of a setting changes the graph in any situation, or is refused there with a reason.
bool acts(const std::string& method, const SettingDescription& setting, bool specular) {
  return std::ranges::any_of(situations(), [&](const Situation& situation) {
    const auto before = declared(method, situation.settings, situation.extent, specular);
    if (!before) return false;
    return std::ranges::any_of(otherValues(setting), [&](const std::string& value) {
      std::vector<Setting> settings = situation.settings;
      settings.emplace_back(setting.name, value);
      const auto after = declared(method, settings, situation.extent, specular);
      return !after || !same(before->desc(), after->desc());
    });
  });
}

TEST(SettingLights, EverySettingActsOnTheLightsThatItSays) {
  std::size_t ofOneLight = 0;
  for (const std::string& name : denoiserNames()) {
    const std::unique_ptr<Denoiser> method = makeDenoiser(name);
    if (!method->takesSpecularLight()) continue;
    for (const SettingDescription& setting : describeSettings(*method)) {
      if (setting.name.starts_with("scene.")) continue;  // States what the host has.
      for (const bool specular : {false, true}) {
        const bool does = acts(name, setting, specular);
        ofOneLight += does ? 0 : 1;
        EXPECT_EQ(does, specular ? setting.lights.specular : setting.lights.diffuse)
            << name << ", " << setting.name << ", " << (specular ? "specular" : "diffuse") << " light";
      }
    }
  }
  EXPECT_GT(ofOneLight, 10U);
}

}  // namespace
}  // namespace walr
