/* Wrong handles and settings, and calls from two threads. */
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "misuse.h"

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
  EXPECT(walr_get_setting(denoiser, "blocks.coarse-narrowing", value, &size), WALR_ERROR_INVALID_ARGUMENT,
         "needs 4 bytes");
  EXPECT_TRUE(size == strlen("0.6") + 1);
  EXPECT_OK(walr_get_setting(denoiser, "blocks.coarse-narrowing", value, &size));
  EXPECT_TRUE(strcmp(value, "0.6") == 0);
  EXPECT(walr_get_setting(denoiser, "magic", value, &size), WALR_ERROR_INVALID_ARGUMENT, "\"magic\"");
  EXPECT(walr_resize(denoiser, 0, 1), WALR_ERROR_INVALID_ARGUMENT, "0 x 1");
  /* Settings that contradict each other are reported when they are first used, and can be corrected. */
  EXPECT_OK(walr_set_setting(denoiser, "blocks.plane-near", "0.5"));
  EXPECT(walr_prepare(denoiser), WALR_ERROR_INVALID_ARGUMENT, "blocks.plane-near must be below blocks.plane-far");
  EXPECT_OK(walr_set_setting(denoiser, "blocks.plane-near", "0.0015"));
}

/* A second thread calls while the first is inside a call. The first one's log callback shows that it is. */
typedef struct Intruder {
  WalrDenoiser denoiser;
  WalrResult prepare;
  WalrResult destroy;
  char text[128];
  int calls;
} Intruder;

static void* intrude(void* user) {
  Intruder* intruder = user;
  intruder->prepare = walr_prepare(intruder->denoiser);
  snprintf(intruder->text, sizeof(intruder->text), "%s", walr_last_error());
  intruder->destroy = walr_destroy_denoiser(intruder->denoiser);
  return NULL;
}

static void on_log(void* user, WalrLogLevel level, const char* text) {
  (void)level;
  Intruder* intruder = user;
  if (intruder->denoiser == NULL || text[0] == '\0') return;
  ++intruder->calls;
  pthread_t thread;
  EXPECT_TRUE(pthread_create(&thread, NULL, intrude, intruder) == 0);
  pthread_join(thread, NULL);
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

void test_objects(const WalrDevice* device) {
  test_handles(device);
  WalrDenoiser denoiser = NULL;
  const WalrDenoiserInfo info = info_of(device);
  EXPECT_OK(walr_create_denoiser(&info, &denoiser));
  test_settings(denoiser);
  EXPECT_OK(walr_destroy_denoiser(denoiser));
  test_threads(device);
}
