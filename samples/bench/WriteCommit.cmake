# cmake -DGIT=<git> -DSOURCE=<folder> -DHEADER=<file> -P WriteCommit.cmake
# Writes a header with the commit of the source tree. The file is touched only if the commit has changed.
set(commit "unknown")
if(GIT)
  execute_process(COMMAND "${GIT}" describe --always --abbrev=12 --dirty --exclude=* WORKING_DIRECTORY "${SOURCE}"
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit "${described}")
  endif()
endif()
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT [[#pragma once

namespace walr {

inline constexpr const char* kCommit = "@commit@";

}  // namespace walr
]])
