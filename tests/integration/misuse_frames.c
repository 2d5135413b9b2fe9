/* Wrong frames: cameras, images, rectangles, semaphores, and frames that are never submitted. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "misuse.h"

static void test_images(Host* host, const WalrDevice* device) {
  WalrDenoiser denoiser = NULL;
  WalrDenoiserInfo info = info_of(device);
  info.timestamps = VK_TRUE;
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
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
#define REFUSED(text, ...)                                                              \
  do {                                                                                  \
    frame = good;                                                                       \
    __VA_ARGS__;                                                                        \
    EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, text); \
  } while (0)
  REFUSED("camera is null", frame.camera = NULL);
  WalrCamera camera;
#define CAMERA(change) camera = kCamera, frame.camera = &camera, change
  REFUSED("view is not finite", CAMERA(camera.view[3] = NAN));
  REFUSED("singular", CAMERA(memset(camera.view, 0, sizeof(camera.view))));
  REFUSED("projection matrix has y down", CAMERA(camera.projection[5] *= -1));
  REFUSED("WalrConventions::orthographic", CAMERA(memcpy(camera.projection, kCamera.view, sizeof(camera.projection))));
#undef CAMERA
  REFUSED("sky_depth", frame.sky_depth = -1);
  REFUSED("unknown bits", frame.flags = 64);
  REFUSED("WalrConventions::rectangle", frame.offset[1] = 1);
  REFUSED("WalrConventions::light_group, 1 x 1", frame.light_offset[0] = 1);
  REFUSED("image 'motion' is null", frame.motion = NULL);
  WalrImage image;
#define DEPTH(change) image = images.image[1], frame.depth = &image, change
  REFUSED("'depth' has a null VkImage", DEPTH(image.image = VK_NULL_HANDLE));
  REFUSED("made for R32_SFLOAT", DEPTH(image.format = VK_FORMAT_R16_SFLOAT));
  REFUSED("call walr_resize", DEPTH(image.width = 8));
  REFUSED("walr_get_image_requirements", DEPTH(image.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT));
  REFUSED("transfer its ownership", DEPTH(image.queue_family = host->queue_family + 1));
  REFUSED("no contents", DEPTH(image.acquire.layout = VK_IMAGE_LAYOUT_UNDEFINED));
  DEPTH(image.struct_size = 4);
#undef DEPTH
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_STRUCT_SIZE, "sizeof(WalrImage)");
  frame = good;
  frame.reserved = 1;
  EXPECT(walr_record(denoiser, commands, &frame), WALR_ERROR_STRUCT_SIZE, "does not know");
  image = images.image[0];
  image.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  REFUSED("also the output", frame.denoised = &image);
  REFUSED("image 'history_length', which the denoiser does not write", frame.history_length = &images.image[0]);
  REFUSED("walr_set_view", frame.view = &images.image[0]);

  /* The denoiser still works after all these errors: record a frame, then one of another size while the first may still
   * be in flight. */
  EXPECT_OK(walr_record(denoiser, commands, &good));
  host_submit_and_wait(host, commands);
  follow(&images, denoiser);
  EXPECT_OK(walr_get_memory(denoiser, &memory));
  EXPECT_TRUE(memory.allocated >= memory.persistent + memory.transient && memory.retired == 0);
  EXPECT_TRUE(memory.transient_least <= memory.transient && memory.transient <= memory.transient_unaliased);
  uint32_t count = 0;
  EXPECT(walr_get_timings(denoiser, NULL, NULL), WALR_ERROR_INVALID_ARGUMENT, "null");
  EXPECT(walr_get_findings(denoiser, &count, NULL), WALR_ERROR_WRONG_ORDER, "WalrDenoiserInfo::lint");

  EXPECT_OK(walr_resize(denoiser, kWidth / 2, kHeight));
  EXPECT_OK(walr_prepare(denoiser));
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
  EXPECT_OK(walr_get_timings(denoiser, &count, NULL));
  WalrPassTime times[32];
  EXPECT_TRUE(count > 3 && count <= 32);
  EXPECT_OK(walr_get_timings(denoiser, &count, times));
  for (uint32_t i = 0; i < count; ++i) EXPECT_TRUE(times[i].name[0] != '\0' && times[i].milliseconds >= 0);

  EXPECT(walr_forget_image(denoiser, VK_NULL_HANDLE, 0), WALR_ERROR_INVALID_ARGUMENT, "null");
  for (int i = 0; i < 6; ++i) {
    EXPECT_OK(walr_forget_image(denoiser, images.host[i].image, 0));
    host_destroy_image(host, &images.host[i]);
  }
  EXPECT_OK(walr_destroy_denoiser(denoiser));
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
  destroy_images(host, &images);
}

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
  destroy_images(host, &images);
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
  destroy_images(host, &images);
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
  destroy_images(host, &images);
}

