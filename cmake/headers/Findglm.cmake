# Finds the headers of GLM as the target glm::glm, for toolchain files whose packages' CMake files name a folder that
# must not be searched (../mingw-w64.cmake).
find_path(glm_INCLUDE_DIR glm/glm.hpp)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(glm REQUIRED_VARS glm_INCLUDE_DIR REASON_FAILURE_MESSAGE "install libglm-dev")
if(glm_FOUND AND NOT TARGET glm::glm)
  add_library(glm::glm INTERFACE IMPORTED)
  set_target_properties(glm::glm PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${glm_INCLUDE_DIR}")
endif()
mark_as_advanced(glm_INCLUDE_DIR)
