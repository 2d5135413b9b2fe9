#include <cstring>

#include <walr/walr_passes.h>

#include "integration/c_api/handles.h"
#include "integration/c_api/hosted_passes.h"
#include "integration/c_api/structs.h"

using namespace walr::api;

namespace {

HandleTable<WalrPasses, HostedPasses>& allPasses() {
  // Never destroyed: at exit, a host may have destroyed its device before objects that it forgot.
  static auto& table = *new HandleTable<WalrPasses, HostedPasses>("WalrPasses");
  return table;
}

}  // namespace

WalrResult walr_create_passes(const WalrPassesInfo* info, WalrPasses* passes) {
  return guarded([&] {
    required(passes, "the result's address") = nullptr;
    const WalrPassesInfo given = readStruct(info, "WalrPassesInfo");
    if (given.setting_count > 0) required(given.settings, "WalrPassesInfo::settings");
    if (given.port_count > 0) required(given.ports, "WalrPassesInfo::ports");
    *passes = allPasses().add(std::make_unique<HostedPasses>(readStruct(given.denoiser, "WalrDenoiserInfo"),
                                                             std::span(given.settings, given.setting_count),
                                                             std::span(given.ports, given.port_count)));
  });
}

WalrResult walr_destroy_passes(WalrPasses passes) {
  return guarded([&] { allPasses().remove(passes); });
}

WalrResult walr_get_pass_list(WalrPasses passes, const WalrPassList** list) {
  return allPasses().call(passes, [&](HostedPasses& object) { required(list, "the list's address") = &object.list(); });
}

WalrResult walr_continue_passes(WalrPasses passes, WalrPasses last) {
  return allPasses().call(passes, [&](HostedPasses& object) {
    if (passes == last) throw Error(WALR_ERROR_INVALID_ARGUMENT, "passes cannot continue from themselves");
    allPasses().use(last, [&](const HostedPasses& before) { object.continueFrom(before); });
  });
}

WalrResult walr_begin_frame(WalrPasses passes, const WalrPassFrame* frame) {
  return allPasses().call(passes, [&](HostedPasses& object) { object.beginFrame(readStruct(frame, "WalrPassFrame")); });
}

WalrResult walr_get_frame_constants(WalrPasses passes, uint32_t resource, void* bytes, size_t* size) {
  return allPasses().call(passes, [&](HostedPasses& object) {
    const auto constants = object.frameConstants(resource);
    copyOut(constants.data(), constants.size(), bytes, size);
  });
}

WalrResult walr_record_pass(WalrPasses passes, uint32_t pass, VkCommandBuffer command_buffer,
                            const WalrPassResource* resources, uint32_t resource_count) {
  return allPasses().call(passes, [&](HostedPasses& object) {
    if (resource_count > 0) required(resources, "the array of resources");
    object.record(pass, command_buffer, std::span(resources, resource_count));
  });
}

WalrResult walr_forget_pass_image(WalrPasses passes, VkImage image, uint64_t identity) {
  return allPasses().call(passes, [&](HostedPasses& object) { object.forget(image, identity); });
}

WalrResult walr_get_pass_timings(WalrPasses passes, uint32_t* count, WalrPassTime* times) {
  return allPasses().call(passes, [&](HostedPasses& object) {
    copyElements(object.timings(), times, count, [](const WalrPassTime& time) { return time; });
  });
}

WalrResult walr_get_pass_counters(WalrPasses passes, uint32_t* count, WalrCounter* counters) {
  return allPasses().call(passes, [&](HostedPasses& object) {
    copyElements(object.counters(), counters, count, [](const WalrCounter& counter) { return counter; });
  });
}

WalrResult walr_get_pass_findings(WalrPasses passes, uint32_t* count, WalrFinding* findings) {
  return allPasses().call(passes, [&](HostedPasses& object) { copyElements(object.findings(), findings, count, toC); });
}
