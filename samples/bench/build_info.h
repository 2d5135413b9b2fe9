#pragma once

#include <string>

namespace walr {

/// Where a program comes from.
struct BuildInfo {
  std::string commit;     ///< "1be0131c...", with "-dirty" where files were changed; "unknown" outside of a repository.
  std::string compiler;   ///< "GNU 12.2.0".
  std::string buildType;  ///< "RelWithDebInfo".
};

BuildInfo buildInfo();

}  // namespace walr
