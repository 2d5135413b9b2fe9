/* Misuse of the C API always gives an error code and a text. It never crashes, and nothing is recorded. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

#include <walr/walr.h>

#include "host/vulkan_host.h"

enum { kWidth = 64, kHeight = 48 };

static int failures = 0;

static void expect(WalrResult got, WalrResult wanted, const char* text, int line) {
  if (got == wanted && (wanted == WALR_SUCCESS || strstr(walr_last_error(), text) != NULL)) return;
  ++failures;
  fprintf(stderr, "line %d: expected %s with \"%s\", got %s with \"%s\"\n", line, walr_result_name(wanted), text,
          walr_result_name(got), walr_last_error());
}
#define EXPECT(call, wanted, text) expect((call), (wanted), (text), __LINE__)
#define EXPECT_OK(call) expect((call), WALR_SUCCESS, "", __LINE__)
#define EXPECT_TRUE(condition)                                        \
  do {                                                                \
    if (!(condition)) {                                               \
      ++failures;                                                     \
      fprintf(stderr, "line %d: not so: %s\n", __LINE__, #condition); \
    }                                                                 \
  } while (0)

static WalrDevice device_of(const Host* host) {
  return (WalrDevice){.struct_size = sizeof(WalrDevice),
                      .queue_family = host->queue_family,
                      .instance = host->instance,
                      .physical_device = host->physical_device,
                      .device = host->device,
                      .get_instance_proc_addr = vkGetInstanceProcAddr};
}

static WalrDenoiserInfo info_of(const WalrDevice* device) {
  return (WalrDenoiserInfo){
      .struct_size = sizeof(WalrDenoiserInfo), .device = device, .width = kWidth, .height = kHeight};
}

static const WalrCamera kCamera = {.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                   .projection = {1.5F, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.1F, 0}};

/* The host's images of a frame. */
typedef struct Images {
  HostImage host[6];
  WalrImage image[6];
} Images;

static const char* const kNames[6] = {"lighting", "depth", "normal", "motion", "albedo", "denoised"};

static Images make_images(Host* host, WalrDenoiser denoiser) {
  Images images;
  memset(&images, 0, sizeof(images));
  static uint16_t zeros[kWidth * kHeight * 4];
  for (int i = 0; i < 6; ++i) {
    WalrImageRequirements needs = {.struct_size = sizeof(needs)};
    EXPECT_OK(walr_get_image_requirements(denoiser, kNames[i], &needs));
    EXPECT_TRUE(needs.width == kWidth && needs.height == kHeight && needs.required);
    HostImage* image = &images.host[i];
    *image = host_make_image(host, needs.format, kWidth, kHeight, needs.usage);
    host_upload(host, image, zeros);
    images.image[i] = (WalrImage){.struct_size = sizeof(WalrImage),
                                  .queue_family = VK_QUEUE_FAMILY_IGNORED,
                                  .image = image->image,
                                  .format = image->format,
                                  .usage = image->usage,
                                  .width = kWidth,
                                  .height = kHeight,
                                  .acquire = {.stage = image->stage, .access = image->access, .layout = image->layout}};
  }
  return images;
}

static WalrFrame frame_of(const Images* images) {
  return (WalrFrame){.struct_size = sizeof(WalrFrame),
                     .lighting = &images->image[0],
                     .depth = &images->image[1],
                     .normal = &images->image[2],
                     .motion = &images->image[3],
                     .albedo = &images->image[4],
                     .denoised = &images->image[5],
                     .camera = &kCamera};
}

/* After a frame the images are in their release states. */
static void follow(Images* images, WalrDenoiser denoiser) {
  for (int i = 0; i < 6; ++i) {
    WalrImageState state;
    EXPECT_OK(walr_get_release_state(denoiser, kNames[i], &state));
    images->image[i].acquire = state;
    images->host[i].stage = state.stage;
    images->host[i].access = state.access;
    images->host[i].layout = state.layout;
  }
}

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

