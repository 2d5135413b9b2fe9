/* Wrong descriptions of devices and denoisers. */
#include <math.h>
#include <stddef.h>

#include <walr/walr_passes.h>

#include "misuse.h"

static void test_listing(void) {
  EXPECT_TRUE(walr_pass_type_count() > 7);
  EXPECT_TRUE(walr_pass_type(walr_pass_type_count()) == NULL);
  int methods = 0;
  for (uint32_t i = 0; i < walr_pass_type_count(); ++i) {
    const WalrPassType* type = walr_pass_type(i);
    EXPECT_TRUE(type->struct_size == sizeof(WalrPassType) && type->name[0] != '\0' && type->pass_count > 0);
    methods += type->method != 0;
    for (uint32_t p = 0; p < type->port_count; ++p) EXPECT_TRUE(type->ports[p]->name[0] != '\0');
    for (uint32_t s = 0; s < type->setting_count; ++s) {
      const WalrSetting* setting = type->settings[s];
      EXPECT_TRUE(setting->description[0] != '\0' && setting->default_value[0] != '\0');
      EXPECT_TRUE((setting->kind >= WALR_SETTING_SWITCH) == (setting->choice_count > 1));
    }
  }
  EXPECT_TRUE(methods >= 6);
  EXPECT_TRUE(walr_version()[0] != '\0');
}

static void test_device(const Host* host) {
  WalrDevice device = device_of(host);
  EXPECT_OK(walr_check_device(&device));
  EXPECT(walr_check_device(NULL), WALR_ERROR_INVALID_ARGUMENT, "WalrDevice is null");
  device.struct_size = 0;
  EXPECT(walr_check_device(&device), WALR_ERROR_STRUCT_SIZE, "sizeof(WalrDevice)");
  device.struct_size = sizeof(WalrDevice) - 4; /* Ends inside a pointer. */
  EXPECT(walr_check_device(&device), WALR_ERROR_STRUCT_SIZE, "sizeof(WalrDevice)");
  device = device_of(host);
  device.get_instance_proc_addr = NULL;
  EXPECT(walr_check_device(&device), WALR_ERROR_INVALID_ARGUMENT, "get_instance_proc_addr is null");
  device = device_of(host);
  device.device = VK_NULL_HANDLE;
  EXPECT(walr_check_device(&device), WALR_ERROR_INVALID_ARGUMENT, "device is null");
  device = device_of(host);
  device.queue_family = 99;
  EXPECT(walr_check_device(&device), WALR_ERROR_UNSUPPORTED, "queue family 99 does not exist");

  VkDeviceCreateInfo created = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .pNext = &host->features};
  device = device_of(host);
  device.create_info = &created;
  EXPECT_OK(walr_check_device(&device));
  created.pNext = NULL;
  EXPECT(walr_check_device(&device), WALR_ERROR_UNSUPPORTED, "created without\n  feature synchronization2");
  EXPECT(walr_check_device(&device), WALR_ERROR_UNSUPPORTED, "feature shaderStorageImageExtendedFormats");
  const VkPhysicalDeviceSynchronization2Features synchronization2 = {
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES, .synchronization2 = VK_TRUE};
  const VkPhysicalDeviceFeatures features = {.shaderStorageImageExtendedFormats = VK_TRUE};
  created.pNext = &synchronization2;
  created.pEnabledFeatures = &features;
  EXPECT_OK(walr_check_device(&device));
}

/* A description that is good but for one change. */
#define REFUSED(text, ...)                                                             \
  do {                                                                                 \
    info = info_of(device);                                                            \
    __VA_ARGS__;                                                                       \
    EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, text); \
  } while (0)

