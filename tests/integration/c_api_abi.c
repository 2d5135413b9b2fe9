/* Checks the layout of every structure of the API on 64-bit targets against that of version 0.1, which callers were
 * compiled with. Structures with struct_size may grow at their end; no field listed here may ever move. */
#include <stddef.h>

#include <walr/walr_plugin.h>

#define AT(type, member, offset) _Static_assert(offsetof(type, member) == (offset), #type "::" #member " has moved")
#define SIZE(type, size) _Static_assert(sizeof(type) == (size), #type " has another size")

_Static_assert(sizeof(void*) == 8, "these figures are those of 64-bit targets");

SIZE(WalrResult, 4);
_Static_assert(WALR_ERROR_INTERNAL == -9 && WALR_ERROR_CONCURRENT_USE == -4, "error codes never change");

SIZE(WalrSetting, 80);
AT(WalrSetting, name, 8);
AT(WalrSetting, least, 24);
AT(WalrSetting, choices, 40);
AT(WalrSetting, unit, 56);
AT(WalrSetting, source, 72);
SIZE(WalrPort, 56);
AT(WalrPort, name, 8);
AT(WalrPort, format, 24);
AT(WalrPort, buffer_size, 40);
AT(WalrPort, description, 48);
SIZE(WalrPassType, 72);
AT(WalrPassType, ports, 24);
AT(WalrPassType, port_count, 56);
SIZE(WalrDevice, 48);
AT(WalrDevice, instance, 8);
AT(WalrDevice, allocator, 40);
SIZE(WalrConventions, 48);
AT(WalrConventions, depth, 24);
AT(WalrConventions, motion_scale, 16);
AT(WalrConventions, motion_jittered, 36);
AT(WalrConventions, rectangle, 40);
SIZE(WalrDenoiserInfo, 104);
AT(WalrDenoiserInfo, device, 8);
AT(WalrDenoiserInfo, width, 32);
AT(WalrDenoiserInfo, conventions, 40);
AT(WalrDenoiserInfo, lighting_format, 48);
AT(WalrDenoiserInfo, log, 72);
AT(WalrDenoiserInfo, object_id_format, 88);
AT(WalrDenoiserInfo, lint, 92);
AT(WalrDenoiserInfo, pipeline_cache, 96);
SIZE(WalrImageRequirements, 24);
SIZE(WalrImageState, 24);
SIZE(WalrImage, 88);
AT(WalrImage, image, 8);
AT(WalrImage, format, 24);
AT(WalrImage, acquire, 40);
AT(WalrImage, release, 64);
SIZE(WalrCamera, 136);
SIZE(WalrFrame, 96);
AT(WalrFrame, lighting, 8);
AT(WalrFrame, camera, 56);
AT(WalrFrame, sky_depth, 72);
AT(WalrFrame, pre_exposure, 76);
AT(WalrFrame, object_id, 80);
AT(WalrFrame, offset, 88);
SIZE(WalrMemory, 56);
SIZE(WalrPassTime, 16);
SIZE(WalrFinding, 32);
AT(WalrFinding, way_out, 24);
SIZE(WalrResource, 80);
AT(WalrResource, name, 8);
AT(WalrResource, format, 24);
AT(WalrResource, buffer_size, 48);
AT(WalrResource, heap_offset, 72);
SIZE(WalrBinding, 48);
AT(WalrBinding, resource, 20);
AT(WalrBinding, access, 32);
AT(WalrBinding, filter, 44);
SIZE(WalrBarrier, 48);
AT(WalrBarrier, src_stage, 8);
AT(WalrBarrier, new_layout, 44);
SIZE(WalrSpecialization, 8);
SIZE(WalrHistoryAge, 8);
SIZE(WalrDispatch, 120);
AT(WalrDispatch, spirv, 24);
AT(WalrDispatch, barriers, 72);
AT(WalrDispatch, group_count, 96);
AT(WalrDispatch, indirect_offset, 112);
SIZE(WalrHeap, 16);
SIZE(WalrPassList, 72);
AT(WalrPassList, passes, 16);
AT(WalrPassList, pass_count, 40);
AT(WalrPassList, ports, 56);
SIZE(WalrPortResource, 16);
SIZE(WalrPortFormat, 16);
SIZE(WalrSettingValue, 16);
SIZE(WalrPassesInfo, 40);
AT(WalrPassesInfo, settings, 16);
AT(WalrPassesInfo, ports, 24);
SIZE(WalrPassFrame, 40);
AT(WalrPassFrame, offset, 32);
SIZE(WalrPassResource, 32);
AT(WalrPassResource, layout, 24);
SIZE(WalrApi, 240);
AT(WalrApi, version, 8);
AT(WalrApi, create_denoiser, 56);
AT(WalrApi, record, 136);
AT(WalrApi, create_passes, 168);
AT(WalrApi, forget_pass_image, 216);
AT(WalrApi, get_findings, 224);
AT(WalrApi, continue_passes, 232);
SIZE(WalrRegistryHost, 32);
AT(WalrRegistryHost, register_pass_type, 24);