static void test_create(const WalrDevice* device) {
  WalrDenoiser denoiser = NULL;
  WalrDenoiserInfo info = info_of(device);
  EXPECT(walr_create_denoiser(NULL, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "WalrDenoiserInfo is null");
  EXPECT(walr_create_denoiser(&info, NULL), WALR_ERROR_INVALID_ARGUMENT, "null");
  info.device = NULL;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "WalrDevice is null");
  info = info_of(device);
  info.method = "magic";
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "known methods: walr");
  info = info_of(device);
  info.preset = "magic";
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT,
         "known presets: one-sample, many-samples; walr is what its preset blocks was");
  info = info_of(device);
  info.width = 0;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "0 x 48");
  info = info_of(device);
  info.height = 1U << 20;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "16384");
  info = info_of(device);
  info.frames_in_flight = 1000;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "frames_in_flight");
  info = info_of(device);
  info.depth_format = VK_FORMAT_R32_UINT;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "'depth' cannot be of format R32_UINT");
  info = info_of(device);
  info.normal_format = VK_FORMAT_R16G16_SFLOAT;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "3 channels");
  info = info_of(device);
  WalrConventions conventions = {.struct_size = sizeof(conventions), .motion_unit = (WalrMotionUnit)7};
  info.conventions = &conventions;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "motion_unit is 7");
  conventions = (WalrConventions){.struct_size = sizeof(conventions), .motion_scale = {NAN, 1}};
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "motion_scale");
  conventions = (WalrConventions){.struct_size = sizeof(conventions), .light_group = {2, 4}};
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "light_group is 4 pixels");
  conventions = (WalrConventions){.struct_size = sizeof(conventions), .light_group = {2, 2}, .rectangle = VK_TRUE};
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "only one of the two");
  conventions = (WalrConventions){.struct_size = sizeof(conventions), .light_masked = VK_TRUE};
  info.lighting_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32;
  EXPECT(walr_create_denoiser(&info, &denoiser), WALR_ERROR_INVALID_ARGUMENT, "4 channels");
  EXPECT_TRUE(denoiser == NULL);

  /* A caller with a newer header works as long as it sets no field that this version does not know. */
  struct {
    WalrDenoiserInfo info;
    uint64_t later;
  } larger = {.info = info_of(device), .later = 1};
  larger.info.struct_size = sizeof(larger);
  EXPECT(walr_create_denoiser(&larger.info, &denoiser), WALR_ERROR_STRUCT_SIZE, "does not know");
  larger.later = 0;
  EXPECT_OK(walr_create_denoiser(&larger.info, &denoiser));
  EXPECT_OK(walr_destroy_denoiser(denoiser));
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
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  EXPECT(walr_prepare(denoiser), WALR_ERROR_INVALID_ARGUMENT, "method 'svgf' needs a sample of light at every pixel");
  EXPECT_OK(walr_destroy_denoiser(denoiser));
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

/* A frame with object ids, and one of a caller with an older header although the denoiser needs them. */
static void test_object_id_frames(Host* host, const WalrDevice* device) {
  WalrDenoiser denoiser;
  WalrDenoiserInfo info = info_of(device);
  info.method = "joint_bilateral";
  info.object_id_format = VK_FORMAT_R32_UINT;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  Images images = make_images(host, denoiser);
  WalrImageRequirements needs = {.struct_size = sizeof(needs)};
  EXPECT_OK(walr_get_image_requirements(denoiser, "object_id", &needs));
  static uint32_t numbers[kWidth * kHeight];
  HostImage ids = host_make_image(host, needs.format, kWidth, kHeight, needs.usage);
  host_upload(host, &ids, numbers);
  const WalrImage object_id = {.struct_size = sizeof(WalrImage),
                               .queue_family = VK_QUEUE_FAMILY_IGNORED,
                               .image = ids.image,
                               .format = ids.format,
                               .usage = ids.usage,
                               .width = kWidth,
                               .height = kHeight,
                               .acquire = {.stage = ids.stage, .access = ids.access, .layout = ids.layout}};
  WalrFrame frame = frame_of(&images);
  frame.object_id = &object_id;
  VkCommandBuffer commands = host_begin(host);
  frame.struct_size = offsetof(WalrFrame, object_id);
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "image 'object_id' is null");
  frame.struct_size = sizeof(frame);
  EXPECT_OK(walr_record(denoiser, commands, &frame));
  host_submit_and_wait(host, commands);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  host_destroy_image(host, &ids);
  for (int i = 0; i < 6; ++i) host_destroy_image(host, &images.host[i]);
}

