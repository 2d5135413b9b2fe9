#include <walr/walr_plugin.h>

#include "integration/c_api/structs.h"

namespace {

constexpr WalrApi kApi{
    .struct_size = sizeof(WalrApi),
    .reserved = 0,
    .version = walr_version,
    .result_name = walr_result_name,
    .last_error = walr_last_error,
    .pass_type_count = walr_pass_type_count,
    .pass_type = walr_pass_type,
    .check_device = walr_check_device,
    .create_denoiser = walr_create_denoiser,
    .destroy_denoiser = walr_destroy_denoiser,
    .resize = walr_resize,
    .set_setting = walr_set_setting,
    .use_preset = walr_use_preset,
    .get_setting = walr_get_setting,
    .prepare = walr_prepare,
    .get_image_requirements = walr_get_image_requirements,
    .get_release_state = walr_get_release_state,
    .forget_image = walr_forget_image,
    .record = walr_record,
    .reset_history = walr_reset_history,
    .get_memory = walr_get_memory,
    .get_timings = walr_get_timings,
    .create_passes = walr_create_passes,
    .destroy_passes = walr_destroy_passes,
    .get_pass_list = walr_get_pass_list,
    .begin_frame = walr_begin_frame,
    .get_frame_constants = walr_get_frame_constants,
    .record_pass = walr_record_pass,
    .forget_pass_image = walr_forget_pass_image,
    .get_findings = walr_get_findings,
    .continue_passes = walr_continue_passes,
    .get_pass_timings = walr_get_pass_timings,
    .get_pass_findings = walr_get_pass_findings,
    .query_memory = walr_query_memory,
    .get_views = walr_get_views,
    .set_view = walr_set_view,
    .get_counters = walr_get_counters,
    .get_pass_counters = walr_get_pass_counters,
};

}  // namespace

WalrResult walr_register_plugin(const WalrRegistryHost* host) {
  using namespace walr::api;
  return guarded([&] {
    const WalrRegistryHost given = readStruct(host, "WalrRegistryHost");
    if (given.register_api == nullptr) {
      throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrRegistryHost::register_api is null");
    }
    if (given.register_api(given.user, &kApi) == VK_FALSE) {
      throw Error(WALR_ERROR_WRONG_ORDER, "the host refused the API");
    }
    for (uint32_t i = 0; given.register_pass_type != nullptr && i < walr_pass_type_count(); ++i) {
      const WalrPassType* type = walr_pass_type(i);
      if (given.register_pass_type(given.user, type) != VK_FALSE) continue;
      throw Error(WALR_ERROR_WRONG_ORDER, "the host refused pass type '" + std::string(type->name) + "'");
    }
  });
}
