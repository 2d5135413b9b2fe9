// Two lights of a view in one denoiser, which share their guides: the results are those of two denoisers, to the bit.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plugin_host.h"

namespace plugin_host {
namespace {

constexpr Size kSize{45, 37};
constexpr std::uint32_t kFrames = 5;
constexpr std::uint32_t kReset = 3;  ///< The frame that drops the history.
constexpr std::array kOutputs{"denoised", "history_length", "light_direction", "expected_error"};

class TwoLights : public PluginTest {
 protected:
  /// Inputs of a frame by name; the lights differ in lighting and confidence. Normals vary, so that light has a slope.
  static std::vector<float> inputOf(const std::string& name, std::uint32_t number, bool second) {
    std::vector<float> values = texels(name, kSize, number + (second && name == "lighting" ? 100 : 0));
    for (std::size_t i = 0; name == "normal" && i < values.size(); i += 4) {
      values[i] = 0.06F * float(i / 4 % 11) - 0.3F;
      values[i + 2] = std::sqrt(1.0F - values[i] * values[i]);
    }
    if (name == "confidence" && second) {
      for (float& value : values) value = 1.0F - value;
    }
    return values;
  }

  /// A description with whatever a light can have.
  [[nodiscard]] WalrDenoiserInfo described(const char* method) const {
    WalrDenoiserInfo whole = info(method, kSize);
    whole.confidence_format = VK_FORMAT_R32_SFLOAT;
    whole.history_length = VK_TRUE;
    return whole;
  }

  /// Compare the lights of `both` with denoisers of their own.
  void compare(const WalrDenoiserInfo& both, const WalrDenoiserInfo& one, const WalrDenoiserInfo& other) {
    Opaque together(host, api(), both);
    Opaque first(host, api(), one);
    Opaque second(host, api(), other);
    for (std::uint32_t number = 0; number < kFrames; ++number) {
      SCOPED_TRACE(std::string(both.method) + ", frame " + std::to_string(number));
      fill(together, first, second, number);
      const WalrCamera camera = cameraAt(float(number) * kStep);
      const std::uint32_t flags = number == kReset ? WALR_FRAME_RESET_HISTORY : 0;
      for (Opaque* each : {&together, &first, &second}) each->frame(camera, flags);
      for (const std::string output : kOutputs) {
        const bool ofWalr = output == "light_direction" || output == "expected_error";
        if (ofWalr && both.light_direction == VK_FALSE) continue;
        const auto ofFirst = download(host, together.image(output));
        const auto ofSecond = download(host, together.image("second_" + output));
        EXPECT_EQ(ofFirst, download(host, first.image(output))) << output;
        EXPECT_EQ(ofSecond, download(host, second.image(output))) << output;
        if (output == "history_length") continue;  // It may be the same.
        EXPECT_NE(ofFirst, ofSecond) << output;
      }
    }
  }

  void fill(Opaque& together, Opaque& first, Opaque& second, std::uint32_t number) {
    for (Opaque* each : {&together, &first, &second}) {
      for (const NeededImage& image : each->needed()) {
        if (image.written()) continue;
        const bool prefixed = image.name.starts_with("second_");
        const std::string name = image.name.substr(prefixed ? 7 : 0);
        host_upload(&host, &each->image(image.name), inputOf(name, number, prefixed || each == &second).data());
      }
    }
  }
};

TEST_F(TwoLights, AreThoseOfTwoDenoisers) {
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE || std::string(type->name) == "none") continue;
    WalrDenoiserInfo one = described(type->name);
    one.light_direction = one.expected_error = std::string(type->name) == "walr" ? VK_TRUE : VK_FALSE;
    WalrDenoiserInfo both = one;
    both.light_count = 2;
    compare(both, one, one);
  }
}