static void test_handles(const WalrDevice* device) {
  WalrDenoiser denoiser = NULL;
  const WalrDenoiserInfo info = info_of(device);
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  const WalrDenoiser wrong[] = {NULL, denoiser, (WalrDenoiser)(uintptr_t)0x12345678, (WalrDenoiser)(uintptr_t)-1};
  for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); ++i) {
    WalrMemory memory = {.struct_size = sizeof(memory)};
    WalrImageRequirements needs = {.struct_size = sizeof(needs)};
    WalrImageState state;
    const WalrFrame frame = {.struct_size = sizeof(frame)};
    uint32_t count = 0;
    size_t size = 0;
    const char* text = wrong[i] == NULL ? "null" : "destroyed before";
    EXPECT(walr_destroy_denoiser(wrong[i]), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_resize(wrong[i], 8, 8), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_set_setting(wrong[i], "a", "b"), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_get_setting(wrong[i], "a", NULL, &size), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_use_preset(wrong[i], "a"), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_prepare(wrong[i]), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_get_image_requirements(wrong[i], "depth", &needs), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_get_release_state(wrong[i], "depth", &state), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_forget_image(wrong[i], VK_NULL_HANDLE, 0), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_record(wrong[i], VK_NULL_HANDLE, &frame), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_reset_history(wrong[i]), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_get_memory(wrong[i], &memory), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_get_timings(wrong[i], &count, NULL), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_get_findings(wrong[i], &count, NULL), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_get_views(wrong[i], &count, NULL), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_set_view(wrong[i], NULL), WALR_ERROR_INVALID_HANDLE, text);
    EXPECT(walr_get_counters(wrong[i], &count, NULL), WALR_ERROR_INVALID_HANDLE, text);
  }
}

static void test_settings(WalrDenoiser denoiser) {
  EXPECT(walr_set_setting(denoiser, NULL, "1"), WALR_ERROR_INVALID_ARGUMENT, "null");
  EXPECT(walr_set_setting(denoiser, "blocks.iterations", NULL), WALR_ERROR_INVALID_ARGUMENT, "null");
  EXPECT(walr_set_setting(denoiser, "iterations", "1"), WALR_ERROR_INVALID_ARGUMENT, "near ones: blocks.iterations");
  EXPECT(walr_set_setting(denoiser, "blocks.iterations", "9"), WALR_ERROR_INVALID_ARGUMENT, "1..4");
  EXPECT(walr_use_preset(denoiser, "magic"), WALR_ERROR_INVALID_ARGUMENT, "known presets");
  char value[8];
  size_t size = 1;
  EXPECT(walr_get_setting(denoiser, "blocks.sdf-fraction", value, &size), WALR_ERROR_INVALID_ARGUMENT, "needs 5 bytes");
  EXPECT_TRUE(size == strlen("0.75") + 1);
  EXPECT_OK(walr_get_setting(denoiser, "blocks.sdf-fraction", value, &size));
  EXPECT_TRUE(strcmp(value, "0.75") == 0);
  EXPECT(walr_get_setting(denoiser, "magic", value, &size), WALR_ERROR_INVALID_ARGUMENT, "\"magic\"");
  EXPECT(walr_resize(denoiser, 0, 1), WALR_ERROR_INVALID_ARGUMENT, "0 x 1");
  /* Settings that contradict each other are reported when they are first used, and can be corrected. */
  EXPECT_OK(walr_set_setting(denoiser, "blocks.plane-near", "0.5"));
  EXPECT(walr_prepare(denoiser), WALR_ERROR_INVALID_ARGUMENT, "blocks.plane-near must be below blocks.plane-far");
  EXPECT_OK(walr_set_setting(denoiser, "blocks.plane-near", "0.0015"));
}

