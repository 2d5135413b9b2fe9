// The part of RandomCalls that calls functions of passes.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tests/integration/random_arguments.h"
#include "tests/integration/random_calls.h"

namespace walr::test {
namespace {

constexpr std::uint32_t kSpirvMagic = 0x07230203;

}  // namespace

void RandomCalls::callPasses() {
  if (passes_.live.empty() && !dice_.oneIn(4)) return createPasses();
  switch (dice_.below(14)) {
    case 0:
      return dice_.oneIn(2) ? createPasses() : listPasses();
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
  const RandomInfo denoiser(dice_, expected, types_, host_.vulkan);
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
    if (!actsOn(denoiser.type(), settings[i].name, denoiser.lights())) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
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
  const WalrResult result = check_("walr_create_passes", expected, {"WalrPassesInfo",  "WalrDenoiserInfo",
                                                                    "WalrDevice",      "WalrMemory",
                                                                    "WalrConventions", "WalrSettingValue",
                                                                    "WalrPortFormat",  "setting",
                                                                    "preset",          "method",
                                                                    "pass type",       "port",
                                                                    "image size",      "input",
                                                                    "stage",           "the result's address",
                                                                    "orthographic",    "queue famil",
                                                                    "created without", "regression",
                                                                    "specular light",  "svgf."},
                                   [&] { return walr_create_passes(&info.value, withoutResult ? nullptr : &made); });
  if (result != WALR_SUCCESS) {
    if (!withoutResult && made != nullptr) check_.fault("a failed walr_create_passes left a handle");
    return;
  }
  ModelledPasses model{.handle = made,
                       .method = denoiser.get()->method,
                       .width = denoiser.get()->width,
                       .height = denoiser.get()->height,
                       .lights = denoiser.lights(),
                       .rectangle = denoiser.rectangle(),
                       .orthographic = denoiser.orthographic(),
                       .lint = denoiser.get()->lint != 0 && host_.vulkan.device != nullptr,
                       .counters = denoiser.get()->counters != 0 && host_.vulkan.device != nullptr,
                       .recordable = host_.vulkan.device != nullptr,
                       .allocates = denoiser.allocates()};
  if (dice_.oneIn(2)) walr_get_pass_list(made, &model.list);
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
    const std::size_t common = std::min(a.lights.size(), b.lights.size());
    const bool sameLights = std::equal(a.lights.begin(), a.lights.begin() + std::ptrdiff_t(common), b.lights.begin());
    if (a.method != b.method || !sameLights || (!sameSize && !(a.rectangle && b.rectangle)))
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
  frame.value.flags = dice_.oneIn(4) ? static_cast<std::uint32_t>(WALR_FRAME_INDEX_GIVEN) : 0U;
  if (dice_.oneIn(24)) {
    frame.value.flags = WALR_FRAME_RESET_HISTORY;  // Pass by pass, the host drops histories.
    expected.fails();
  }
  if (dice_.oneIn(16)) {
    frame.value.offset[dice_.below(2)] = 1;
    expected.mayFail();
  }
  chooseFrame(dice_, expected, frame.value);
  const bool orthographic = picked.model != nullptr && picked.model->orthographic;
  WalrCamera camera;
  WalrCamera previous;
  frame.value.camera = randomCamera(dice_, expected, orthographic, camera);
  // A missing previous camera is the one of the frame before.
  Expectation ofPrevious;
  if (dice_.oneIn(3) && randomCamera(dice_, ofPrevious, orthographic, previous) != nullptr) {
    frame.value.previous_camera = &previous;
    if (!ofPrevious.allows(WALR_SUCCESS)) expected.fails();
    expected.mayFail();
  }
  if (picked.model != nullptr && picked.model->hadFrame) expected.mayFail();  // With the camera of the frame before.
  if (dice_.oneIn(32)) {
    frame.value.finished_value = 1;  // Of no semaphore. Passes that are only listed do not look at it.
    if (picked.model == nullptr || picked.model->recordable) expected.fails();
  }
  const WalrResult result = check_("walr_begin_frame", expected,
                                   {"WalrPasses", "WalrPassFrame", "WalrFrame", "WalrCamera", "camera", "matrix",
                                    "sky_depth", "exposure", "offset", "origin", "finished_value"},
                                   [&] { return walr_begin_frame(picked.handle, &frame.value); });
  if (result != WALR_SUCCESS || picked.model == nullptr) return;
  picked.model->begun = true;
  picked.model->hadFrame = true;
}

void RandomCalls::frameConstants() {
  Expectation expected;
  const PickedPasses picked = pickPasses(expected);
  std::uint32_t resource = dice_.of({0U, 1U, 1000U, WALR_NONE});
  std::vector<std::byte> bytes(1024);
  if (picked.model != nullptr) {
    if (!picked.model->begun) expected.fails(WALR_ERROR_WRONG_ORDER);
    const WalrPassList* const list = picked.model->list;
    if (list != nullptr && !dice_.oneIn(8)) resource = dice_.below(list->resource_count);
    const bool known = list != nullptr && resource < list->resource_count;
    if (known && list->resources[resource]->kind != WALR_RESOURCE_UPLOAD) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
    if (!known) expected.mayFail();
    if (known) bytes.resize(std::max(bytes.size(), std::size_t(list->resources[resource]->buffer_size)));
  }
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

void RandomCalls::recordPass() {
  Expectation expected;
  const PickedPasses picked = pickPasses(expected);
  if (host_.recorder != nullptr && picked.model != nullptr && picked.model->list != nullptr) {
    host_.recorder->recordPass(dice_, check_, *picked.model);
    return;
  }
  expected.fails();  // There is no command buffer.
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
  switch (dice_.below(4)) {
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
    case 2: {
      std::array<WalrCounter, 4> counters{};
      const bool counts = picked.model != nullptr && (picked.model->lint || picked.model->counters);
      if (picked.model != nullptr && !counts) expected.fails(WALR_ERROR_WRONG_ORDER);
      if (withoutCount) expected.fails(WALR_ERROR_INVALID_ARGUMENT);
      check_("walr_get_pass_counters", expected, {"WalrPasses", "WalrDenoiserInfo::counters", "the count's address"},
             [&] { return walr_get_pass_counters(picked.handle, withoutCount ? nullptr : &count, counters.data()); });
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

}  // namespace walr::test
