#include <walr/walr.h>

#include "integration/c_api/handles.h"
#include "integration/c_api/hosted_denoiser.h"
#include "integration/c_api/structs.h"

using namespace walr::api;

namespace {

HandleTable<WalrDenoiser, HostedDenoiser>& denoisers() {
  // Never destroyed: at exit, a host may have destroyed its device before objects that it forgot.
  static auto& table = *new HandleTable<WalrDenoiser, HostedDenoiser>("WalrDenoiser");
  return table;
}

}  // namespace

const char* walr_version(void) {
  return WALR_VERSION;
}

const char* walr_result_name(WalrResult result) {
  return resultName(result);
}

const char* walr_last_error(void) {
  return lastError();
}

WalrResult walr_check_device(const WalrDevice* device) {
  return guarded([&] { const HostDevice checked(device); });
}

WalrResult walr_create_denoiser(const WalrDenoiserInfo* info, WalrDenoiser* denoiser) {
  return guarded([&] {
    required(denoiser, "the result's address") = nullptr;
    const WalrDenoiserInfo given = readStruct(info, "WalrDenoiserInfo");
    std::unique_ptr<HostedDenoiser> made;
    if (given.shared_with == nullptr) {
      made = std::make_unique<HostedDenoiser>(given);
    } else {
      denoisers().use(given.shared_with,
                      [&](const HostedDenoiser& other) { made = std::make_unique<HostedDenoiser>(given, &other); });
    }
    *denoiser = denoisers().add(std::move(made), given.shared_with);
  });
}

WalrResult walr_destroy_denoiser(WalrDenoiser denoiser) {
  return guarded([&] { denoisers().remove(denoiser); });
}

WalrResult walr_resize(WalrDenoiser denoiser, uint32_t width, uint32_t height) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) { object.resize(width, height); });
}

WalrResult walr_set_setting(WalrDenoiser denoiser, const char* name, const char* value) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    object.set(requireText(name, "the setting's name"), requireText(value, "the setting's value"));
  });
}

WalrResult walr_use_preset(WalrDenoiser denoiser, const char* name) {
  return denoisers().call(denoiser,
                          [&](HostedDenoiser& object) { object.usePreset(requireText(name, "the preset's name")); });
}

WalrResult walr_get_setting(WalrDenoiser denoiser, const char* name, char* value, size_t* size) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    const std::string text = object.setting(requireText(name, "the setting's name"));
    copyOut(text.c_str(), text.size() + 1, value, size);
  });
}

WalrResult walr_prepare(WalrDenoiser denoiser) {
  return denoisers().call(denoiser, [](HostedDenoiser& object) { object.prepare(); });
}

WalrResult walr_get_image_requirements(WalrDenoiser denoiser, const char* port, WalrImageRequirements* requirements) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    writeStruct(requirements, object.requirements(requireText(port, "the image's name")), "WalrImageRequirements");
  });
}

WalrResult walr_get_release_state(WalrDenoiser denoiser, const char* port, WalrImageState* state) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    required(state, "the state's address") = object.releaseState(requireText(port, "the image's name"));
  });
}

WalrResult walr_forget_image(WalrDenoiser denoiser, VkImage image, uint64_t identity) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) { object.forget(image, identity); });
}

WalrResult walr_record(WalrDenoiser denoiser, VkCommandBuffer command_buffer, const WalrFrame* frame) {
  return denoisers().call(
      denoiser, [&](HostedDenoiser& object) { object.record(command_buffer, readStruct(frame, "WalrFrame")); });
}

WalrResult walr_reset_history(WalrDenoiser denoiser) {
  return denoisers().call(denoiser, [](HostedDenoiser& object) { object.resetHistory(); });
}

WalrResult walr_get_memory(WalrDenoiser denoiser, WalrMemory* memory) {
  return denoisers().call(denoiser,
                          [&](HostedDenoiser& object) { writeStruct(memory, object.memory(), "WalrMemory"); });
}

WalrResult walr_query_memory(const WalrDenoiserInfo* info, WalrMemory* memory) {
  return guarded([&] {
    HostedDenoiser planned(readStruct(info, "WalrDenoiserInfo"));
    writeStruct(memory, planned.requiredMemory(), "WalrMemory");
  });
}

WalrResult walr_get_timings(WalrDenoiser denoiser, uint32_t* count, WalrPassTime* times) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    copyElements(object.timings(), times, count, [](const fg::vk::PassTime& time) -> WalrPassTime {
      return {time.name.c_str(), time.milliseconds};
    });
  });
}

WalrResult walr_get_views(WalrDenoiser denoiser, uint32_t* count, WalrView* views) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    copyElements(object.views(), views, count, [](const walr::ViewInfo& view) -> WalrView {
      return {view.name.data(), view.description.data()};
    });
  });
}

WalrResult walr_set_view(WalrDenoiser denoiser, const char* name) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    object.setView(name == nullptr ? std::nullopt : std::optional<std::string>(name));
  });
}

WalrResult walr_get_counters(WalrDenoiser denoiser, uint32_t* count, WalrCounter* counters) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    copyElements(object.counters(), counters, count, [](const WalrCounter& counter) { return counter; });
  });
}

WalrResult walr_get_findings(WalrDenoiser denoiser, uint32_t* count, WalrFinding* findings) {
  return denoisers().call(denoiser,
                          [&](HostedDenoiser& object) { copyElements(object.findings(), findings, count, toC); });
}