static void test_create(const WalrDevice* device) {
  WalrDenoiser denoiser = NULL;
  WalrDenoiserInfo info = info_of(device);
  EXPECT(walr_create_denoiser(NULL, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "WalrDenoiserInfo is null");
  EXPECT(walr_create_denoiser(&info, NULL), WALR_ERROR_INVALID_ARGUMENT, "null");
  REFUSED("WalrDevice is null", info.device = NULL);
  REFUSED("known methods: walr", info.method = "magic");
  REFUSED(
      "known presets: standard; of the former presets, fast, blocks, one-sample and many-samples are part of standard",
      info.preset = "fast");
  REFUSED("there is no light direction: the method", info.method = "svgf", info.light_direction = VK_TRUE);
  REFUSED("there is no expected error: use the method walr", info.method = "flr", info.expected_error = VK_TRUE);
  REFUSED("there is no history length", info.method = "none", info.history_length = VK_TRUE);
  REFUSED("0 x 48", info.width = 0);
  REFUSED("16384", info.height = 1U << 20);
  REFUSED("frames_in_flight", info.frames_in_flight = 1000);
  REFUSED("'depth' cannot be of format R32_UINT", info.depth_format = VK_FORMAT_R32_UINT);
  REFUSED("3 channels", info.normal_format = VK_FORMAT_R16G16_SFLOAT);
  WalrConventions conventions;
#define CONVENTIONS(...) \
  conventions = (WalrConventions){.struct_size = sizeof(conventions), __VA_ARGS__}, info.conventions = &conventions
  REFUSED("motion_unit is 7", CONVENTIONS(.motion_unit = (WalrMotionUnit)7));
  REFUSED("motion_scale", CONVENTIONS(.motion_scale = {NAN, 1}));
  REFUSED("light_group is 4 pixels", CONVENTIONS(.light_group = {2, 4}));
  REFUSED("only one of the two", CONVENTIONS(.light_group = {2, 2}, .rectangle = VK_TRUE));
  REFUSED("4 channels", CONVENTIONS(.light_masked = VK_TRUE), info.lighting_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32);
  REFUSED("4 channels", CONVENTIONS(.light_counted = VK_TRUE),
          info.lighting_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32);
  REFUSED("needs a sample of light at every pixel", CONVENTIONS(.light_masked = VK_TRUE), info.method = "svgf");
#undef CONVENTIONS
  EXPECT_TRUE(denoiser == NULL);

  /* A caller with a newer header works as long as it sets no field that this version does not know. */
  struct {
    WalrDenoiserInfo info;
    uint64_t later;
  } larger = {.info = info_of(device), .later = 1};
  larger.info.struct_size = sizeof(larger);
  EXPECT(walr_create_denoiser(&larger.info, &denoiser), WALR_ERROR_STRUCT_SIZE, "does not know");
  larger.later = 0;
  larger.info.reserved = 1;
  EXPECT(walr_create_denoiser(&larger.info, &denoiser), WALR_ERROR_STRUCT_SIZE, "does not know");
  larger.info.reserved = 0;
  larger.info.reserved2 = 1;
  EXPECT(walr_create_denoiser(&larger.info, &denoiser), WALR_ERROR_STRUCT_SIZE, "does not know");
  larger.info.reserved2 = 0;
  EXPECT_OK(walr_create_denoiser(&larger.info, &denoiser));
  EXPECT_OK(walr_destroy_denoiser(denoiser));
}

/* A switch is on or off. What was never set is found by its value. */
static void test_switches(const WalrDevice* device) {
  WalrDenoiser denoiser = NULL;
  WalrDenoiserInfo info = info_of(device);
  VkBool32* const of_info[] = {&info.timestamps, &info.lint, &info.counters, &info.history_length};
  const char* const names[] = {"WalrDenoiserInfo::timestamps is 2", "WalrDenoiserInfo::lint is 2",
                               "WalrDenoiserInfo::counters is 2", "WalrDenoiserInfo::history_length is 2"};
  for (int i = 0; i < 4; ++i) {
    *of_info[i] = 2;
    EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, names[i]);
    *of_info[i] = VK_FALSE;
  }
  WalrConventions conventions = {.struct_size = sizeof(conventions)};
  info.conventions = &conventions;
  VkBool32* const of_conventions[] = {&conventions.pre_exposed,  &conventions.motion_jittered,
                                      &conventions.rectangle,    &conventions.orthographic,
                                      &conventions.light_masked, &conventions.light_counted};
  const char* const fields[] = {"::pre_exposed is 4294967295",
                                "::motion_jittered is 4294967295",
                                "::rectangle is 4294967295",
                                "::orthographic is 4294967295",
                                "::light_masked is 4294967295, neither VK_FALSE nor VK_TRUE",
                                "::light_counted is 4294967295"};
  for (int i = 0; i < 6; ++i) {
    *of_conventions[i] = UINT32_MAX;
    EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, fields[i]);
    *of_conventions[i] = VK_FALSE;
  }
  EXPECT_TRUE(denoiser == NULL);
}

