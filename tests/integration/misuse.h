/* What the tests of misuse share: expectations, and a denoiser's description and images. */
#ifndef WALR_TESTS_MISUSE_H
#define WALR_TESTS_MISUSE_H

#include <walr/walr.h>

#include "host/vulkan_host.h"

enum { kWidth = 64, kHeight = 48 };

extern int failures;

void expect(WalrResult got, WalrResult wanted, const char* text, const char* file, int line);
#define EXPECT(call, wanted, text) expect((call), (wanted), (text), __FILE__, __LINE__)
#define EXPECT_OK(call) expect((call), WALR_SUCCESS, "", __FILE__, __LINE__)
void expect_true(bool holds, const char* condition, const char* file, int line);
#define EXPECT_TRUE(condition) expect_true((condition), #condition, __FILE__, __LINE__)

WalrDevice device_of(const Host* host);
WalrDenoiserInfo info_of(const WalrDevice* device);
extern const WalrCamera kCamera;

/* The host's images of a frame. */
typedef struct Images {
  HostImage host[6];
  WalrImage image[6];
} Images;

Images make_images(Host* host, WalrDenoiser denoiser);
void destroy_images(Host* host, Images* images);
WalrFrame frame_of(const Images* images);
/* After a frame the images are in their release states. */
void follow(Images* images, WalrDenoiser denoiser);

/* One for each file. */
void test_descriptions(Host* host, const WalrDevice* device);
void test_objects(const WalrDevice* device);
void test_frames(Host* host, const WalrDevice* device);

#endif
