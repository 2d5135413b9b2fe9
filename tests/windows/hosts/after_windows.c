#include <windows.h>

#include <walr/walr_plugin.h>

/* A function that uses the headers, because an empty source is none in C. */
WalrResult after_windows(const WalrApi* api, WalrDenoiser denoiser);
WalrResult after_windows(const WalrApi* api, WalrDenoiser denoiser) {
  return api->destroy_denoiser(denoiser);
}
