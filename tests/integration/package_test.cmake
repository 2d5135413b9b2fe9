# Installs walr to an empty folder, builds the project in package/ against it, and runs its programs under the validation
# layer with synchronization validation.
# cmake -DBUILD=... -DSTAGING=... -DSOURCE=... -DEMBEDDING=... -P package_test.cmake
function(run)
  cmake_parse_arguments(ARG "" "OUTPUT" "COMMAND" ${ARGN})
  execute_process(COMMAND ${ARG_COMMAND} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARG_COMMAND}: ${result}\n${output}\n${error}")
  endif()
  if(ARG_OUTPUT)
    set(${ARG_OUTPUT} "${output}${error}" PARENT_SCOPE)
  endif()
endfunction()

file(REMOVE_RECURSE "${STAGING}")
foreach(component IN ITEMS runtime dev cpp)
  run(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${STAGING}/usr" --strip --component ${component})
endforeach()
file(GLOB_RECURSE guides "${STAGING}/usr/ADAPTERS.md" "${STAGING}/usr/WALR.md")
list(LENGTH guides count)
if(NOT count EQUAL 2)
  message(FATAL_ERROR "the guides are not installed with the library: ${guides}")
endif()

# A host may name a header of the C API without its folder, so no other installed header has such a name.
file(GLOB api_headers "${STAGING}/usr/include/walr/*.h")
foreach(header IN LISTS api_headers)
  cmake_path(GET header FILENAME name)
  file(GLOB_RECURSE namesakes "${STAGING}/usr/include/${name}")
  if(NOT namesakes STREQUAL header)
    message(FATAL_ERROR "these headers have one name: ${namesakes}")
  endif()
endforeach()

run(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${STAGING}/build" -G Ninja "-DCMAKE_PREFIX_PATH=${STAGING}/usr"
  "-DWALR_EMBEDDING=${EMBEDDING}")
run(COMMAND "${CMAKE_COMMAND}" --build "${STAGING}/build")

# A host that opens the Vulkan loader by itself has Vulkan's headers, but no library to link to.
run(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}/without_loader" -B "${STAGING}/without_loader" -G Ninja
  "-DCMAKE_PREFIX_PATH=${STAGING}/usr" -DCMAKE_DISABLE_FIND_PACKAGE_Vulkan=ON)
run(COMMAND "${CMAKE_COMMAND}" --build "${STAGING}/without_loader")
run(COMMAND "${STAGING}/without_loader/version")
run(COMMAND "${STAGING}/without_loader/types")

set(ENV{VK_INSTANCE_LAYERS} VK_LAYER_KHRONOS_validation)
set(ENV{VK_LAYER_ENABLES} VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT)
foreach(program IN ITEMS c_shared c_static cpp_shared cpp_static)
  run(COMMAND "${STAGING}/build/${program}" OUTPUT said)
  if(NOT said MATCHES "^denoised 3 frames with walr [0-9.]+\n$")
    message(FATAL_ERROR "${program} said: ${said}")
  endif()
endforeach()
run(COMMAND "${STAGING}/build/cpp_libraries")

# Without CMake.
find_program(PKG_CONFIG pkg-config REQUIRED)
file(GLOB_RECURSE pc "${STAGING}/usr/walr.pc")
cmake_path(GET pc PARENT_PATH pc_dir)
set(ENV{PKG_CONFIG_PATH} "${pc_dir}")
run(COMMAND "${PKG_CONFIG}" --cflags --libs walr OUTPUT flags)
separate_arguments(flags UNIX_COMMAND "${flags}")
run(COMMAND "${PKG_CONFIG}" --variable=plugin walr OUTPUT plugin)
string(STRIP "${plugin}" plugin)
if(NOT EXISTS "${plugin}")
  message(FATAL_ERROR "pkg-config tells a plug-in that is not there: ${plugin}")
endif()
run(COMMAND cc -std=c11 "${EMBEDDING}" ${flags} -lvulkan -o "${STAGING}/c_pkg_config")
cmake_path(GET pc_dir PARENT_PATH lib_dir)
run(COMMAND "${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${lib_dir}" "${STAGING}/c_pkg_config")

# The guides and the files that they link to are installed.
foreach(guide IN ITEMS README.md ADAPTERS.md)
  set(folder "${STAGING}/usr/share/doc/walr/integration")
  file(READ "${folder}/${guide}" text)
  string(REGEX MATCHALL "\\([^()`:# ]+\\.(md|c|cpp)\\)" links "${text}")
  if(guide STREQUAL README.md AND NOT links)
    message(FATAL_ERROR "${guide} has no links")
  endif()
  foreach(link IN LISTS links)
    string(REGEX REPLACE "^.(.*).$" "\\1" target "${link}")
    if(NOT EXISTS "${folder}/${target}")
      message(FATAL_ERROR "${guide} leads to ${target}, which is not installed")
    endif()
  endforeach()
endforeach()

# Under 120 lines, as the README says.
file(READ "${EMBEDDING}" text)
string(REGEX MATCHALL "\n" ends "${text}")
list(LENGTH ends count)
if(NOT count LESS 120)
  message(FATAL_ERROR "${EMBEDDING} has ${count} lines")
endif()
