#include "samples/bench/build_info.h"

#include "samples/bench/commit.h"

namespace walr {

BuildInfo buildInfo() {
  return {kCommit, WALR_COMPILER, WALR_BUILD_TYPE};
}

}  // namespace walr
