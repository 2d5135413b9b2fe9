// The C++ header needs no other standard than C++17 and nothing but walr's headers.
#include <walr/walr.hpp>

int main() {
  const walr::cpp::Denoiser none;
  try {
    (void)none.memory();
  } catch (const walr::cpp::Error& error) {
    return error.result() == WALR_ERROR_INVALID_HANDLE && !walr::cpp::passTypes().empty() ? 0 : 1;
  }
  return 1;
}