static void test_frames(Host* host, WalrDenoiser denoiser) {
  Images images = make_images(host, denoiser);
  WalrMemory memory = {.struct_size = sizeof(memory)};
  WalrImageState state;
  EXPECT(walr_get_memory(denoiser, &memory), WALR_ERROR_WRONG_ORDER, "walr_prepare");
  EXPECT(walr_get_release_state(denoiser, "depth", &state), WALR_ERROR_WRONG_ORDER, "no frame");
  EXPECT(walr_get_release_state(denoiser, "dept", &state), WALR_ERROR_INVALID_ARGUMENT, "known images: lighting");

  const VkCommandBuffer commands = host_begin(host);
  const WalrFrame good = frame_of(&images);
  WalrFrame frame = good;
  EXPECT(walr_record(denoiser, commands, NULL), WALR_ERROR_INVALID_ARGUMENT, "WalrFrame is null");
  EXPECT(walr_record(denoiser, VK_NULL_HANDLE, &frame), WALR_ERROR_INVALID_ARGUMENT, "command buffer");
  frame.camera = NULL;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "camera is null");
  WalrCamera camera = kCamera;
  camera.view[3] = NAN;
  frame.camera = &camera;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "view is not finite");
  camera = kCamera;
  memset(camera.view, 0, sizeof(camera.view));
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "singular");
  camera = kCamera;
  camera.projection[5] *= -1;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "projection matrix has y down");
  camera = kCamera;
  memcpy(camera.projection, kCamera.view, sizeof(camera.projection));
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "WalrConventions::orthographic");
  frame = good;
  frame.sky_depth = -1;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "sky_depth");
  frame = good;
  frame.flags = 64;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "unknown bits");
  frame = good;
  frame.offset[1] = 1;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "WalrConventions::rectangle");
  frame = good;
  frame.light_offset[0] = 1;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "WalrConventions::light_group, 1 x 1");
  frame = good;
  frame.motion = NULL;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "image 'motion' is null");

  WalrImage image = images.image[1];
  frame = good;
  frame.depth = &image;
  image.struct_size = 4;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_STRUCT_SIZE, "sizeof(WalrImage)");
  image = images.image[1];
  image.image = VK_NULL_HANDLE;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "'depth' has a null VkImage");
  image = images.image[1];
  image.format = VK_FORMAT_R16_SFLOAT;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "made for R32_SFLOAT");
  image = images.image[1];
  image.width = 8;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "call walr_resize");
  image = images.image[1];
  image.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "walr_get_image_requirements");
  image = images.image[1];
  image.queue_family = host->queue_family + 1;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "transfer its ownership");
  image = images.image[1];
  image.acquire.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "no contents");
  frame = good;
  image = images.image[0];
  image.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  frame.denoised = &image;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "also the output");

  /* The denoiser still works after all these errors: record a frame, then one of another size while the first may still
   * be in flight. */
  EXPECT_OK(walr_record(denoiser, commands, &good));
  host_submit_and_wait(host, commands);
  follow(&images, denoiser);
  EXPECT_OK(walr_get_memory(denoiser, &memory));
  EXPECT_TRUE(memory.allocated >= memory.persistent + memory.transient && memory.retired == 0);
  EXPECT_TRUE(memory.transient_least <= memory.transient && memory.transient <= memory.transient_unaliased);
  uint32_t count = 0;
  EXPECT_OK(walr_get_timings(denoiser, &count, NULL));
  EXPECT(walr_get_timings(denoiser, NULL, NULL), WALR_ERROR_INVALID_ARGUMENT, "null");
  EXPECT(walr_get_findings(denoiser, &count, NULL), WALR_ERROR_WRONG_ORDER, "WalrDenoiserInfo::lint");
  WalrPassTime times[32];
  EXPECT_TRUE(count > 3 && count <= 32);
  EXPECT_OK(walr_get_timings(denoiser, &count, times));
  for (uint32_t i = 0; i < count; ++i) EXPECT_TRUE(times[i].name[0] != '\0' && times[i].milliseconds >= 0);

  EXPECT_OK(walr_resize(denoiser, kWidth / 2, kHeight));
  const VkCommandBuffer again = host_begin(host);
  EXPECT(walr_record(denoiser, again, &good), WALR_ERROR_INVALID_ARGUMENT, "call walr_resize");
  EXPECT_OK(walr_resize(denoiser, kWidth, kHeight));
  const WalrFrame next = frame_of(&images);
  EXPECT_OK(walr_record(denoiser, again, &next));
  EXPECT_OK(walr_get_memory(denoiser, &memory));
  EXPECT_TRUE(memory.retired > 0);
  host_submit_and_wait(host, again);
  follow(&images, denoiser);
  /* The second frame reads the history of the first, which is kept until the second has finished. */
  for (int i = 0; i < 2; ++i) {
    const VkCommandBuffer later = host_begin(host);
    EXPECT_OK(walr_record(denoiser, later, &next));
    host_submit_and_wait(host, later);
  }
  EXPECT_OK(walr_get_memory(denoiser, &memory));
  EXPECT_TRUE(memory.retired == 0);

  EXPECT(walr_forget_image(denoiser, VK_NULL_HANDLE, 0), WALR_ERROR_INVALID_ARGUMENT, "null");
  for (int i = 0; i < 6; ++i) {
    EXPECT_OK(walr_forget_image(denoiser, images.host[i].image, 0));
    host_destroy_image(host, &images.host[i]);
  }
}