// Methods that do not take specular light say so.
TEST_F(TwoLights, OfTwoKindsAreThoseOfTwoDenoisers) {
  constexpr WalrLightKind kDiffuse = WALR_LIGHT_DIFFUSE, kSpecular = WALR_LIGHT_SPECULAR;
  // The first pair with every method, the others with one.
  const std::vector<std::pair<WalrLightKind, WalrLightKind>> pairs{
      {kDiffuse, kSpecular}, {kSpecular, kDiffuse}, {kSpecular, kSpecular}};
  int tried = 0;
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE || std::string(type->name) == "none") continue;
    const WalrDenoiserInfo specular = ofLights(described(type->name), kSpecular);
    WalrDenoiser denoiser = nullptr;
    if (api().create_denoiser(&specular, &denoiser) != WALR_SUCCESS) {
      EXPECT_NE(std::string(api().last_error()).find("takes diffuse light only"), std::string::npos)
          << api().last_error();
      continue;
    }
    EXPECT_EQ(api().destroy_denoiser(denoiser), WALR_SUCCESS);
    const std::size_t count = std::string(type->name) == "accumulate" ? pairs.size() : 1;
    for (const auto& [first, second] : std::span(pairs).first(count)) {
      SCOPED_TRACE(std::to_string(first) + ", " + std::to_string(second));
      const WalrDenoiserInfo one = described(type->name);
      compare(ofLights(one, first, second), ofLights(one, first), ofLights(one, second));
    }
    ++tried;
  }
  EXPECT_GE(tried, 1);
}

WalrConventions exposedInARectangle() {
  WalrConventions conventions{};
  conventions.struct_size = sizeof(conventions);
  conventions.pre_exposed = VK_TRUE;
  conventions.rectangle = VK_TRUE;
  return conventions;
}

TEST_F(TwoLights, OfTwoKindsHaveConventionsOfAHost) {
  const WalrConventions conventions = exposedInARectangle();
  WalrDenoiserInfo one = described("accumulate");
  one.conventions = &conventions;
  one.denoised_format = VK_FORMAT_R32G32B32A32_SFLOAT;
  compare(ofLights(one, WALR_LIGHT_DIFFUSE, WALR_LIGHT_SPECULAR), ofLights(one, WALR_LIGHT_DIFFUSE),
          ofLights(one, WALR_LIGHT_SPECULAR));
}

TEST_F(TwoLights, HavePresetsAndConventionsOfAHost) {
  const WalrConventions conventions = exposedInARectangle();
  WalrDenoiserInfo one = described("bmfr");
  one.conventions = &conventions;
  one.denoised_format = VK_FORMAT_R32G32B32A32_SFLOAT;
  WalrDenoiserInfo other = one;
  other.preset = "paper";
  WalrDenoiserInfo both = one;
  both.light_count = 2;
  both.second_preset = "paper";
  compare(both, one, other);
}

TEST_F(TwoLights, MayHaveOneImageOfConfidence) {
  WalrDenoiserInfo both = described("walr");
  both.light_count = 2;
  Opaque apart(host, api(), both);
  Opaque shared(host, api(), both);
  const HostImage own = shared.image("second_confidence");
  for (std::uint32_t number = 0; number < 2; ++number) {
    const std::vector<float> confidence = inputOf("confidence", number, false);
    for (Opaque* each : {&apart, &shared}) {
      for (const char* name : kInputs) host_upload(&host, &each->image(name), inputOf(name, number, false).data());
      host_upload(&host, &each->image("second_lighting"), inputOf("lighting", number, true).data());
      host_upload(&host, &each->image("confidence"), confidence.data());
    }
    host_upload(&host, &apart.image("second_confidence"), confidence.data());
    shared.image("second_confidence") = shared.image("confidence");
    for (Opaque* each : {&apart, &shared}) each->frame(cameraAt(float(number) * kStep), 0);
    EXPECT_EQ(download(host, shared.image("second_denoised")), download(host, apart.image("second_denoised")));
  }
  shared.image("second_confidence").stage = VK_PIPELINE_STAGE_2_COPY_BIT;
  EXPECT_THROW(shared.frame(cameraAt(0.0F), 0), std::runtime_error);
  EXPECT_NE(std::string(api().last_error()).find("image 'second_confidence' is also the image 'confidence'"),
            std::string::npos);
  shared.image("second_confidence") = own;
}

