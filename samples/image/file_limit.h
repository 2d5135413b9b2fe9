#pragma once

#include <cstdint>
#include <string_view>

namespace walr {

/// The most of something that a file may have.
struct FileLimit {
  std::int64_t most;
  std::string_view of;
};

}  // namespace walr