/* A rectangle must lie within the images. */
static void test_rectangle(Host* host, const WalrDevice* device) {
  const WalrConventions conventions = {.struct_size = sizeof(conventions), .rectangle = VK_TRUE};
  WalrDenoiserInfo info = info_of(device);
  info.conventions = &conventions;
  WalrDenoiser denoiser = NULL;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  Images images = make_images(host, denoiser);
  EXPECT_OK(walr_resize(denoiser, kWidth - 2, kHeight - 1));
  const VkCommandBuffer commands = host_begin(host);
  WalrFrame frame = frame_of(&images);
  frame.offset[0] = 3;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "does not hold 62 x 47 from (3, 0) on");
  frame.offset[0] = UINT32_MAX;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "at most 16384");
  frame.offset[0] = 2;
  frame.offset[1] = 1;
  EXPECT_OK(walr_record(denoiser, commands, &frame));
  host_submit_and_wait(host, commands);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  for (int i = 0; i < 6; ++i) host_destroy_image(host, &images.host[i]);
}

/* A second thread calls while the first is inside a call. The first one's log callback shows that it is. */
typedef struct Intruder {
  WalrDenoiser denoiser;
  WalrResult prepare;
  WalrResult destroy;
  char text[128];
  int calls;
} Intruder;

/* A frame tells with a timeline semaphore when it is finished, although the device was created without the feature. */
static void test_completion(Host* host) {
  const VkPhysicalDeviceSynchronization2Features synchronization2 = {
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES, .synchronization2 = VK_TRUE};
  const VkPhysicalDeviceFeatures features = {.shaderStorageImageExtendedFormats = VK_TRUE};
  const VkDeviceCreateInfo created = {
      .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .pNext = &synchronization2, .pEnabledFeatures = &features};
  WalrDevice device = device_of(host);
  device.create_info = &created;
  const WalrDenoiserInfo info = info_of(&device);
  WalrDenoiser denoiser = NULL;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  Images images = make_images(host, denoiser);
  const VkSemaphoreTypeCreateInfo type = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                          .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
  const VkSemaphoreCreateInfo timeline = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
  VkSemaphore finished = VK_NULL_HANDLE;
  EXPECT_TRUE(vkCreateSemaphore(host->device, &timeline, NULL, &finished) == VK_SUCCESS);
  const VkCommandBuffer commands = host_begin(host);
  WalrFrame frame = frame_of(&images);
  frame.finished_value = 1;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "`finished` is null");
  frame.finished = finished;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_UNSUPPORTED, "without\n  feature timelineSemaphore");
  EXPECT_TRUE(vkEndCommandBuffer(commands) == VK_SUCCESS);
  EXPECT_OK(walr_destroy_denoiser(denoiser));

  device.create_info = &(VkDeviceCreateInfo){.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .pNext = &host->features};
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  const VkCommandBuffer again = host_begin(host);
  frame.finished_value = 0;
  EXPECT(walr_record(denoiser, again, &frame), WALR_ERROR_INVALID_ARGUMENT, "is 0, which no submission signals");
  frame.finished_value = 1;
  EXPECT_OK(walr_record(denoiser, again, &frame));
  host_submit_between(host, again, finished, 0, 1);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  vkDestroySemaphore(host->device, finished, NULL);
  for (int i = 0; i < 6; ++i) host_destroy_image(host, &images.host[i]);
}

