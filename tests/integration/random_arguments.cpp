#include "tests/integration/random_arguments.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace walr::test {
namespace {

constexpr WalrCamera kCamera = {.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                .projection = {1.5F, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.1F, 0},
                                .jitter = {0, 0}};
constexpr float kParallelProjection[16] = {0.5F, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0, -0.01F, 0, 0, 0, 0, 1};

/// Address that checkLog expects.
const int logUser = 0;

/// Receives the library's messages, and ends the program if they do not come as promised.
void checkLog(void* user, WalrLogLevel level, const char* text) {
  const bool known = level == WALR_LOG_INFO || level == WALR_LOG_WARNING || level == WALR_LOG_ERROR;
  if (user != &logUser || !known || text == nullptr || *text == '\0') std::abort();
}

/// A value of an enumeration, seldom one that it does not have.
template <typename Enum>
Enum choose(Dice& dice, Expectation& expected, Enum last) {
  const auto count = static_cast<std::uint32_t>(last) + 1;
  if (!dice.oneIn(60)) return static_cast<Enum>(dice.below(count));
  expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  return static_cast<Enum>(count + dice.below(1000));
}

/// On with a probability of one in `n`, seldom neither on nor off.
VkBool32 chooseSwitch(Dice& dice, Expectation& expected, std::uint32_t n) {
  if (!dice.oneIn(300)) return dice.oneIn(n) ? VK_TRUE : VK_FALSE;
  expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  return dice.of({2U, 0xffffffffU, 0x100U});
}

std::string validValue(Dice& dice, Expectation& expected, const WalrSetting& setting) {
  if (dice.oneIn(2)) return setting.default_value;
  expected.mayFail();  // Some settings exclude each other.
  if (setting.choice_count > 0) return setting.choices[dice.below(setting.choice_count)];
  const double value = setting.least + (setting.most - setting.least) * dice.below(101) / 100.0;
  return setting.kind == WALR_SETTING_INTEGER ? std::to_string(std::llround(value)) : std::to_string(value);
}

}  // namespace

RandomInfo::RandomInfo(Dice& dice, Expectation& expected, const std::vector<const WalrPassType*>& types,
                       const RandomHost& host) {
  chooseSize(dice, expected, info_);
  chooseMethod(dice, expected, types);
  chooseImages(dice, expected);
  chooseConventions(dice, expected);
  chooseOutputs(dice, expected);
  if (dice.oneIn(16)) chooseLights(dice, expected);
  chooseDevice(dice, expected, host);
}

void RandomInfo::chooseOutputs(Dice& dice, Expectation& expected) {
  info_.value.timestamps = chooseSwitch(dice, expected, 2);
  if (dice.oneIn(2)) {
    info_.value.log = checkLog;
    info_.value.log_user = const_cast<int*>(&logUser);
  }
  // A stage has no such outputs, and some methods have no history length.
  for (VkBool32* const wanted : {&info_.value.lint, &info_.value.counters, &info_.value.history_length}) {
    *wanted = chooseSwitch(dice, expected, 8);
    if (*wanted == VK_TRUE) expected.mayFail();
  }
  if (dice.oneIn(50)) {  // Most methods refuse them.
    info_.value.light_direction = info_.value.expected_error = VK_TRUE;
    expected.mayFail();
  }
  if (!dice.oneIn(6)) return;
  info_.value.denoised_format = dice.of({VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_B10G11R11_UFLOAT_PACK32,
                                         VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM});
  expected.mayFail();
  if (info_.value.denoised_format == VK_FORMAT_R8G8B8A8_UNORM) expected.fails();
}