// A view of the second light is that of a denoiser of its own.
TEST_F(TwoLights, HaveViewsOfTheirOwn) {
  const WalrDenoiserInfo one = info("walr", kSize);
  WalrDenoiserInfo both = one;
  both.light_count = 2;
  Opaque together(host, api(), both, "second.coarse-fit");
  Opaque first(host, api(), one, "coarse-fit");
  Opaque second(host, api(), one, "coarse-fit");
  for (std::uint32_t number = 0; number < 2; ++number) {
    fill(together, first, second, number);
    for (Opaque* each : {&together, &first, &second}) each->frame(cameraAt(float(number) * kStep), 0);
  }
  EXPECT_EQ(download(host, together.image("view")), download(host, second.image("view")));
  EXPECT_NE(download(host, together.image("view")), download(host, first.image("view")));
  WalrDenoiser alone = nullptr;
  require(api().create_denoiser(&one, &alone));
  EXPECT_EQ(api().set_view(alone, "second.coarse-fit"), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(api().destroy_denoiser(alone), WALR_SUCCESS);
}

/// What the guide shows (integration/docs/advanced.md).
void takeSpecularLight(WalrDenoiserInfo& info, WalrFrame& frame, const WalrImage& lighting, const WalrImage& denoised,
                       const WalrImage& albedo, const WalrImage& roughness) {
  info.light_count = 2;  // The first is diffuse light.
  info.second_light_kind = WALR_LIGHT_SPECULAR;
  // In each frame, beside what diffuse light needs:
  frame.second_lighting = &lighting;  // rgb: light / specular_albedo; a: distance to what the ray hit
  frame.second_denoised = &denoised;
  frame.specular_albedo = &albedo;  // walrSpecularAlbedo(f0, roughness, dot(normal, toEye)) of each channel
  frame.roughness = &roughness;
}

TEST_F(TwoLights, AsTheGuideShowsThem) {
  WalrDenoiserInfo both = info("walr", kSize);
  WalrFrame frame{};
  const std::array<WalrImage, 4> images{};
  takeSpecularLight(both, frame, images[0], images[1], images[2], images[3]);
  WalrDenoiser denoiser = nullptr;
  require(api().create_denoiser(&both, &denoiser));
  const auto required = [&](const char* image) {
    WalrImageRequirements needs{};
    needs.struct_size = sizeof(needs);
    require(api().get_image_requirements(denoiser, image, &needs));
    return needs.required == VK_TRUE;
  };
  EXPECT_TRUE(frame.second_lighting != nullptr && required("second_lighting"));
  EXPECT_TRUE(frame.second_denoised != nullptr && required("second_denoised"));
  EXPECT_TRUE(frame.specular_albedo != nullptr && required("specular_albedo"));
  EXPECT_TRUE(frame.roughness != nullptr && required("roughness"));
  EXPECT_FALSE(required("specular_motion"));
  EXPECT_EQ(api().destroy_denoiser(denoiser), WALR_SUCCESS);
}

// Diffuse light has no such view.
TEST_F(TwoLights, OfTwoKindsHaveViewsOfTheirOwn) {
  const WalrDenoiserInfo one = info("accumulate", kSize);
  const WalrDenoiserInfo both = ofLights(one, WALR_LIGHT_DIFFUSE, WALR_LIGHT_SPECULAR);
  const WalrDenoiserInfo specular = ofLights(one, WALR_LIGHT_SPECULAR);
  Opaque together(host, api(), both, "second.reflection-motion");
  Opaque first(host, api(), one);
  Opaque second(host, api(), specular, "reflection-motion");
  for (std::uint32_t number = 0; number < 2; ++number) {
    fill(together, first, second, number);
    for (Opaque* each : {&together, &first, &second}) each->frame(cameraAt(float(number) * kStep), 0);
  }
  const auto view = download(host, together.image("view"));
  EXPECT_EQ(view, download(host, second.image("view")));
  EXPECT_TRUE(std::ranges::any_of(view, [](std::uint16_t bits) { return bits != 0; }));
  EXPECT_EQ(api().set_view(together.denoiser(), "reflection-motion"), WALR_ERROR_INVALID_ARGUMENT);
  const auto has = [&](const Opaque& opaque, std::string_view name) {
    std::array<WalrView, 64> views{};
    std::uint32_t count = views.size();
    require(api().get_views(opaque.denoiser(), &count, views.data()));
    return std::any_of(views.begin(), views.begin() + count, [&](const WalrView& each) { return each.name == name; });
  };
  EXPECT_TRUE(has(second, "reflection-motion"));
  EXPECT_FALSE(has(first, "reflection-motion"));
  EXPECT_TRUE(has(together, "second.reflection-motion"));
  EXPECT_FALSE(has(together, "reflection-motion"));
  EXPECT_TRUE(has(together, "history"));
}

TEST_F(TwoLights, HaveSettingsOfTheirOwn) {
  WalrDenoiserInfo both = info("walr", kSize);
  both.light_count = 2;
  WalrDenoiser denoiser = nullptr;
  require(api().create_denoiser(&both, &denoiser));
  const auto setting = [&](const char* name) {
    std::array<char, 32> text{};
    std::size_t size = text.size();
    require(api().get_setting(denoiser, name, text.data(), &size));
    return std::string(text.data());
  };
  require(api().set_setting(denoiser, "accumulation.max-history", "5"));
  EXPECT_EQ(setting("accumulation.max-history"), setting("second.accumulation.max-history"));
  require(api().set_setting(denoiser, "second.accumulation.max-history", "7"));
  EXPECT_EQ(setting("accumulation.max-history"), "5");
  EXPECT_EQ(setting("second.accumulation.max-history"), "7");
  require(api().set_setting(denoiser, "blocks.residual", "off"));
  require(api().use_preset(denoiser, "second.standard"));
  EXPECT_EQ(setting("blocks.residual"), "off");
  EXPECT_EQ(setting("second.blocks.residual"), "on");
  require(api().use_preset(denoiser, "standard"));
  EXPECT_EQ(setting("blocks.residual"), "on");
  require(api().prepare(denoiser));
  // Lights with other guides cannot share them.
  require(api().set_setting(denoiser, "second.occlusion.rings", "3"));
  EXPECT_EQ(api().prepare(denoiser), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(std::string(api().last_error()).find("make a denoiser for each light"), std::string::npos);
  require(api().set_setting(denoiser, "occlusion.rings", "3"));
  require(api().prepare(denoiser));
  EXPECT_EQ(api().destroy_denoiser(denoiser), WALR_SUCCESS);
}

TEST_F(TwoLights, RefuseSettingsThatActOnNeither) {
  const auto set = [&](const WalrDenoiserInfo& lights, const char* name, const char* value) {
    WalrDenoiser denoiser = nullptr;
    require(api().create_denoiser(&lights, &denoiser));
    const WalrResult result = api().set_setting(denoiser, name, value);
    const std::string error = result == WALR_SUCCESS ? "" : api().last_error();
    EXPECT_EQ(api().destroy_denoiser(denoiser), WALR_SUCCESS);
    return error;
  };
  const std::string specularOnly = "acts on specular light only, and only diffuse light is denoised";
  const std::string diffuseOnly = "acts on diffuse light only, and only specular light is denoised";
  const WalrDenoiserInfo diffuse = info("walr", kSize);
  const WalrDenoiserInfo specular = ofLights(diffuse, WALR_LIGHT_SPECULAR);
  WalrDenoiserInfo both = diffuse;
  both.light_count = 2;
  both.second_light_kind = WALR_LIGHT_SPECULAR;
  EXPECT_NE(set(specular, "blocks.size", "4").find("blocks.size " + diffuseOnly), std::string::npos);
  EXPECT_NE(set(both, "second.blocks.size", "4").find("blocks.size " + diffuseOnly), std::string::npos);
  EXPECT_NE(set(diffuse, "antialiasing.specular-clip-gamma", "1").find(specularOnly), std::string::npos);
  EXPECT_NE(set(specular, "accumulation.max-history", "4").find(": set accumulation.max-specular-history"),
            std::string::npos);
  EXPECT_EQ(set(both, "blocks.size", "4"), "");
  EXPECT_EQ(set(both, "second.antialiasing.specular-clip-gamma", "1"), "");
  EXPECT_EQ(set(specular, "antialiasing.max-history", "4"), "");
}

// Metals have diffuse light and none of the specular lobe.
TEST_F(TwoLights, AreSwappedAndTheLinterSaysSo) {
  WalrDenoiserInfo both = ofLights(info("accumulate", kSize), WALR_LIGHT_DIFFUSE, WALR_LIGHT_SPECULAR);
  both.lint = VK_TRUE;
  for (const bool swapped : {false, true}) {
    Opaque run(host, api(), both);
    for (std::uint32_t number = 0; number < kFrames; ++number) {
      for (const NeededImage& image : run.needed()) {
        if (image.written()) continue;
        const bool second = image.name.starts_with("second_");
        std::vector<float> values = inputOf(image.name.substr(second ? 7 : 0), number, second);
        const bool dark = image.name == (swapped ? "second_lighting" : "lighting");
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (image.name == "albedo" || (dark && i % 4 < 3)) values[i] = 0.0F;
          if (image.name == "specular_albedo") values[i] = 0.9F;
        }
        host_upload(&host, &run.image(image.name), values.data());
      }
      run.frame(cameraAt(float(number) * kStep), 0);
    }
    std::array<WalrFinding, 16> findings{};
    std::uint32_t count = findings.size();
    require(api().get_findings(run.denoiser(), &count, findings.data()));
    const auto end = findings.begin() + count;
    const bool found = std::any_of(findings.begin(), end, [](const WalrFinding& finding) {
      return std::string_view(finding.name) == "lobes-swapped";
    });
    EXPECT_EQ(found, swapped);
  }
}

TEST_F(TwoLights, LackTheSecondAndTheLinterSaysSo) {
  WalrDenoiserInfo both = ofLights(info("accumulate", kSize), WALR_LIGHT_DIFFUSE, WALR_LIGHT_SPECULAR);
  both.lint = VK_TRUE;
  struct Lack {
    const char* finding;
    std::string_view image;
    std::size_t first;  ///< Of the four channels that are 0.
    std::size_t last;
  };
  constexpr std::array kFindings{"specular-empty", "specular-zero", "specular-albedo-empty"};
  for (const Lack& lack :
       {Lack{"specular-empty", "second_lighting", 3, 3}, Lack{"specular-zero", "second_lighting", 0, 2},
        Lack{"specular-albedo-empty", "specular_albedo", 0, 3}, Lack{"", "", 0, 0}}) {
    SCOPED_TRACE(lack.finding);
    Opaque run(host, api(), both);
    for (const NeededImage& image : run.needed()) {
      if (image.written()) continue;
      const bool second = image.name.starts_with("second_");
      std::vector<float> values = inputOf(image.name.substr(second ? 7 : 0), 0, second);
      for (std::size_t i = 0; image.name == lack.image && i < values.size(); ++i) {
        if (i % 4 >= lack.first && i % 4 <= lack.last) values[i] = 0.0F;
      }
      host_upload(&host, &run.image(image.name), values.data());
    }
    for (std::uint32_t number = 0; number < kFrames; ++number) run.frame(cameraAt({}), 0);
    std::array<WalrFinding, 16> findings{};
    std::uint32_t count = findings.size();
    require(api().get_findings(run.denoiser(), &count, findings.data()));
    for (const std::string_view name : kFindings) {
      const bool found = std::any_of(findings.begin(), findings.begin() + count,
                                     [&](const WalrFinding& finding) { return finding.name == name; });
      EXPECT_EQ(found, name == lack.finding) << name;
    }
  }
}

/// The memory that denoisers allocate.
std::uint64_t allocated(const WalrApi& api, const WalrDenoiserInfo& info) {
  WalrMemory memory{};
  memory.struct_size = sizeof(memory);
  EXPECT_EQ(api.query_memory(&info, &memory), WALR_SUCCESS) << api.last_error();
  return memory.allocated;
}

TEST_F(TwoLights, TakeLessMemoryThanTwoDenoisersThatShareObjects) {
  constexpr Size kFullHd{1920, 1080};
  const WalrDenoiserInfo one = info("walr", kFullHd);
  WalrDenoiserInfo both = one;
  both.light_count = 2;
  WalrDenoiser first = nullptr;
  WalrDenoiser second = nullptr;
  require(api().create_denoiser(&one, &first));
  require(api().prepare(first));
  WalrDenoiserInfo other = one;
  other.shared_with = first;
  require(api().create_denoiser(&other, &second));
  require(api().prepare(second));
  WalrMemory memory{};
  memory.struct_size = sizeof(memory);
  require(api().get_memory(second, &memory));
  const std::uint64_t separate = allocated(api(), one) + memory.allocated - memory.shared;
  const std::uint64_t together = allocated(api(), both);
  RecordProperty("separate", std::to_string(separate));
  RecordProperty("together", std::to_string(together));
  EXPECT_LT(together, separate);
  EXPECT_EQ(api().destroy_denoiser(second), WALR_SUCCESS);
  EXPECT_EQ(api().destroy_denoiser(first), WALR_SUCCESS);
}

// Every guide is made once, and every other pass once for each light.
TEST_F(TwoLights, HavePassesOfTheirOwnBehindTheGuides) {
  WalrDenoiserInfo both = info("walr", kSize);
  both.light_count = 2;
  const WalrPasses passes = makePasses(both);
  const WalrPassList* list = nullptr;
  require(api().get_pass_list(passes, &list));
  std::map<std::string, int> count;
  for (std::uint32_t i = 0; i < list->pass_count; ++i) ++count[list->passes[i]->name];
  for (const auto& [name, times] : count) EXPECT_EQ(times, 1) << name;
  EXPECT_TRUE(count.contains("guides and accumulation"));
  EXPECT_TRUE(count.contains("second light: temporal accumulation"));
  EXPECT_TRUE(count.contains("temporal anti-aliasing"));
  EXPECT_TRUE(count.contains("second light: temporal anti-aliasing"));
  EXPECT_FALSE(count.contains("second light: prepare guides"));
  EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
}

}  // namespace
}  // namespace plugin_host
