#pragma once

#include <string>

namespace walr {

/// Commit, compiler and build type of this program.
struct BuildInfo {
  std::string commit;     ///< "1be0131c...", with "-dirty" if files were changed; "unknown" outside of a repository.
  std::string compiler;   ///< For example "GNU 12.2.0".
  std::string buildType;  ///< For example "RelWithDebInfo".
};

BuildInfo buildInfo();

}  // namespace walr
