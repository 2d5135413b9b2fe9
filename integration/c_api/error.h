#pragma once

#include <stdexcept>
#include <string>

#include <walr/walr.h>

namespace walr::api {

/// An error with its code in the C API.
class Error final : public std::runtime_error {
 public:
  Error(WalrResult result, const std::string& message) : std::runtime_error(message), result_(result) {}
  [[nodiscard]] WalrResult result() const { return result_; }

 private:
  WalrResult result_;
};

/// Convert the exception that is being handled to a code and store its text as the thread's last error. Call it in a
/// catch block.
WalrResult translateException() noexcept;

/// The thread's last error, with its terminating zero.
const char* lastError() noexcept;

const char* resultName(WalrResult result) noexcept;

/// Run the body of a C function and convert exceptions to codes.
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