/* A texel of sparse light stands for several pixels. Methods that need all samples refuse it by name. */
static void test_sparse_light(const WalrDevice* device) {
  const WalrConventions conventions = {.struct_size = sizeof(conventions), .light_group = {3, 2}};
  WalrDenoiserInfo info = info_of(device);
  info.conventions = &conventions;
  WalrDenoiser denoiser;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  WalrImageRequirements light = {.struct_size = sizeof(light)};
  WalrImageRequirements depth = {.struct_size = sizeof(depth)};
  EXPECT_OK(walr_get_image_requirements(denoiser, "lighting", &light));
  EXPECT_OK(walr_get_image_requirements(denoiser, "depth", &depth));
  EXPECT_TRUE(light.width == (kWidth + 2) / 3 && light.height == (kHeight + 1) / 2);
  EXPECT_TRUE(depth.width == kWidth && depth.height == kHeight);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  info.method = "svgf";
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT,
         "method 'svgf' needs a sample of light at every pixel");
}

/* Lights share guides two at a time, and only where there are guides. */
static void test_lights(const WalrDevice* device) {
  WalrDenoiserInfo info = info_of(device);
  WalrDenoiser denoiser = NULL;
  info.light_count = 3;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "light_count is 3");
  info.light_count = 2;
  info.second_preset = "magic";
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "no preset \"magic\"");
  info.second_preset = "standard";
  info.light_count = 1;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "set light_count to 2");
  info.second_preset = NULL;
  info.light_count = 2;
  info.method = "none";
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "make a denoiser for each light");
  const WalrPassesInfo listed = {.struct_size = sizeof(listed), .denoiser = &info};
  WalrPasses passes = NULL;
  info.method = "prepare_guides";
  info.device = NULL;
  EXPECT(walr_create_passes(&listed, &passes), WALR_ERROR_INVALID_ARGUMENT, "stage 'prepare_guides' has one light");

  info = info_of(device);
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  EXPECT(walr_set_setting(denoiser, "second.blocks.size", "5"), WALR_ERROR_INVALID_ARGUMENT, "second.blocks.size");
  EXPECT(walr_use_preset(denoiser, "second.standard"), WALR_ERROR_INVALID_ARGUMENT, "second.standard");
  WalrImageRequirements needs = {.struct_size = sizeof(needs)};
  EXPECT_OK(walr_get_image_requirements(denoiser, "second_lighting", &needs));
  EXPECT_TRUE(!needs.required);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  info.light_count = 2;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  EXPECT(walr_set_setting(denoiser, "second.magic", "5"), WALR_ERROR_INVALID_ARGUMENT, "\"magic\"");
  EXPECT(walr_set_setting(denoiser, "second.blocks.size", "99"), WALR_ERROR_INVALID_ARGUMENT, "blocks.size");
  EXPECT_OK(walr_get_image_requirements(denoiser, "second_lighting", &needs));
  EXPECT_TRUE(needs.required && needs.width == kWidth && needs.height == kHeight);
  EXPECT_OK(walr_get_image_requirements(denoiser, "second_denoised", &needs));
  EXPECT_TRUE(needs.required);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
}