/// Some of either kind; only methods that take specular light accept it.
void RandomInfo::chooseKinds(Dice& dice, Expectation& expected) {
  WalrDenoiserInfo& info = info_.value;
  info.light_kind = choose(dice, expected, WALR_LIGHT_SPECULAR);
  if (info.light_count == 2 || dice.oneIn(8)) info.second_light_kind = choose(dice, expected, WALR_LIGHT_SPECULAR);
  if (info.light_count != 2 && info.second_light_kind != WALR_LIGHT_DIFFUSE) expected.fails();
  const bool specular = info.light_kind == WALR_LIGHT_SPECULAR || info.second_light_kind == WALR_LIGHT_SPECULAR;
  if (specular) expected.mayFail();
  if (!dice.oneIn(4)) return;
  info.roughness_format = dice.of({VK_FORMAT_R8_UNORM, VK_FORMAT_R16_SFLOAT, VK_FORMAT_R32_UINT});
  if (!specular || info.roughness_format == VK_FORMAT_R32_UINT) expected.fails();
  info.specular_motion_format = dice.of({VK_FORMAT_UNDEFINED, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R16G16_SFLOAT});
  if (info.specular_motion_format == VK_FORMAT_R16G16_SFLOAT) expected.fails();
}

/// After the method: stages and methods without guides have one light.
void RandomInfo::chooseLights(Dice& dice, Expectation& expected) {
  info_.value.light_count = dice.of({1U, 2U, 2U, 2U, 3U});
  const bool two = info_.value.light_count == 2;
  if (dice.oneIn(4)) chooseKinds(dice, expected);
  const bool stage = type_ != nullptr && type_->method == VK_FALSE;
  const bool shares = type_ == nullptr || std::strcmp(type_->name, "none") != 0 || ofTwoKinds();
  if (info_.value.light_count > 2 || (two && (stage || !shares))) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  if (two) expected.mayFail();  // Presets may need other guides.
  if (!dice.oneIn(3)) return;
  const bool right = type_ != nullptr && type_->preset_count > 0 && !dice.oneIn(4);
  info_.value.second_preset = right ? type_->presets[dice.below(type_->preset_count)] : "magic";
  if (!right || !two) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
}

void RandomInfo::chooseMethod(Dice& dice, Expectation& expected, const std::vector<const WalrPassType*>& types) {
  static const std::string kLong(5000, 'm');
  if (dice.oneIn(12)) {
    info_.value.method = dice.of({"", "magic", "WALR", kLong.c_str()});
    expected.fails();
    return;
  }
  type_ = types[dice.below(types.size())];
  info_.value.method = type_->name;
  if (dice.oneIn(12)) {
    info_.value.preset = dice.of({"", "magic", kLong.c_str()});
    expected.fails();
  } else if (type_->preset_count > 0 && dice.oneIn(4)) {
    info_.value.preset = type_->presets[dice.below(type_->preset_count)];
    expected.mayFail();  // A setting's usual value may be at odds with the preset.
  }
}

void RandomInfo::chooseImages(Dice& dice, Expectation& expected) {
  info_.value.width = randomLength(dice, expected);
  info_.value.height = randomLength(dice, expected);
  info_.value.frames_in_flight = dice.below(17);
  if (dice.oneIn(24)) {
    info_.value.frames_in_flight = dice.of({17U, 0xffffffffU});
    expected.fails();
  }
  if (!dice.oneIn(6)) return;
  expected.mayFail();
  VkFormat* const formats[] = {&info_.value.lighting_format,  &info_.value.depth_format,  &info_.value.normal_format,
                               &info_.value.motion_format,    &info_.value.albedo_format, &info_.value.object_id_format,
                               &info_.value.confidence_format};
  *formats[dice.below(7)] = dice.of({VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32_UINT,
                                     VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_BC7_SRGB_BLOCK, VK_FORMAT_R16_UINT,
                                     VK_FORMAT_G8_B8R8_2PLANE_420_UNORM, static_cast<VkFormat>(123456)});
}

void RandomInfo::chooseConventions(Dice& dice, Expectation& expected) {
  if (dice.oneIn(2)) return;
  WalrConventions& conventions = conventions_.value;
  info_.value.conventions = &conventions;
  chooseSize(dice, expected, conventions_);
  expected.mayFail();  // Stages take the images as they are.
  conventions.normal_space = choose(dice, expected, WALR_SPACE_WORLD);
  conventions.motion_unit = choose(dice, expected, WALR_MOTION_PICTURES);
  conventions.motion_depth = choose(dice, expected, WALR_MOTION_DEPTH_FOUND);
  conventions.depth = choose(dice, expected, WALR_DEPTH_DEVICE);
  conventions.normals = choose(dice, expected, WALR_NORMALS_OCTAHEDRAL_UNSIGNED);
  conventions.pre_exposed = chooseSwitch(dice, expected, 2);
  conventions.motion_jittered = chooseSwitch(dice, expected, 2);
  conventions.rectangle = chooseSwitch(dice, expected, 3);
  conventions.orthographic = chooseSwitch(dice, expected, 4);
  for (float& scale : conventions.motion_scale) scale = dice.of({0.0F, 1.0F, -1.0F, 0.5F});
  if (!dice.oneIn(24)) return;
  conventions.motion_scale[dice.below(2)] = dice.of({kNotANumber, kInfinity});
  expected.fails();
}

