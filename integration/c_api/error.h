#pragma once

#include <stdexcept>
#include <string>

#include <walr/walr.h>

namespace walr::api {

/// An error with the code that the C API gives it.
class Error final : public std::runtime_error {
 public:
  Error(WalrResult result, const std::string& message) : std::runtime_error(message), result_(result) {}
  [[nodiscard]] WalrResult result() const { return result_; }

 private:
  WalrResult result_;
};

/// The exception being handled as a code; its text becomes the thread's last error. Call in a catch block.
WalrResult translateException() noexcept;

/// The thread's last error, with its terminating zero.
const char* lastError() noexcept;

const char* resultName(WalrResult result) noexcept;

/// Run the body of a C function: nothing is thrown out of it.
template <typename Action>
WalrResult guarded(Action&& action) noexcept {
  try {
    action();
    return WALR_SUCCESS;
  } catch (...) {
    return translateException();
  }
}

}  // namespace walr::api
