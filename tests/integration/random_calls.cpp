#include "tests/integration/random_calls.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/integration/random_arguments.h"

namespace walr::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kSpirvMagic = 0x07230203;

void ignoreLog(void* /*user*/, WalrLogLevel /*level*/, const char* /*text*/) {}

/// A handle that the library never makes: its handles count up from 1.
template <typename Handle>
Handle wildHandle(Dice& dice) {
  return reinterpret_cast<Handle>((std::uintptr_t{1} << 40) + dice.below(1000));
}

}  // namespace

RandomCalls::RandomCalls(std::uint64_t seed, const Host& host) : dice_(seed), host_(host) {
  for (std::uint32_t i = 0; i < walr_pass_type_count(); ++i) {
    types_.push_back(walr_pass_type(i));
    if (types_.back()->method != 0) methods_.push_back(types_.back());
  }
}

RandomCalls::~RandomCalls() {
  for (const ModelledPasses& passes : passes_.live) walr_destroy_passes(passes.handle);
  for (const ModelledDenoiser& denoiser : denoisers_.live) walr_destroy_denoiser(denoiser.handle);
}

void RandomCalls::run(std::uint32_t calls) {
  for (std::uint32_t i = 0; i < calls; ++i) call();
}

template <typename Handle, typename Model>
RandomCalls::Picked<Handle, Model> RandomCalls::pick(Pool<Handle, Model>& pool, std::span<const Handle> shared,
                                                     Expectation& expected) {
  if (!shared.empty() && dice_.oneIn(2)) {
    expected.isShared();
    return {shared[dice_.below(shared.size())], nullptr};
  }
  if (!pool.live.empty() && !dice_.oneIn(6)) {
    Model& model = pool.live[dice_.below(pool.live.size())];
    return {model.handle, &model};
  }
  expected.fails(WALR_ERROR_INVALID_HANDLE);
  if (!pool.dead.empty() && !dice_.oneIn(3)) return {pool.dead[dice_.below(pool.dead.size())], nullptr};
  return {dice_.oneIn(2) ? nullptr : wildHandle<Handle>(dice_), nullptr};
}

void RandomCalls::call() {
  // Without a device there are only passes.
  if (dice_.oneIn(host_.device != nullptr ? 2 : 8)) {
    callDenoiser();
  } else {
    callPasses();
  }
}

void RandomCalls::callPasses() {
  if (passes_.live.empty() && !dice_.oneIn(4)) return createPasses();
  switch (dice_.below(14)) {
    case 0:
      return dice_.oneIn(4) ? createPasses() : listPasses();
    case 1:
      return destroyPasses();
    case 2:
    case 3:
      return listPasses();
    case 4:
    case 5:
      return continuePasses();
    case 6:
    case 7:
    case 8:
      return beginFrame();
    case 9:
    case 10:
      return frameConstants();
    case 11:
      return recordPass();
    default:
      return passResults();
  }
}

void RandomCalls::createPasses() {
  Expectation expected;
  Grown<WalrPassesInfo> info;
  chooseSize(dice_, expected, info);
  const RandomInfo denoiser(dice_, expected, types_, host_.device);
  info.value.denoiser = denoiser.get();
  if (dice_.oneIn(24)) {
    info.value.denoiser = nullptr;
    expected.fails();
  }
  std::string text[2];
  WalrSettingValue settings[2];
  for (std::uint32_t i = 0; i < 2; ++i) {
    if (!dice_.oneIn(4)) break;
    settings[i] = randomSetting(dice_, expected, denoiser.type(), text[i]);
    info.value.setting_count = i + 1;
  }
  info.value.settings = settings;
  const WalrPortFormat port = {
      dice_.of({static_cast<const char*>(nullptr), "magic", "lighting", "depth", "accumulated"}),
      VK_FORMAT_R16G16B16A16_SFLOAT, 0};
  if (dice_.oneIn(12)) {
    info.value.ports = dice_.oneIn(3) ? nullptr : &port;
    info.value.port_count = 1;
    expected.mayFail();
    if (info.value.ports == nullptr || port.port == nullptr) expected.fails();
  }
  WalrPasses made = wildHandle<WalrPasses>(dice_);
  const bool withoutResult = dice_.oneIn(40);
  if (withoutResult) expected.fails();
  const WalrResult result =
      check_("walr_create_passes", expected,
             {"WalrPassesInfo", "WalrDenoiserInfo", "WalrDevice", "WalrConventions", "WalrSettingValue",
              "WalrPortFormat", "setting", "preset", "method", "pass type", "port", "image size", "input", "stage",
              "the result's address", "regression", "svgf."},
             [&] { return walr_create_passes(&info.value, withoutResult ? nullptr : &made); });
  if (result != WALR_SUCCESS) {
    if (!withoutResult && made != nullptr) check_.fault("a failed walr_create_passes left a handle");
    return;
  }
  ModelledPasses model{.handle = made,
                       .method = denoiser.get()->method,
                       .width = denoiser.get()->width,
                       .height = denoiser.get()->height,
                       .rectangle = denoiser.rectangle(),
                       .lint = denoiser.get()->lint != 0 && host_.device != nullptr};
  passes_.live.push_back(std::move(model));
}

