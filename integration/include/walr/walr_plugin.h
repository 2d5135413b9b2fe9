/*
 * The library as a plug-in that a host loads at run time. It exports one function, walr_register_plugin, which gives
 * the host all pass types for its own registry and a table with every function of walr.h and walr_passes.h. Of walr,
 * the host needs only these headers at compile time.
 */
#ifndef WALR_WALR_PLUGIN_H
#define WALR_WALR_PLUGIN_H

#include <walr/walr_passes.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All functions. Later versions add members at the end only. */
typedef struct WalrApi {
  uint32_t struct_size; /* Size in the plug-in: compare it before you use a member that was added later. */
  uint32_t reserved;
  const char* (*version)(void);
  const char* (*result_name)(WalrResult result);
  const char* (*last_error)(void);
  uint32_t (*pass_type_count)(void);
  const WalrPassType* (*pass_type)(uint32_t index);
  WalrResult (*check_device)(const WalrDevice* device);
  WalrResult (*create_denoiser)(const WalrDenoiserInfo* info, WalrDenoiser* denoiser);
  WalrResult (*destroy_denoiser)(WalrDenoiser denoiser);
  WalrResult (*resize)(WalrDenoiser denoiser, uint32_t width, uint32_t height);
  WalrResult (*set_setting)(WalrDenoiser denoiser, const char* name, const char* value);
  WalrResult (*use_preset)(WalrDenoiser denoiser, const char* name);
  WalrResult (*get_setting)(WalrDenoiser denoiser, const char* name, char* value, size_t* size);
  WalrResult (*prepare)(WalrDenoiser denoiser);
  WalrResult (*get_image_requirements)(WalrDenoiser denoiser, const char* port, WalrImageRequirements* requirements);
  WalrResult (*get_release_state)(WalrDenoiser denoiser, const char* port, WalrImageState* state);
  WalrResult (*forget_image)(WalrDenoiser denoiser, VkImage image, uint64_t identity);
  WalrResult (*record)(WalrDenoiser denoiser, VkCommandBuffer command_buffer, const WalrFrame* frame);
  WalrResult (*reset_history)(WalrDenoiser denoiser);
  WalrResult (*get_memory)(WalrDenoiser denoiser, WalrMemory* memory);
  WalrResult (*get_timings)(WalrDenoiser denoiser, uint32_t* count, WalrPassTime* times);
  WalrResult (*create_passes)(const WalrPassesInfo* info, WalrPasses* passes);
  WalrResult (*destroy_passes)(WalrPasses passes);
  WalrResult (*get_pass_list)(WalrPasses passes, const WalrPassList** list);
  WalrResult (*begin_frame)(WalrPasses passes, const WalrPassFrame* frame);
  WalrResult (*get_frame_constants)(WalrPasses passes, uint32_t resource, void* bytes, size_t* size);
  WalrResult (*record_pass)(WalrPasses passes, uint32_t pass, VkCommandBuffer command_buffer,
                            const WalrPassResource* resources, uint32_t resource_count);
  WalrResult (*forget_pass_image)(WalrPasses passes, VkImage image, uint64_t identity);
  WalrResult (*get_findings)(WalrDenoiser denoiser, uint32_t* count, WalrFinding* findings);
  WalrResult (*continue_passes)(WalrPasses passes, WalrPasses last);
  WalrResult (*get_pass_timings)(WalrPasses passes, uint32_t* count, WalrPassTime* times);
  WalrResult (*get_pass_findings)(WalrPasses passes, uint32_t* count, WalrFinding* findings);
  WalrResult (*query_memory)(const WalrDenoiserInfo* info, WalrMemory* memory);
  WalrResult (*get_views)(WalrDenoiser denoiser, uint32_t* count, WalrView* views);
  WalrResult (*set_view)(WalrDenoiser denoiser, const char* name);
  WalrResult (*get_counters)(WalrDenoiser denoiser, uint32_t* count, WalrCounter* counters);
  WalrResult (*get_pass_counters)(WalrPasses passes, uint32_t* count, WalrCounter* counters);
} WalrApi;

/* Callbacks of the host. If one returns VK_FALSE, the registration ends with an error; any other value is success. */
typedef struct WalrRegistryHost {
  uint32_t struct_size;
  uint32_t reserved;
  void* user;
  /* Called first. The table is valid while the plug-in is loaded. */
  VkBool32 (*register_api)(void* user, const WalrApi* api);
  /* Called for each pass type; may be null. */
  VkBool32 (*register_pass_type)(void* user, const WalrPassType* type);
} WalrRegistryHost;

WALR_API WalrResult walr_register_plugin(const WalrRegistryHost* host);
typedef WalrResult (*WalrRegisterPlugin)(const WalrRegistryHost* host);

#ifdef __cplusplus
}
#endif
#endif