/* Specular light needs a method that takes it, images of its own and a light of every pixel. */
static void test_specular_light(const WalrDevice* device) {
  WalrDenoiser denoiser = NULL;
  WalrDenoiserInfo info;
  WalrConventions conventions = {.struct_size = sizeof(conventions)};
#define SPECULAR(...) \
  info.method = "accumulate", info.light_kind = WALR_LIGHT_SPECULAR, info.conventions = &conventions, __VA_ARGS__
#define SECOND(...)                                                                                                   \
  SPECULAR(info.light_kind = WALR_LIGHT_DIFFUSE), info.second_light_kind = WALR_LIGHT_SPECULAR, info.light_count = 2, \
                                                  __VA_ARGS__
  REFUSED("WalrDenoiserInfo::light_kind is 2, not one of 0..1", info.light_kind = (WalrLightKind)2);
  REFUSED("::second_light_kind is 7", SECOND(info.second_light_kind = (WalrLightKind)7));
  REFUSED("::second_light_kind is given, but there are fewer lights: set light_count to 2",
          SECOND(info.light_count = 1));
  REFUSED("no light is specular: set light_kind or second_light_kind", info.roughness_format = VK_FORMAT_R8_UNORM);
  REFUSED("no light is specular", info.specular_albedo_format = VK_FORMAT_R16G16B16A16_SFLOAT);
  REFUSED("no light is specular", info.specular_motion_format = VK_FORMAT_R16G16B16A16_SFLOAT);
  REFUSED("method 'bmfr' takes diffuse light only; methods that take specular light: ", SPECULAR(info.method = "bmfr"));
  REFUSED("method 'bmfr' takes diffuse light only", SECOND(info.method = "bmfr"));
  REFUSED("'roughness' cannot be of format R32_UINT", SPECULAR(info.roughness_format = VK_FORMAT_R32_UINT));
  REFUSED("'specular_motion' cannot be of", SPECULAR(info.specular_motion_format = VK_FORMAT_R16G16_SFLOAT));
  REFUSED("'specular_albedo' cannot be of", SPECULAR(info.specular_albedo_format = VK_FORMAT_R16G16_SFLOAT));
  REFUSED("4 channels", SPECULAR(info.lighting_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32));
  REFUSED("4 channels", SECOND(info.lighting_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32));
  REFUSED("stored as SFLOAT", SPECULAR(info.lighting_format = VK_FORMAT_R16G16B16A16_UNORM));
  REFUSED("stored as SFLOAT", SECOND(info.lighting_format = VK_FORMAT_R8G8B8A8_SRGB));
  REFUSED("make a denoiser for each light", SECOND(info.method = "none", info.light_kind = WALR_LIGHT_SPECULAR));
#define CONVENTION(...)                             \
  conventions = (WalrConventions) {                 \
    .struct_size = sizeof(conventions), __VA_ARGS__ \
  }
  for (int second = 0; second < 2; ++second) {
#define OF_EITHER(...)                                   \
  CONVENTION(__VA_ARGS__), SECOND(info.light_count = 2); \
  if (!second) SPECULAR(info.light_count = 0, info.second_light_kind = WALR_LIGHT_DIFFUSE)
    REFUSED("needs a perspective camera", OF_EITHER(.orthographic = VK_TRUE));
    REFUSED("leave out light groups", OF_EITHER(.light_group = {2, 2}));
    REFUSED("counts of samples", OF_EITHER(.light_counted = VK_TRUE));
    info = info_of(device);
    OF_EITHER(.motion_depth = WALR_MOTION_DEPTH_FOUND);
    EXPECT_OK(walr_create_denoiser(&info, &denoiser));
    walr_destroy_denoiser(denoiser);
    denoiser = NULL;
#undef OF_EITHER
  }
  CONVENTION(.rectangle = VK_FALSE);
#undef CONVENTION
  EXPECT_TRUE(denoiser == NULL);
  const WalrPassesInfo listed = {.struct_size = sizeof(listed), .denoiser = &info};
  WalrPasses passes = NULL;
  info = info_of(device);
  SPECULAR(info.method = "temporal_accumulation", info.device = NULL);
  EXPECT(walr_create_passes(&listed, &passes), WALR_ERROR_INVALID_ARGUMENT, "no specular light");
  /* Its history is no history of diffuse light. */
  WalrPasses diffuse = NULL;
  info = info_of(NULL);
  info.method = "accumulate";
  EXPECT_OK(walr_create_passes(&listed, &diffuse));
  info.light_kind = WALR_LIGHT_SPECULAR;
  EXPECT_OK(walr_create_passes(&listed, &passes));
  EXPECT(walr_continue_passes(passes, diffuse), WALR_ERROR_INVALID_ARGUMENT, "another kind of light");
  EXPECT_OK(walr_destroy_passes(passes));
  /* Nor is that of other pixels or cameras, or one that the library drops. */
  const WalrConventions others[] = {{.struct_size = sizeof(WalrConventions), .light_group = {2, 2}},
                                    {.struct_size = sizeof(WalrConventions), .orthographic = VK_TRUE}};
  info.light_kind = WALR_LIGHT_DIFFUSE;
  for (int i = 0; i < 2; ++i) {
    info.conventions = &others[i];
    EXPECT_OK(walr_create_passes(&listed, &passes));
    EXPECT(walr_continue_passes(passes, diffuse), WALR_ERROR_INVALID_ARGUMENT, "light_group");
    EXPECT_OK(walr_destroy_passes(passes));
  }
  const WalrPassFrame reset = {.struct_size = sizeof(reset), .flags = WALR_FRAME_RESET_HISTORY};
  EXPECT(walr_begin_frame(diffuse, &reset), WALR_ERROR_INVALID_ARGUMENT, "histories are the host's");
  EXPECT_OK(walr_destroy_passes(diffuse));

  /* Each kind has an albedo. A caller with an older header has diffuse light. */
  for (int kind = 0; kind < 3; ++kind) {
    info = info_of(device);
    if (kind == 2) {
      SECOND(info.method = "none"); /* Two kinds share no guides, so that this is a method for them. */
    } else {
      SPECULAR(info.struct_size = kind == 0 ? offsetof(WalrDenoiserInfo, light_kind) : sizeof(info));
    }
    EXPECT_OK(walr_create_denoiser(&info, &denoiser));
    const char* const names[] = {"albedo", "specular_albedo", "roughness"};
    for (int i = 0; i < 3; ++i) {
      WalrImageRequirements needs = {.struct_size = sizeof(needs)};
      EXPECT_OK(walr_get_image_requirements(denoiser, names[i], &needs));
      EXPECT_TRUE((needs.format != VK_FORMAT_UNDEFINED) == (kind == 2 || (kind == 1) == (i > 0)));
      EXPECT_TRUE(needs.required == (kind < 2 && needs.format != VK_FORMAT_UNDEFINED));
    }
    EXPECT_OK(walr_destroy_denoiser(denoiser));
  }
#undef SECOND
#undef SPECULAR
}