void RandomCalls::destroyPasses() {
  Expectation expected;
  const PickedPasses picked = pickPasses(expected);
  const WalrResult result =
      check_("walr_destroy_passes", expected, {"WalrPasses"}, [&] { return walr_destroy_passes(picked.handle); });
  if (result != WALR_SUCCESS || picked.model == nullptr) return;
  passes_.dead.push_back(picked.handle);
  passes_.live.erase(passes_.live.begin() + (picked.model - passes_.live.data()));
}

void RandomCalls::listPasses() {
  Expectation expected;
  const PickedPasses picked = pickPasses(expected);
  const WalrPassList* list = nullptr;
  const bool withoutResult = dice_.oneIn(24);
  if (withoutResult) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  check_("walr_get_pass_list", expected, {"WalrPasses", "the list's address"},
         [&] { return walr_get_pass_list(picked.handle, withoutResult ? nullptr : &list); });
  if (picked.model == nullptr || list == nullptr) return;
  if (picked.model->list != nullptr && picked.model->list != list) check_.fault("the pass list has moved");
  picked.model->list = list;
  inspect(*list);
}

/// Reads all that a list points to.
void RandomCalls::inspect(const WalrPassList& list) {
  bool sound = list.struct_size == sizeof(WalrPassList) && list.pass_count > 0;
  for (std::uint32_t i = 0; i < list.resource_count; ++i) sound = sound && list.resources[i]->name[0] != '\0';
  for (std::uint32_t i = 0; i < list.pass_count; ++i) {
    const WalrDispatch& pass = *list.passes[i];
    sound = sound && pass.spirv[0] == kSpirvMagic && pass.name[0] != '\0';
    for (std::uint32_t b = 0; b < pass.binding_count; ++b) {
      sound = sound && pass.bindings[b]->resource < list.resource_count && pass.bindings[b]->name[0] != '\0';
    }
    for (std::uint32_t b = 0; b < pass.barrier_count; ++b) {
      sound = sound && pass.barriers[b].resource < list.resource_count;
    }
    for (std::uint32_t a = 0; a < pass.history_age_count; ++a) {
      sound = sound && pass.history_ages[a].offset + sizeof(std::uint32_t) <= pass.push_constant_size;
    }
  }
  for (std::uint32_t i = 0; i < list.port_count; ++i) sound = sound && list.ports[i].resource < list.resource_count;
  if (!sound) check_.fault("the pass list is not sound");
}

void RandomCalls::continuePasses() {
  Expectation expected;
  Expectation lastExpected;
  const PickedPasses picked = pickPasses(expected);
  const PickedPasses last = pickPasses(lastExpected);
  if (picked.handle == last.handle) {
    expected.fails(WALR_ERROR_INVALID_ARGUMENT);
  } else if (last.model == nullptr) {
    if (picked.model != nullptr || host_.shared.empty()) expected.fails(WALR_ERROR_INVALID_HANDLE);
    if (!host_.shared.empty()) expected.isShared();
  } else if (picked.model != nullptr) {
    const ModelledPasses& a = *picked.model;
    const ModelledPasses& b = *last.model;
    const bool sameSize = a.width == b.width && a.height == b.height;
    if (a.method != b.method || (!sameSize && !(a.rectangle && b.rectangle)))
      expected.fails(WALR_ERROR_INVALID_ARGUMENT);
    if (!b.hadFrame) expected.fails(WALR_ERROR_WRONG_ORDER);
  }
  const WalrResult result = check_("walr_continue_passes", expected, {"WalrPasses", "passes"},
                                   [&] { return walr_continue_passes(picked.handle, last.handle); });
  if (result != WALR_SUCCESS || picked.model == nullptr) return;
  picked.model->begun = false;
  picked.model->hadFrame = true;
}

