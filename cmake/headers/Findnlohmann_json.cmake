# Finds the headers of JSON for Modern C++ as the target nlohmann_json::nlohmann_json, for toolchain files whose packages'
# CMake files name a folder that must not be searched (../mingw-w64.cmake).
find_path(nlohmann_json_INCLUDE_DIR nlohmann/json.hpp)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(nlohmann_json REQUIRED_VARS nlohmann_json_INCLUDE_DIR REASON_FAILURE_MESSAGE "install nlohmann-json3-dev")
if(nlohmann_json_FOUND AND NOT TARGET nlohmann_json::nlohmann_json)
  add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
  set_target_properties(nlohmann_json::nlohmann_json PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${nlohmann_json_INCLUDE_DIR}")
endif()
mark_as_advanced(nlohmann_json_INCLUDE_DIR)
