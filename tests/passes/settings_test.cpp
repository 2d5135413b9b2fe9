#include "passes/settings/settings.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "passes/methods/denoiser.h"
#include "tests/error_text.h"

namespace walr {
namespace {

using fg::test::errorText;

std::string valueOf(Denoiser& denoiser, const std::string& name) {
  const std::vector<SettingText> settings = denoiser.settings();
  const auto found = std::ranges::find(settings, name, &SettingText::name);
  return found == settings.end() ? "no such setting" : found->value;
}

TEST(Settings, EveryKindIsSetFromText) {
  const auto walr = makeDenoiser("walr_paper");
  walr->set("regression.iterations", "3");
  walr->set("regression.plane-far", "0.02");
  walr->set("regression.replace-taps", "off");
  walr->set("accumulation.history-filter", "bicubic");
  EXPECT_EQ(valueOf(*walr, "regression.iterations"), "3");
  EXPECT_EQ(valueOf(*walr, "regression.plane-far"), "0.02");
  EXPECT_EQ(valueOf(*walr, "regression.replace-taps"), "off");
  EXPECT_EQ(valueOf(*walr, "accumulation.history-filter"), "bicubic");
}

/// The error message of a method for an unknown name.
std::string unknown(const std::string& method, const std::string& name) {
  return errorText([&] { makeDenoiser(method)->set(name, "3"); });
}

TEST(Settings, AnUnknownNameIsRejectedWithTheNearOnes) {
  const std::string misspelt = unknown("walr_paper", "regression.iteration");
  EXPECT_EQ(misspelt.find("there is no setting \"regression.iteration\" here; near ones: regression.iterations, "), 0U)
      << misspelt;
  EXPECT_EQ(misspelt.find("accumulation."), std::string::npos) << misspelt;
  EXPECT_EQ(unknown("walr", "spacial-only"), "there is no setting \"spacial-only\" here; near ones: spatial-only");
  EXPECT_EQ(unknown("walr", "iterations"), "there is no setting \"iterations\" here; near ones: blocks.iterations");
  const std::string message = unknown("none", "strength");
  EXPECT_EQ(message.find("there is no setting \"strength\" here; known settings: scene.camera-motion, "), 0U)
      << message;
}

TEST(Settings, SettingsOfOtherMethodsAreRejected) {
  EXPECT_EQ(unknown("walr", "regression.iterations"),
            "there is no setting \"regression.iterations\" here; near ones: blocks.iterations");
  EXPECT_EQ(unknown("walr_paper", "blocks.iterations"),
            "there is no setting \"blocks.iterations\" here; near ones: regression.iterations");
  EXPECT_EQ(unknown("walr_paper", "walr.fit-window"),
            "there is no setting \"walr.fit-window\" here; near ones: walr_paper.fit-window");
  for (const char* name : {"occlusion.rings", "accumulation.storage", "antialiasing.storage", "blocks.size"}) {
    EXPECT_NE(unknown("walr_paper", name).find("there is no setting"), std::string::npos) << name;
    EXPECT_EQ(unknown("walr", name).find("there is no setting"), std::string::npos) << name;
  }
}

TEST(Settings, FormerNamesAreRejectedWithTheReplacement) {
  EXPECT_EQ(unknown("walr", "walr.filter"),
            "there is no setting \"walr.filter\" here: method walr regresses over blocks of pixels, method walr_paper "
            "over pixels");
  for (const auto& [former, now] : {std::pair{"accumulation.max-samples", "accumulation.max-history"},
                                    {"antialiasing.max-samples", "antialiasing.max-history"},
                                    {"accumulation.respond-to-change", "accumulation.antilag"},
                                    {"accumulation.change-low", "accumulation.antilag-low"},
                                    {"accumulation.change-high", "accumulation.antilag-high"}}) {
    EXPECT_EQ(unknown("walr", former),
              "there is no setting \"" + std::string(former) + "\" here: it is called " + now + " now");
  }
  EXPECT_NE(unknown("bmfr", "fitted.max-samples").find("fitted.max-history now"), std::string::npos);
  EXPECT_NE(unknown("svgf", "accumulation.max-moment-samples").find("accumulation.max-moment-history now"),
            std::string::npos);
  EXPECT_EQ(
      unknown("svgf", "accumulation.respond-to-change")
          .find("there is no setting \"accumulation.respond-to-change\" here: it is called accumulation.antilag now, "
                "which is not a setting here either; near ones: accumulation."),
      0U);
  EXPECT_EQ(unknown("walr", "blocks.sdf-fraction"),
            "there is no setting \"blocks.sdf-fraction\" here: its value, which was measured, is fixed; leave it out");
  EXPECT_EQ(unknown("walr", "blocks.sort-tiles"),
            "there is no setting \"blocks.sort-tiles\" here: tiles are no longer sorted; leave it out");
}

TEST(Settings, AValueOutsideTheRangeIsRejectedWithTheRange) {
  const auto walr = makeDenoiser("walr_paper");
  for (const char* value : {"0", "6", "-1", "3.5", "many", "", "nan", "3 "}) {
    const std::string message = errorText([&] { walr->set("regression.iterations", value); });
    EXPECT_NE(message.find("regression.iterations"), std::string::npos) << value;
    EXPECT_NE(message.find("1..5"), std::string::npos) << value;
  }
  EXPECT_NE(errorText([&] { walr->set("regression.plane-far", "nan"); }), "");
  EXPECT_EQ(valueOf(*walr, "regression.iterations"), "4");
}

TEST(Settings, AnUnknownChoiceIsRejectedWithTheChoices) {
  const auto walr = makeDenoiser("walr_paper");
  const std::string message = errorText([&] { walr->set("regression.moments", "raw64"); });
  EXPECT_NE(message.find("centred16, raw16, raw11, raw32"), std::string::npos) << message;
}

TEST(Settings, EverySettingOfEveryMethodHasDescriptionSourceAndRange) {
  for (const std::string& method : denoiserNames()) {
    const auto denoiser = makeDenoiser(method);
    std::vector<std::string> names;
    for (const SettingText& setting : denoiser->settings()) {
      EXPECT_FALSE(setting.description.empty()) << method << " " << setting.name;
      EXPECT_FALSE(setting.source.empty()) << method << " " << setting.name;
      EXPECT_EQ(setting.source.find(".txt"), std::string::npos)
          << "cites a file instead of authors and year: " << setting.source;
      EXPECT_FALSE(setting.range.empty()) << method << " " << setting.name;
      names.push_back(setting.name);
    }
    std::ranges::sort(names);
    EXPECT_TRUE(std::ranges::adjacent_find(names) == names.end()) << method << " has two settings of the same name";
    EXPECT_NO_THROW(denoiser->checkSettings()) << method;
  }
}

TEST(Settings, ADefaultCanBeSetFromItsOwnText) {
  for (const std::string& method : denoiserNames()) {
    const auto denoiser = makeDenoiser(method);
    for (const SettingText& setting : denoiser->settings()) {
      EXPECT_NO_THROW(denoiser->set(setting.name, setting.value)) << method << " " << setting.name;
    }
  }
}

TEST(Settings, BothEndsOfARangeCanBeSet) {
  for (const std::string& method : denoiserNames()) {
    const auto denoiser = makeDenoiser(method);
    for (const SettingText& setting : denoiser->settings()) {
      const std::size_t dots = setting.range.find("..");
      if (dots == std::string::npos) continue;
      EXPECT_NO_THROW(denoiser->set(setting.name, setting.range.substr(0, dots))) << method;
      EXPECT_NO_THROW(denoiser->set(setting.name, setting.range.substr(dots + 2))) << method;
    }
    EXPECT_NO_THROW(denoiser->checkSettings()) << method;
  }
}

TEST(Settings, AnUnknownMethodIsRejectedWithTheKnownOnes) {
  const std::string message = errorText([] { (void)makeDenoiser("wlar"); });
  EXPECT_NE(message.find("\"wlar\""), std::string::npos) << message;
  for (const std::string& method : denoiserNames()) EXPECT_NE(message.find(method), std::string::npos) << message;
}

TEST(Presets, ReplaceAllSettings) {
  const auto walr = makeDenoiser("walr_paper");
  walr->set("regression.iterations", "2");
  walr->usePreset("paper");
  EXPECT_EQ(valueOf(*walr, "regression.iterations"), "4");
  EXPECT_EQ(valueOf(*walr, "regression.moments"), "raw16");
  walr->usePreset("robust");
  EXPECT_EQ(valueOf(*walr, "regression.moments"), "centred16");
}

TEST(Presets, TheFirstOneHasTheDefaults) {
  for (const std::string& method : denoiserNames()) {
    const auto denoiser = makeDenoiser(method);
    if (denoiser->presets().empty()) continue;
    const auto preset = makeDenoiser(method);
    preset->usePreset(preset->presets().front());
    const std::vector<SettingText> expected = denoiser->settings();
    const std::vector<SettingText> actual = preset->settings();
    ASSERT_EQ(expected.size(), actual.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(expected[i].value, actual[i].value) << expected[i].name;
  }
}

TEST(Presets, AnUnknownOneIsRejectedWithTheKnownOnes) {
  const std::string message = errorText([] { makeDenoiser("walr_paper")->usePreset("best"); });
  EXPECT_NE(message.find("paper, robust"), std::string::npos) << message;
}

TEST(Presets, FormerPresetsOfWalrAreRejectedWithTheMethodToUse) {
  for (const char* preset : {"fast", "blocks", "one-sample", "many-samples", "robust", "paper"}) {
    const std::string message = errorText([&] { makeDenoiser("walr")->usePreset(preset); });
    EXPECT_NE(message.find("\"" + std::string(preset) + "\""), std::string::npos) << message;
    EXPECT_NE(message.find("fast, blocks, one-sample and many-samples are part of standard"), std::string::npos)
        << message;
    EXPECT_NE(message.find("robust and paper are presets of the method walr_paper"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace walr