void RandomCalls::beginFrame() {
  Expectation expected;
  const PickedPasses picked = pickPasses(expected);
  Grown<WalrPassFrame> frame;
  chooseSize(dice_, expected, frame);
  if (dice_.oneIn(24)) {
    frame.value.flags = dice_.of({1U, 0x80U, 0xffffffffU});
    expected.fails();
  }
  WalrCamera camera;
  WalrCamera previous;
  frame.value.camera = randomCamera(dice_, expected, camera);
  // A missing previous camera is the one of the frame before.
  Expectation ofPrevious;
  if (dice_.oneIn(3) && randomCamera(dice_, ofPrevious, previous) != nullptr) {
    frame.value.previous_camera = &previous;
    if (!ofPrevious.allows(WALR_SUCCESS)) expected.fails();
    expected.mayFail();
  }
  if (picked.model != nullptr && picked.model->hadFrame) expected.mayFail();  // With the camera of the frame before.
  frame.value.sky_depth = dice_.of({0.0F, 100.0F});
  frame.value.pre_exposure = dice_.of({0.0F, 1.0F, 0.5F});
  if (dice_.oneIn(16)) {
    frame.value.sky_depth = dice_.of({-1.0F, kNan});
    expected.fails();
  }
  if (dice_.oneIn(16)) {
    frame.value.pre_exposure = dice_.of({-1.0F, kNan, INFINITY});
    expected.fails();
  }
  if (dice_.oneIn(16)) {
    frame.value.offset[dice_.below(2)] = dice_.of({1U, 16385U, 0xffffffffU});
    expected.mayFail();
  }
  const WalrResult result = check_(
      "walr_begin_frame", expected,
      {"WalrPasses", "WalrPassFrame", "WalrFrame", "WalrCamera", "camera", "matrix", "sky_depth", "exposure", "offset"},
      [&] { return walr_begin_frame(picked.handle, &frame.value); });
  if (result != WALR_SUCCESS || picked.model == nullptr) return;
  picked.model->begun = true;
  picked.model->hadFrame = true;
}

void RandomCalls::frameConstants() {
  Expectation expected;
  const PickedPasses picked = pickPasses(expected);
  std::uint32_t resource = dice_.of({0U, 1U, 1000U, WALR_NONE});
  if (picked.model != nullptr) {
    if (!picked.model->begun) expected.fails(WALR_ERROR_WRONG_ORDER);
    const WalrPassList* const list = picked.model->list;
    if (list != nullptr && !dice_.oneIn(8)) resource = dice_.below(list->resource_count);
    const bool known = list != nullptr && resource < list->resource_count;
    if (known && list->resources[resource]->kind != WALR_RESOURCE_UPLOAD) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
    if (!known) expected.mayFail();
  }
  std::array<std::byte, 1024> bytes{};
  std::size_t size = dice_.of({std::size_t{0}, std::size_t{3}, bytes.size()});
  const bool withoutRoom = dice_.oneIn(4);
  const bool withoutSize = dice_.oneIn(16);
  if (withoutSize || (size < 4 && !withoutRoom)) expected.fails();
  check_("walr_get_frame_constants", expected,
         {"WalrPasses", "walr_begin_frame", "resource", "the size's address", "bytes"}, [&] {
           return walr_get_frame_constants(picked.handle, resource, withoutRoom ? nullptr : bytes.data(),
                                           withoutSize ? nullptr : &size);
         });
}

