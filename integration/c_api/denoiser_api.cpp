#include <algorithm>

#include <walr/walr.h>

#include "integration/c_api/handles.h"
#include "integration/c_api/hosted_denoiser.h"
#include "integration/c_api/structs.h"

using namespace walr::api;

namespace {

HandleTable<WalrDenoiser, HostedDenoiser>& denoisers() {
  static HandleTable<WalrDenoiser, HostedDenoiser> table("WalrDenoiser");
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
    *denoiser = denoisers().add(std::make_unique<HostedDenoiser>(readStruct(info, "WalrDenoiserInfo")));
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

WalrResult walr_get_timings(WalrDenoiser denoiser, uint32_t* count, WalrPassTime* times) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    const auto measured = object.timings();
    uint32_t& room = required(count, "the count's address");
    const std::size_t written = times == nullptr ? 0 : std::min<std::size_t>(room, measured.size());
    room = static_cast<uint32_t>(measured.size());
    for (std::size_t i = 0; i < written; ++i) times[i] = {measured[i].name.c_str(), measured[i].milliseconds};
  });
}

WalrResult walr_get_findings(WalrDenoiser denoiser, uint32_t* count, WalrFinding* findings) {
  return denoisers().call(denoiser, [&](HostedDenoiser& object) {
    const auto found = object.findings();
    uint32_t& room = required(count, "the count's address");
    const std::size_t written = findings == nullptr ? 0 : std::min<std::size_t>(room, found.size());
    room = static_cast<uint32_t>(found.size());
    for (std::size_t i = 0; i < written; ++i) {
      findings[i] = {found[i].name.data(), found[i].what.c_str(), found[i].cause.data(), found[i].wayOut.data()};
    }
  });
}
