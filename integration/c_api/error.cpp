#include "integration/c_api/error.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

#include "framegraph/vulkan/error.h"

namespace walr::api {
namespace {

/// A fixed size, so that reporting an error cannot fail.
constexpr std::size_t kTextSize = 2048;
thread_local std::array<char, kTextSize> lastText{};

WalrResult fail(WalrResult result, const char* text) noexcept {
  const std::size_t length = std::min(std::strlen(text), kTextSize - 1);
  std::memcpy(lastText.data(), text, length);
  lastText[length] = '\0';
  return result;
}

}  // namespace

WalrResult translateException() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return fail(error.result(), error.what());
  } catch (const fg::vk::OutOfMemory& error) {
    return fail(WALR_ERROR_OUT_OF_MEMORY, error.what());
  } catch (const fg::vk::DeviceLost& error) {
    return fail(WALR_ERROR_DEVICE_LOST, error.what());
  } catch (const fg::vk::Unsupported& error) {
    return fail(WALR_ERROR_UNSUPPORTED, error.what());
  } catch (const fg::vk::PipelineFailed& error) {
    return fail(WALR_ERROR_UNSUPPORTED, error.what());
  } catch (const fg::vk::FrameInFlight& error) {
    return fail(WALR_ERROR_WRONG_ORDER, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(WALR_ERROR_INVALID_ARGUMENT, error.what());
  } catch (const std::bad_alloc&) {
    return fail(WALR_ERROR_OUT_OF_MEMORY, "the process is out of memory");
  } catch (const std::exception& error) {
    return fail(WALR_ERROR_INTERNAL, error.what());
  } catch (...) {
    return fail(WALR_ERROR_INTERNAL, "an exception of unknown kind");
  }
}

const char* lastError() noexcept {
  return lastText.data();
}

const char* resultName(WalrResult result) noexcept {
  switch (result) {
    case WALR_SUCCESS:
      return "WALR_SUCCESS";
    case WALR_ERROR_INVALID_ARGUMENT:
      return "WALR_ERROR_INVALID_ARGUMENT";
    case WALR_ERROR_INVALID_HANDLE:
      return "WALR_ERROR_INVALID_HANDLE";
    case WALR_ERROR_STRUCT_SIZE:
      return "WALR_ERROR_STRUCT_SIZE";
    case WALR_ERROR_CONCURRENT_USE:
      return "WALR_ERROR_CONCURRENT_USE";
    case WALR_ERROR_WRONG_ORDER:
      return "WALR_ERROR_WRONG_ORDER";
    case WALR_ERROR_UNSUPPORTED:
      return "WALR_ERROR_UNSUPPORTED";
    case WALR_ERROR_OUT_OF_MEMORY:
      return "WALR_ERROR_OUT_OF_MEMORY";
    case WALR_ERROR_DEVICE_LOST:
      return "WALR_ERROR_DEVICE_LOST";
    case WALR_ERROR_INTERNAL:
      return "WALR_ERROR_INTERNAL";
    default:
      return "a WalrResult of another version";
  }
}

}  // namespace walr::api