/// Always in vain: a pass needs a command buffer.
void RandomCalls::recordPass() {
  Expectation expected;
  const PickedPasses picked = pickPasses(expected);
  expected.fails();
  const WalrPassResource resources[2] = {};
  const bool withoutResources = dice_.oneIn(4);
  check_("walr_record_pass", expected,
         {"WalrPasses", "without a device", "walr_begin_frame", "command buffer", "the array of resources", "pass "},
         [&] {
           return walr_record_pass(picked.handle, dice_.of({0U, 1U, 99U}), VK_NULL_HANDLE,
                                   withoutResources ? nullptr : resources, dice_.below(3));
         });
}

void RandomCalls::passResults() {
  Expectation expected;
  const PickedPasses picked = pickPasses(expected);
  const bool withoutCount = dice_.oneIn(8);
  std::uint32_t count = dice_.below(4);
  switch (dice_.below(3)) {
    case 0: {
      std::array<WalrPassTime, 4> times{};
      if (withoutCount) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
      check_("walr_get_pass_timings", expected, {"WalrPasses", "the count's address"}, [&] {
        return walr_get_pass_timings(picked.handle, withoutCount ? nullptr : &count,
                                     dice_.oneIn(2) ? nullptr : times.data());
      });
      return;
    }
    case 1: {
      std::array<WalrFinding, 4> findings{};
      if (picked.model != nullptr && !picked.model->lint) expected.fails(WALR_ERROR_WRONG_ORDER);
      if (withoutCount) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
      check_("walr_get_pass_findings", expected, {"WalrPasses", "WalrDenoiserInfo::lint", "the count's address"},
             [&] { return walr_get_pass_findings(picked.handle, withoutCount ? nullptr : &count, findings.data()); });
      return;
    }
    default: {
      const auto image =
          dice_.oneIn(4) ? VK_NULL_HANDLE : reinterpret_cast<VkImage>(std::uintptr_t{64} * dice_.below(9));
      if (image == VK_NULL_HANDLE) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
      check_("walr_forget_pass_image", expected, {"WalrPasses", "the image is null"},
             [&] { return walr_forget_pass_image(picked.handle, image, dice_.below(3)); });
    }
  }
}

void RandomCalls::callDenoiser() {
  const bool possible = host_.device != nullptr;
  if (denoisers_.live.empty() && (possible ? !dice_.oneIn(4) : dice_.oneIn(8))) return createDenoiser();
  switch (dice_.below(possible ? 18 : 12)) {
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
    default:
      return record();
  }
}

void RandomCalls::createDenoiser() {
  Expectation expected;
  RandomInfo info(dice_, expected, methods_, host_.device);
  if (host_.device == nullptr) expected.fails();
  WalrDenoiserInfo logging = *info.get();
  const bool logs = logging.struct_size == sizeof(logging);
  if (logs) logging.log = ignoreLog;
  WalrDenoiser made = wildHandle<WalrDenoiser>(dice_);
  const WalrResult result =
      check_("walr_create_denoiser", expected,
             {"WalrDenoiserInfo", "WalrDevice", "WalrConventions", "method", "preset", "image size", "input"},
             [&] { return walr_create_denoiser(logs ? &logging : info.get(), &made); });
  if (result != WALR_SUCCESS) {
    if (made != nullptr) check_.fault("a failed walr_create_denoiser left a handle");
    return;
  }
  denoisers_.live.push_back({.handle = made, .type = info.type(), .lint = info.get()->lint != 0});
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
  const WalrSettingValue setting =
      randomSetting(dice_, expected, picked.model != nullptr ? picked.model->type : nullptr, storage);
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
  check_("walr_use_preset", expected, {"WalrDenoiser", "preset"}, [&] { return walr_use_preset(picked.handle, name); });
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
  const char* const port = dice_.of({"lighting", "depth", "normal", "motion", "albedo", "object_id", "confidence",
                                     "history_length", "denoised", "magic", "", static_cast<const char*>(nullptr)});
  if (port == nullptr || *port == '\0' || std::strcmp(port, "magic") == 0) expected.fails();
  if (picked.model != nullptr && picked.model->changed) expected.mayFail();
  if (dice_.oneIn(2)) {
    check_("walr_get_image_requirements", expected,
           {"WalrDenoiser", "WalrImageRequirements", "the image's name", "image \"", "setting", "regression", "svgf."},
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
  check_("walr_prepare", expected, {"WalrDenoiser", "setting", "regression", "svgf."},
         [&] { return walr_prepare(picked.handle); });
}

}  // namespace walr::test
