// The part of RandomCalls that calls functions of denoisers.
#include <array>
#include <cstring>
#include <string>

#include "tests/integration/random_arguments.h"
#include "tests/integration/random_calls.h"

namespace walr::test {

void RandomCalls::callDenoiser() {
  const bool possible = host_.vulkan.device != nullptr;
  if (denoisers_.live.empty() && (possible ? !dice_.oneIn(4) : dice_.oneIn(8))) return createDenoiser();
  switch (dice_.below(possible ? 22 : 14)) {
    case 0:
      return destroyDenoiser();
    case 1:
    case 2:
      return changeSetting();
    case 3:
      return readSetting();
    case 4:
      return resize();
    case 5:
      return usePreset();
    case 6:
    case 7:
      return requirements();
    case 8:
    case 9:
      return denoiserResults();
    case 10:
      return prepare();
    case 11:
      return denoiserCounts();
    case 12:
      return chooseView();
    case 13:
      return dice_.oneIn(4) ? createDenoiser() : record();
    default:
      return record();
  }
}

void RandomCalls::createDenoiser() {
  Expectation expected;
  RandomHost host = host_.vulkan;
  PickedDenoiser other;
  if (dice_.oneIn(3)) {
    Expectation ofOther;
    other = pickDenoiser(ofOther);
    host.givesRightDevices = true;  // Only its handles are compared with those of the other denoiser.
  }
  RandomInfo info(dice_, expected, methods_, host);
  info.shareWith(other.handle);
  const bool shares = other.model != nullptr;
  if (host.device == nullptr || (other.handle != nullptr && !shares)) expected.fails();
  if (info.hasRightSize() && other.handle != nullptr && !shares) {
    expected = {};  // The handle is looked at before all else.
    expected.fails(WALR_ERROR_INVALID_HANDLE);
  }
  const bool allocates = shares ? other.model->allocates : info.allocates();
  if (allocates) expected.mayRunOutOfMemory();
  WalrDenoiser made = wildHandle<WalrDenoiser>(dice_);
  const WalrResult result =
      check_("walr_create_denoiser", expected, kInfoNames, [&] { return walr_create_denoiser(info.get(), &made); });
  if (result != WALR_SUCCESS) {
    if (made != nullptr) check_.fault("a failed walr_create_denoiser left a handle");
    return;
  }
  denoisers_.live.push_back({.handle = made,
                             .type = info.type(),
                             .lint = info.get()->lint != 0,
                             .counters = info.get()->counters != 0,
                             .rectangle = info.rectangle(),
                             .orthographic = info.orthographic(),
                             .lights = info.lights(),
                             .allocates = allocates,
                             // Settings without history have no history length, most methods no light direction and
                             // no expected error, and presets of two lights may need other guides.
                             .changed = info.get()->history_length != 0 || info.get()->light_direction != 0 ||
                                        info.get()->expected_error != 0 || info.get()->second_preset != nullptr});
}

void RandomCalls::destroyDenoiser() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  const WalrResult result =
      check_("walr_destroy_denoiser", expected, {"WalrDenoiser"}, [&] { return walr_destroy_denoiser(picked.handle); });
  if (result != WALR_SUCCESS) return;
  denoisers_.dead.push_back(picked.handle);
  denoisers_.live.erase(denoisers_.live.begin() + (picked.model - denoisers_.live.data()));
}

std::string RandomCalls::settingOf(WalrDenoiser denoiser, const char* name) {
  std::array<char, 256> text{};
  std::size_t size = text.size();
  return walr_get_setting(denoiser, name, text.data(), &size) == WALR_SUCCESS ? text.data() : "";
}

void RandomCalls::changeSetting() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  std::string storage;
  WalrSettingValue setting =
      randomSetting(dice_, expected, picked.model != nullptr ? picked.model->type : nullptr, storage);
  std::string ofSecond;
  if (setting.name != nullptr && picked.model != nullptr) {
    std::span<const WalrLightKind> lights(picked.model->lights);
    const std::string name = setting.name;
    if (dice_.oneIn(4)) {
      ofSecond = "second." + name;
      setting.name = ofSecond.c_str();
      if (lights.size() < 2) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
      lights = lights.last(1);
    }
    if (!actsOn(picked.model->type, name.c_str(), lights)) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  }
  const bool known = picked.model != nullptr && setting.name != nullptr;
  const std::string before = known ? settingOf(picked.handle, setting.name) : "";
  const WalrResult result = check_("walr_set_setting", expected, {"WalrDenoiser", "setting"},
                                   [&] { return walr_set_setting(picked.handle, setting.name, setting.value); });
  if (!known) return;
  if (result == WALR_SUCCESS) {
    picked.model->changed = true;
  } else if (settingOf(picked.handle, setting.name) != before) {
    check_.fault("a refused value has changed the setting");
  }
}

