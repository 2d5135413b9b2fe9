# Makes the archive for Windows by the command of integration/docs/windows.md, unpacks it in an empty folder, and builds hosts
# against it.
# cmake -DSOURCE=... -DSTAGING=... -DVULKAN_LOADER=... -DGOOGLETEST=... -P make_hosts.cmake
cmake_policy(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output
    WORKING_DIRECTORY "${SOURCE}")
  if(NOT result EQUAL 0 OR output MATCHES "[^\n]*warning: ")
    message(FATAL_ERROR "${ARGV}: ${result}\n${output}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --workflow --preset windows)
file(REMOVE_RECURSE "${STAGING}/unpacked")
file(GLOB archive "${SOURCE}/build-windows/walr-*-windows-x86_64.zip")
file(ARCHIVE_EXTRACT INPUT "${archive}" DESTINATION "${STAGING}/unpacked")
file(GLOB root "${STAGING}/unpacked/walr-*")

run("${CMAKE_COMMAND}" -S "${SOURCE}/tests/windows/hosts" -B "${STAGING}/hosts" -G Ninja
  "-DCMAKE_TOOLCHAIN_FILE=${SOURCE}/cmake/mingw-w64.cmake" "-DCMAKE_FIND_ROOT_PATH=${root}" -DCMAKE_BUILD_TYPE=Release
  "-DVULKAN_LOADER=${VULKAN_LOADER}" "-DGOOGLETEST=${GOOGLETEST}")
run("${CMAKE_COMMAND}" --build "${STAGING}/hosts")
