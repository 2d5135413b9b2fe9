#include <windows.h>

#include <walr/walr_plugin.h>
#include <walr/walr.hpp>

/// Instantiates what the headers define.
WalrResult afterWindows(const WalrDenoiserInfo& info) {
  walr::cpp::Denoiser denoiser(info);
  walr::cpp::Denoiser moved(std::move(denoiser));
  moved.setSetting("filter.iterations", moved.setting("filter.iterations"));
  return moved.timings().empty() && walr::cpp::passTypes().empty() ? WALR_ERROR_INTERNAL : WALR_SUCCESS;
}
