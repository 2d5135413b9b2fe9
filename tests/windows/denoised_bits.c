/* Denoises a fixed sequence by every method with every preset, and writes the texels of all frames to FOLDER, a file
 * for each: METHOD.PRESET. Its inputs have the same bits wherever it runs: no function of the C library computes them.
 *
 *   denoised_bits FOLDER            by the library that it is linked to
 *   denoised_bits FOLDER PLUG-IN    by a plug-in */
#include <stdio.h>
#include <stdlib.h>

#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

enum { kWidth = 53, kHeight = 37, kFrames = 8, kImages = 6, kOutput = 5 };
static const char* const kNames[kImages] = {"lighting", "depth", "normal", "motion", "albedo", "denoised"};
static const float kStep = 0.0625F; /* The camera's movement to the right per frame, in scene units. */
static const float kFocal = 1.5F;

static const WalrApi* api = NULL;

static void fail(const char* what, const char* why) {
  fprintf(stderr, "%s: %s\n", what, why);
  exit(EXIT_FAILURE);
}
static void check(WalrResult result, const char* what) {
  if (result != WALR_SUCCESS) fail(what, api->last_error());
}

static VkBool32 take_api(void* user, const WalrApi* given) {
  (void)user;
  api = given;
  return VK_TRUE;
}

static void load(const char* path) {
#ifdef _WIN32
  const HMODULE library = LoadLibraryA(path);
  if (library == NULL) fail(path, "LoadLibrary failed");
  const WalrRegisterPlugin enter = (WalrRegisterPlugin)(void*)GetProcAddress(library, "walr_register_plugin");
#else
  void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) fail(path, dlerror());
  WalrRegisterPlugin enter = NULL;
  *(void**)(&enter) = dlsym(library, "walr_register_plugin");
#endif
  if (enter == NULL) fail(path, "it has no function walr_register_plugin");
  const WalrRegistryHost host = {.struct_size = sizeof(host), .register_api = take_api};
  if (enter(&host) != WALR_SUCCESS || api == NULL) fail(path, "it does not register");
  if (api->struct_size != sizeof(WalrApi)) fail(path, "its table of functions is of another version");
}

/* A wall that leans back, and a nearer square before it, seen by a camera that moves to the right. */
static void fill(int port, int frame, float* texels) {
  const float camera = kStep * (float)frame;
  uint32_t random = 12345U + 977U * (uint32_t)frame;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x, texels += 4) {
      const float u = ((float)x + 0.5F) / kWidth * 2.0F - 1.0F;
      const float v = ((float)y + 0.5F) / kHeight * 2.0F - 1.0F;
      const float square = u * 3.0F / kFocal + camera; /* Where the ray meets the plane of the square. */
      const bool is_near = square > -0.75F && square < 0.75F && v > -0.5F && v < 0.5F;
      const float depth = is_near ? 3.0F : 6.0F + 0.5F * v;
      const float across = u * depth / kFocal + camera;
      float light[3];
      for (int c = 0; c < 3; ++c) { /* Three of four samples meet no light. */
        random = random * 1664525U + 1013904223U;
        const float sample = (float)(random >> 8) / 16777216.0F;
        light[c] = (is_near ? 0.5F : 1.25F + 0.5F * u) * (sample < 0.25F ? 32.0F * sample : 0.0F);
      }
      texels[0] = texels[1] = texels[2] = texels[3] = 0.0F;
      switch (port) {
        case 0:
          for (int c = 0; c < 3; ++c) texels[c] = light[c];
          break;
        case 1:
          texels[0] = depth;
          break;
        case 2:
          texels[1] = is_near ? 0.0F : 0.6F;
          texels[2] = is_near ? 1.0F : 0.8F;
          break;
        case 3: /* A point at depth d moves by focal * step / d times half the image's width. */
          texels[0] = kFocal * kStep / depth * 0.5F * kWidth;
          break;
        default: /* A wall of boards. */
          for (int c = 0; c < 3; ++c) texels[c] = ((int)((across + 16.0F) * 4.0F) & 1) != 0 ? 0.75F : 0.25F;
      }
    }
  }
}