void RandomCalls::readSetting() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  std::string storage;
  const char* name = dice_.of({static_cast<const char*>(nullptr), "", "magic"});
  const bool known = picked.model != nullptr && picked.model->type->setting_count > 0 && !dice_.oneIn(4);
  if (known) name = picked.model->type->settings[dice_.below(picked.model->type->setting_count)]->name;
  if (!known) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  std::array<char, 64> text{};
  std::size_t size = dice_.of({std::size_t{0}, text.size()});
  const bool withoutRoom = dice_.oneIn(3);
  if (size == 0 && !withoutRoom) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  check_("walr_get_setting", expected, {"WalrDenoiser", "setting", "bytes"},
         [&] { return walr_get_setting(picked.handle, name, withoutRoom ? nullptr : text.data(), &size); });
}

void RandomCalls::resize() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  const std::uint32_t width = randomLength(dice_, expected);
  const std::uint32_t height = randomLength(dice_, expected);
  check_("walr_resize", expected, {"WalrDenoiser", "image size"},
         [&] { return walr_resize(picked.handle, width, height); });
}

void RandomCalls::usePreset() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  const char* name = dice_.of({static_cast<const char*>(nullptr), "", "magic"});
  if (picked.model != nullptr && picked.model->type->preset_count > 0 && !dice_.oneIn(4)) {
    name = picked.model->type->presets[dice_.below(picked.model->type->preset_count)];
  } else {
    expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  }
  const WalrResult result = check_("walr_use_preset", expected, {"WalrDenoiser", "preset"},
                                   [&] { return walr_use_preset(picked.handle, name); });
  if (result == WALR_SUCCESS && picked.model != nullptr) picked.model->changed = true;
}

void RandomCalls::requirements() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  Grown<WalrImageRequirements> needs;
  needs.value.struct_size = sizeof(needs.value);
  if (dice_.oneIn(8)) {
    needs.value.struct_size = dice_.of({0U, 4U, 1U << 20});
    expected.fails();
  }
  const char* const port =
      dice_.of({"lighting", "depth", "normal", "motion", "albedo", "object_id", "confidence", "history_length",
                "light_direction", "expected_error", "second_lighting", "second_denoised", "roughness", "denoised",
                "specular_motion", "view", "magic", "", static_cast<const char*>(nullptr)});
  if (port == nullptr || *port == '\0' || std::strcmp(port, "magic") == 0) expected.fails();
  if (picked.model != nullptr && picked.model->changed) expected.mayFail();
  if (dice_.oneIn(2)) {
    check_("walr_get_image_requirements", expected,
           {"WalrDenoiser", "WalrImageRequirements", "the image's name", "image \"", "setting", "view", "regression",
            "specular light", "svgf."},
           [&] { return walr_get_image_requirements(picked.handle, port, &needs.value); });
    return;
  }
  Expectation ofState;
  if (picked.model == nullptr) ofState.fails(WALR_ERROR_INVALID_HANDLE);
  ofState.mayFail();  // Only a frame that was recorded leaves images in a state.
  WalrImageState state{};
  const bool withoutResult = dice_.oneIn(8);
  if (withoutResult || port == nullptr || *port == '\0') ofState.fails();
  check_("walr_get_release_state", ofState, {"WalrDenoiser", "the state's address", "the image's name", "image"},
         [&] { return walr_get_release_state(picked.handle, port, withoutResult ? nullptr : &state); });
}