/* Object ids exist if their format is given, and are required if the method reads them. A caller with an older header
 * has none. */
static void test_object_ids(const WalrDevice* device) {
  for (int given = 0; given < 2; ++given) {
    for (int reads = 0; reads < 2; ++reads) {
      WalrDenoiser denoiser;
      WalrDenoiserInfo info = info_of(device);
      info.method = reads ? "joint_bilateral" : "walr";
      info.object_id_format = given ? VK_FORMAT_R16_UINT : VK_FORMAT_R32_SFLOAT;
      if (!given) info.struct_size = offsetof(WalrDenoiserInfo, object_id_format);
      EXPECT_OK(walr_create_denoiser(&info, &denoiser));
      WalrImageRequirements needs = {.struct_size = sizeof(needs)};
      EXPECT_OK(walr_get_image_requirements(denoiser, "object_id", &needs));
      EXPECT_TRUE(needs.required == (given && reads));
      EXPECT_TRUE(needs.format == (given ? VK_FORMAT_R16_UINT : VK_FORMAT_UNDEFINED));
      EXPECT_OK(walr_destroy_denoiser(denoiser));
    }
  }
  WalrDenoiser denoiser;
  WalrDenoiserInfo info = info_of(device);
  info.object_id_format = VK_FORMAT_R32_SFLOAT;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "'object_id' cannot be of format");
}

void test_descriptions(Host* host, const WalrDevice* device) {
  test_listing();
  test_device(host);
  test_create(device);
  test_switches(device);
  test_sparse_light(device);
  test_lights(device);
  test_specular_light(device);
  test_object_ids(device);
}