static void denoise(Host* host, const WalrDevice* device, const char* method, const char* preset, FILE* file) {
  static float texels[kWidth * kHeight * 4];
  static uint16_t denoised[kWidth * kHeight * 4];
  /* Inputs of 32-bit floats with four channels, so that this program converts nothing. */
  const WalrDenoiserInfo info = {.struct_size = sizeof(info),
                                 .device = device,
                                 .method = method,
                                 .preset = preset,
                                 .width = kWidth,
                                 .height = kHeight,
                                 .lighting_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                 .depth_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                 .normal_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                 .motion_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                 .albedo_format = VK_FORMAT_R32G32B32A32_SFLOAT};
  WalrDenoiser denoiser = NULL;
  check(api->create_denoiser(&info, &denoiser), method);
  HostImage images[kImages];
  for (int i = 0; i < kImages; ++i) {
    WalrImageRequirements needs = {.struct_size = sizeof(needs)};
    check(api->get_image_requirements(denoiser, kNames[i], &needs), kNames[i]);
    images[i] = host_make_image(host, needs.format, kWidth, kHeight, needs.usage | VK_IMAGE_USAGE_SAMPLED_BIT);
  }
  for (int number = 0; number < kFrames; ++number) {
    WalrCamera camera = {.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -kStep * (float)number, 0, 0, 1},
                         .projection = {kFocal, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.125F, 0}};
    WalrImage given[kImages];
    for (int i = 0; i < kImages; ++i) {
      HostImage* const image = &images[i];
      if (i != kOutput) {
        fill(i, number, texels);
        host_upload(host, image, texels);
      }
      given[i] = (WalrImage){.struct_size = sizeof(WalrImage),
                             .queue_family = VK_QUEUE_FAMILY_IGNORED,
                             .image = image->image,
                             .format = image->format,
                             .usage = image->usage,
                             .width = kWidth,
                             .height = kHeight,
                             .acquire = {image->stage, image->access, image->layout, 0}};
    }
    const WalrFrame frame = {.struct_size = sizeof(frame),
                             .lighting = &given[0],
                             .depth = &given[1],
                             .normal = &given[2],
                             .motion = &given[3],
                             .albedo = &given[4],
                             .denoised = &given[kOutput],
                             .camera = &camera};
    const VkCommandBuffer commands = host_begin(host);
    check(api->record(denoiser, commands, &frame), method);
    host_submit_and_wait(host, commands);
    for (int i = 0; i < kImages; ++i) {
      WalrImageState state;
      if (api->get_release_state(denoiser, kNames[i], &state) != WALR_SUCCESS) continue; /* Unused. */
      images[i].stage = state.stage;
      images[i].access = state.access;
      images[i].layout = state.layout;
    }
    host_download(host, &images[kOutput], denoised);
    if (fwrite(denoised, sizeof(denoised), 1, file) != 1) fail(method, "its result cannot be written");
  }
  check(api->destroy_denoiser(denoiser), method);
  for (int i = 0; i < kImages; ++i) host_destroy_image(host, &images[i]);
}

int main(int count, char** arguments) {
  if (count != 2 && count != 3) fail(arguments[0], "usage: denoised_bits FOLDER [PLUG-IN]");
  const WalrApi linked = {.struct_size = sizeof(linked),
                          .last_error = walr_last_error,
                          .pass_type_count = walr_pass_type_count,
                          .pass_type = walr_pass_type,
                          .create_denoiser = walr_create_denoiser,
                          .destroy_denoiser = walr_destroy_denoiser,
                          .get_image_requirements = walr_get_image_requirements,
                          .get_release_state = walr_get_release_state,
                          .record = walr_record};
  api = &linked;
  if (count == 3) load(arguments[2]);

  Host host;
  host_open(&host);
  const WalrDevice device = {.struct_size = sizeof(device),
                             .queue_family = host.queue_family,
                             .instance = host.instance,
                             .physical_device = host.physical_device,
                             .device = host.device,
                             .get_instance_proc_addr = vkGetInstanceProcAddr};
  for (uint32_t i = 0; i < api->pass_type_count(); ++i) {
    const WalrPassType* const type = api->pass_type(i);
    if (type->method == VK_FALSE) continue;
    /* A method without presets has its default settings alone. */
    for (uint32_t p = 0; p == 0 || p < type->preset_count; ++p) {
      const char* const preset = type->preset_count > 0 ? type->presets[p] : NULL;
      char path[1024];
      snprintf(path, sizeof(path), "%s/%s.%s", arguments[1], type->name, preset != NULL ? preset : "default");
      FILE* const file = fopen(path, "wb");
      if (file == NULL) fail(path, "it cannot be written");
      denoise(&host, &device, type->name, preset, file);
      if (fclose(file) != 0) fail(path, "it cannot be written");
    }
  }
  return host_close(&host) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
