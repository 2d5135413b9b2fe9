# Toolchain file: builds for 64-bit Windows with MinGW-w64 on Debian or Ubuntu (package g++-mingw-w64-x86-64-posix).
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
# The variant with POSIX threads has the C++ standard library's threads.
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

# MinGW's runtime libraries become part of what is linked, so that no DLL but the system's is needed.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -static)
set(CMAKE_MODULE_LINKER_FLAGS_INIT -static)

# The headers of Vulkan, GLM and JSON for Modern C++ are the same for every system. MinGW must not search all of /usr/include
# for them, because its C headers are others, so they get a folder of their own. The packages' CMake files name /usr/include:
# cmake/headers/ has others in their place.
get_property(trying GLOBAL PROPERTY IN_TRY_COMPILE)
if(NOT trying)
  set(headers "${CMAKE_BINARY_DIR}/headers")
  file(MAKE_DIRECTORY "${headers}/include")
  foreach(folder IN ITEMS vulkan vk_video glm nlohmann)
    if(NOT EXISTS "/usr/include/${folder}")
      message(FATAL_ERROR "/usr/include/${folder} is missing: install libvulkan-dev, libglm-dev and nlohmann-json3-dev.")
    endif()
    file(CREATE_LINK "/usr/include/${folder}" "${headers}/include/${folder}" SYMBOLIC)
  endforeach()
  list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}/headers")
endif()
list(APPEND CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32 "${headers}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