/* Frames of two lights, and of a caller who has forgotten the second. */
static void test_second_lights(Host* host, const WalrDevice* device) {
  WalrDenoiserInfo info = info_of(device);
  WalrDenoiser one = NULL;
  WalrDenoiser both = NULL;
  EXPECT_OK(walr_create_denoiser(&info, &one));
  info.light_count = 2;
  EXPECT_OK(walr_create_denoiser(&info, &both));
  Images images = make_images(host, one);
  Images second = make_images(host, both);
  const VkCommandBuffer commands = host_begin(host);
  WalrFrame frame = frame_of(&images);
  EXPECT(walr_record(both, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "image 'second_lighting' is null");
  frame.second_lighting = &second.image[0];
  EXPECT(walr_record(both, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "image 'second_denoised' is null");
  EXPECT(walr_record(one, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "light_count of 2");
  frame.second_denoised = &images.image[5];
  EXPECT(walr_record(both, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "'denoised' is also the output");
  frame.second_denoised = &second.image[5];
  frame.struct_size = offsetof(WalrFrame, second_lighting);
  EXPECT(walr_record(both, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "image 'second_lighting' is null");
  frame.struct_size = sizeof(frame);
  EXPECT_OK(walr_record(both, commands, &frame));
  host_submit_and_wait(host, commands);
  WalrImageState state;
  EXPECT_OK(walr_get_release_state(both, "second_denoised", &state));
  EXPECT_TRUE(state.layout == VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_OK(walr_destroy_denoiser(both));
  EXPECT_OK(walr_destroy_denoiser(one));
  destroy_images(host, &images);
  destroy_images(host, &second);
}

/* Frames of specular light, and of a caller who has forgotten its images or that it is specular. */
static void test_specular_frames(Host* host, const WalrDevice* device) {
  WalrDenoiserInfo info = info_of(device);
  info.method = "accumulate";
  WalrDenoiser diffuse = NULL;
  WalrDenoiser specular = NULL;
  EXPECT_OK(walr_create_denoiser(&info, &diffuse));
  info.light_kind = WALR_LIGHT_SPECULAR;
  info.roughness_format = VK_FORMAT_R16G16B16A16_SFLOAT; /* So that one of the six images can be it. */
  EXPECT_OK(walr_create_denoiser(&info, &specular));
  Images images = make_images(host, diffuse);
  const VkCommandBuffer commands = host_begin(host);
  WalrFrame frame = frame_of(&images);
  EXPECT(walr_record(specular, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "image 'specular_albedo' is null");
  frame.specular_albedo = &images.image[4];
  EXPECT(walr_record(specular, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "image 'roughness' is null");
  EXPECT(walr_record(diffuse, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "'specular_albedo', but no light is");
  frame.specular_albedo = NULL;
  frame.roughness = &images.image[4];
  EXPECT(walr_record(diffuse, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "light_kind of WALR_LIGHT_SPECULAR");
  frame.specular_albedo = &images.image[4];
  frame.struct_size = offsetof(WalrFrame, specular_albedo);
  EXPECT(walr_record(specular, commands, &frame), WALR_ERROR_INVALID_ARGUMENT, "image 'specular_albedo' is null");
  EXPECT_OK(walr_record(diffuse, commands, &frame));
  host_submit_and_wait(host, commands);
  follow(&images, diffuse);
  frame.struct_size = sizeof(frame);
  const VkCommandBuffer again = host_begin(host);
  EXPECT_OK(walr_record(specular, again, &frame));
  host_submit_and_wait(host, again);
  EXPECT_OK(walr_destroy_denoiser(specular));
  EXPECT_OK(walr_destroy_denoiser(diffuse));
  destroy_images(host, &images);
}

void test_frames(Host* host, const WalrDevice* device) {
  test_images(host, device);
  test_object_id_frames(host, device);
  test_rectangle(host, device);
  test_second_lights(host, device);
  test_specular_frames(host, device);
  test_completion(host);
  test_dropped_frames(host, device);
}