void RandomInfo::chooseDevice(Dice& dice, Expectation& expected, const RandomHost& host) {
  if (dice.oneIn(2)) info_.value.pipeline_cache = host.pipelineCache;
  // Passes without a device are only listed.
  if (host.device == nullptr && !dice.oneIn(16)) return;
  device_.emplace(dice, expected, host);
  info_.value.device = device_->get();
}

std::vector<WalrLightKind> RandomInfo::lights() const {
  std::vector<WalrLightKind> kinds{info_.value.light_kind};
  if (info_.value.light_count == 2) kinds.push_back(info_.value.second_light_kind);
  return kinds;
}

std::uint32_t randomLength(Dice& dice, Expectation& expected) {
  if (!dice.oneIn(24)) return dice.of({1U, 2U, 7U, 16U, 33U, 64U});
  expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  return dice.of({0U, 16385U, 0xffffffffU});
}

WalrSettingValue randomSetting(Dice& dice, Expectation& expected, const WalrPassType* type, std::string& storage) {
  if (type == nullptr || type->setting_count == 0 || dice.oneIn(8)) {
    expected.fails(WALR_ERROR_INVALID_ARGUMENT);
    return {dice.of({static_cast<const char*>(nullptr), "", "magic", "walr.filter"}), "1"};
  }
  const WalrSetting& setting = *type->settings[dice.below(type->setting_count)];
  if (dice.oneIn(6)) {
    expected.fails(WALR_ERROR_INVALID_ARGUMENT);
    return {setting.name, dice.of({static_cast<const char*>(nullptr), "", "nan", "1e999", "-1e30", "0x10", "on off"})};
  }
  storage = validValue(dice, expected, setting);
  return {setting.name, storage.c_str()};
}

bool actsOn(const WalrPassType* type, const char* setting, std::span<const WalrLightKind> lights) {
  if (type == nullptr || setting == nullptr || type->method == VK_FALSE) return true;
  for (const WalrSetting* const each : std::span(type->settings, type->setting_count)) {
    if (std::strcmp(each->name, setting) != 0) continue;
    return std::ranges::any_of(lights, [&](WalrLightKind light) {
      return (each->lights & 1U << (light == WALR_LIGHT_SPECULAR ? WALR_LIGHT_SPECULAR : WALR_LIGHT_DIFFUSE)) != 0;
    });
  }
  return true;
}

const WalrCamera* randomCamera(Dice& dice, Expectation& expected, bool orthographic, WalrCamera& storage) {
  if (dice.oneIn(24)) {
    expected.fails(WALR_ERROR_INVALID_ARGUMENT);
    return nullptr;
  }
  storage = kCamera;
  const bool ofOtherKind = dice.oneIn(48);
  if (ofOtherKind) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  if (orthographic != ofOtherKind) std::memcpy(storage.projection, kParallelProjection, sizeof(kParallelProjection));
  storage.jitter[0] = static_cast<float>(dice.below(5)) / 8.0F;
  float* const values = dice.oneIn(2) ? storage.view : storage.projection;
  if (dice.oneIn(24)) {
    float& value = dice.oneIn(4) ? storage.jitter[dice.below(2)] : values[dice.below(16)];
    value = dice.of({kNotANumber, kInfinity});
    expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  } else if (dice.oneIn(12)) {
    values[dice.below(16)] = dice.of({0.0F, -1.0F, 1e30F, 1e-30F});
    expected.mayFail();
  }
  return &storage;
}

}  // namespace walr::test
