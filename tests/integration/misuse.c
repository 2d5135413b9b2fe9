#include "misuse.h"

#include <stdio.h>
#include <string.h>

int failures = 0;

void expect(WalrResult got, WalrResult wanted, const char* text, const char* file, int line) {
  if (got == wanted && (wanted == WALR_SUCCESS || strstr(walr_last_error(), text) != NULL)) return;
  ++failures;
  fprintf(stderr, "%s:%d: expected %s with \"%s\", got %s with \"%s\"\n", file, line, walr_result_name(wanted), text,
          walr_result_name(got), walr_last_error());
}
void expect_true(bool holds, const char* condition, const char* file, int line) {
  if (holds) return;
  ++failures;
  fprintf(stderr, "%s:%d: not so: %s\n", file, line, condition);
}

WalrDevice device_of(const Host* host) {
  return (WalrDevice){.struct_size = sizeof(WalrDevice),
                      .queue_family = host->queue_family,
                      .instance = host->instance,
                      .physical_device = host->physical_device,
                      .device = host->device,
                      .get_instance_proc_addr = vkGetInstanceProcAddr};
}

WalrDenoiserInfo info_of(const WalrDevice* device) {
  return (WalrDenoiserInfo){
      .struct_size = sizeof(WalrDenoiserInfo), .device = device, .width = kWidth, .height = kHeight};
}

const WalrCamera kCamera = {.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                            .projection = {1.5F, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.1F, 0}};

static const char* const kNames[6] = {"lighting", "depth", "normal", "motion", "albedo", "denoised"};

Images make_images(Host* host, WalrDenoiser denoiser) {
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

void destroy_images(Host* host, Images* images) {
  for (int i = 0; i < 6; ++i) host_destroy_image(host, &images->host[i]);
}

WalrFrame frame_of(const Images* images) {
  return (WalrFrame){.struct_size = sizeof(WalrFrame),
                     .lighting = &images->image[0],
                     .depth = &images->image[1],
                     .normal = &images->image[2],
                     .motion = &images->image[3],
                     .albedo = &images->image[4],
                     .denoised = &images->image[5],
                     .camera = &kCamera};
}

void follow(Images* images, WalrDenoiser denoiser) {
  for (int i = 0; i < 6; ++i) {
    WalrImageState state;
    EXPECT_OK(walr_get_release_state(denoiser, kNames[i], &state));
    images->image[i].acquire = state;
    images->host[i].stage = state.stage;
    images->host[i].access = state.access;
    images->host[i].layout = state.layout;
  }
}