/* A finding of a denoiser whose recorded frames were partly never submitted would be made of numbers that no frame
 * counted. */
static void test_dropped_frames(Host* host, const WalrDevice* device) {
  WalrDenoiserInfo info = info_of(device);
  info.lint = VK_TRUE;
  WalrDenoiser denoiser = NULL;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  Images images = make_images(host, denoiser);
  for (int i = 0; i < 4; ++i) {
    const VkCommandBuffer commands = host_begin(host);
    const WalrFrame frame = frame_of(&images);
    EXPECT_OK(walr_record(denoiser, commands, &frame));
    EXPECT_TRUE(vkEndCommandBuffer(commands) == VK_SUCCESS);
    vkFreeCommandBuffers(host->device, host->command_pool, 1, &commands);
  }
  uint32_t count = 1;
  EXPECT_OK(walr_get_findings(denoiser, &count, NULL));
  EXPECT_TRUE(count == 0);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  for (int i = 0; i < 6; ++i) host_destroy_image(host, &images.host[i]);
}

static int intrude(void* user) {
  Intruder* intruder = user;
  intruder->prepare = walr_prepare(intruder->denoiser);
  snprintf(intruder->text, sizeof(intruder->text), "%s", walr_last_error());
  intruder->destroy = walr_destroy_denoiser(intruder->denoiser);
  return 0;
}

static void on_log(void* user, WalrLogLevel level, const char* text) {
  (void)level;
  Intruder* intruder = user;
  if (intruder->denoiser == NULL || text[0] == '\0') return;
  ++intruder->calls;
  thrd_t thread;
  EXPECT_TRUE(thrd_create(&thread, intrude, intruder) == thrd_success);
  thrd_join(thread, NULL);
  EXPECT(walr_prepare(intruder->denoiser), WALR_ERROR_CONCURRENT_USE, "in use");
}

static void test_threads(const WalrDevice* device) {
  Intruder intruder = {0};
  WalrDenoiserInfo info = info_of(device);
  info.log = on_log;
  info.log_user = &intruder;
  WalrDenoiser denoiser = NULL;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  intruder.denoiser = denoiser;
  EXPECT_OK(walr_prepare(denoiser));
  EXPECT_TRUE(intruder.calls == 1);
  EXPECT_TRUE(intruder.prepare == WALR_ERROR_CONCURRENT_USE && intruder.destroy == WALR_ERROR_CONCURRENT_USE);
  EXPECT_TRUE(strstr(intruder.text, "in use") != NULL);
  EXPECT_OK(walr_prepare(denoiser));
  EXPECT_OK(walr_destroy_denoiser(denoiser));
}

int main(void) {
  Host host;
  host_open(&host);
  const WalrDevice device = device_of(&host);
  test_listing();
  test_device(&host);
  test_create(&device);
  test_sparse_light(&device);
  test_object_ids(&device);
  test_object_id_frames(&host, &device);
  test_handles(&device);
  WalrDenoiser denoiser = NULL;
  WalrDenoiserInfo info = info_of(&device);
  info.timestamps = VK_TRUE;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  test_settings(denoiser);
  test_frames(&host, denoiser);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  test_rectangle(&host, &device);
  test_completion(&host);
  test_dropped_frames(&host, &device);
  test_threads(&device);
  const int messages = host_close(&host);
  if (failures + messages > 0) fprintf(stderr, "%d failures, %d validation messages\n", failures, messages);
  return failures + messages > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