void RandomCalls::denoiserResults() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  const bool withoutCount = dice_.oneIn(8);
  std::uint32_t count = dice_.below(4);
  switch (dice_.below(5)) {
    case 0: {
      std::array<WalrPassTime, 4> times{};
      if (withoutCount) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
      check_("walr_get_timings", expected, {"WalrDenoiser", "the count's address"},
             [&] { return walr_get_timings(picked.handle, withoutCount ? nullptr : &count, times.data()); });
      return;
    }
    case 1: {
      std::array<WalrFinding, 4> findings{};
      if (picked.model != nullptr && !picked.model->lint) expected.fails(WALR_ERROR_WRONG_ORDER);
      if (withoutCount) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
      check_("walr_get_findings", expected, {"WalrDenoiser", "WalrDenoiserInfo::lint", "the count's address"},
             [&] { return walr_get_findings(picked.handle, withoutCount ? nullptr : &count, findings.data()); });
      return;
    }
    case 2: {
      Grown<WalrMemory> memory;
      memory.value.struct_size = dice_.oneIn(4) ? dice_.of({0U, 8U, 1U << 20}) : sizeof(memory.value);
      if (memory.value.struct_size != sizeof(memory.value)) expected.fails();
      expected.mayFail();  // Nothing may be allocated yet.
      check_("walr_get_memory", expected, {"WalrDenoiser", "WalrMemory", "walr_prepare"},
             [&] { return walr_get_memory(picked.handle, &memory.value); });
      return;
    }
    case 3: {
      const auto image =
          dice_.oneIn(4) ? VK_NULL_HANDLE : reinterpret_cast<VkImage>(std::uintptr_t{64} * dice_.below(9));
      if (image == VK_NULL_HANDLE) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
      check_("walr_forget_image", expected, {"WalrDenoiser", "the image is null"},
             [&] { return walr_forget_image(picked.handle, image, 1'000'000 + dice_.below(3)); });
      return;
    }
    default:
      check_("walr_reset_history", expected, {"WalrDenoiser"}, [&] { return walr_reset_history(picked.handle); });
  }
}

void RandomCalls::denoiserCounts() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  std::array<WalrCounter, 4> counters{};
  std::uint32_t count = dice_.below(5);
  const bool withoutCount = dice_.oneIn(8);
  const bool withoutRoom = dice_.oneIn(4);
  const bool counts = picked.model != nullptr && (picked.model->lint || picked.model->counters);
  if (picked.model != nullptr && !counts) expected.fails(WALR_ERROR_WRONG_ORDER);
  if (withoutCount) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  check_("walr_get_counters", expected, {"WalrDenoiser", "WalrDenoiserInfo::counters", "the count's address"}, [&] {
    return walr_get_counters(picked.handle, withoutCount ? nullptr : &count, withoutRoom ? nullptr : counters.data());
  });
}

void RandomCalls::chooseView() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  std::array<WalrView, 64> views{};
  auto count = static_cast<std::uint32_t>(views.size());
  const bool withoutCount = dice_.oneIn(8);
  if (withoutCount) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  if (picked.model != nullptr && picked.model->changed) expected.mayFail();
  check_("walr_get_views", expected,
         {"WalrDenoiser", "the count's address", "setting", "regression", "specular light", "svgf."},
         [&] { return walr_get_views(picked.handle, withoutCount ? nullptr : &count, views.data()); });
  if (withoutCount) return;

  Expectation ofChoice;
  if (picked.model == nullptr) ofChoice.fails(WALR_ERROR_INVALID_HANDLE);
  std::string name = dice_.of({"", "magic", "accumulated.-1", "accumulated.99999999999999999999", "."});
  const bool none = dice_.oneIn(4);
  if (!none && picked.model != nullptr && count > 0 && count <= views.size() && !dice_.oneIn(3)) {
    name = views[dice_.below(count)].name;
    if (dice_.oneIn(4)) {
      name += dice_.of({".0", ".1"});
      ofChoice.mayFail();
    }
    if (picked.model->changed) ofChoice.mayFail();
  } else if (!none) {
    ofChoice.fails(WALR_ERROR_INVALID_ARGUMENT);
  }
  const WalrResult result =
      check_("walr_set_view", ofChoice, {"WalrDenoiser", "view", "setting", "regression", "specular light", "svgf."},
             [&] { return walr_set_view(picked.handle, none ? nullptr : name.c_str()); });
  if (result == WALR_SUCCESS && picked.model != nullptr) picked.model->changed = true;
}

void RandomCalls::record() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  if (host_.recorder != nullptr && picked.model != nullptr) {
    host_.recorder->record(dice_, check_, *picked.model);
    return;
  }
  WalrFrame frame{};
  frame.struct_size = sizeof(frame);
  expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  check_("walr_record", expected, {"WalrDenoiser", "command buffer"},
         [&] { return walr_record(picked.handle, VK_NULL_HANDLE, &frame); });
}

void RandomCalls::prepare() {
  Expectation expected;
  const PickedDenoiser picked = pickDenoiser(expected);
  // Pipelines take long, so only sequences that record frames prepare denoisers.
  if (picked.model != nullptr && host_.recorder == nullptr) return;
  if (picked.model != nullptr && picked.model->changed) expected.mayFail();
  if (picked.model != nullptr && picked.model->allocates) expected.mayRunOutOfMemory();
  check_("walr_prepare", expected,
         {"WalrDenoiser", "WalrMemory", "setting", "view", "regression", "specular light", "svgf."},
         [&] { return walr_prepare(picked.handle); });
}

}  // namespace walr::test
