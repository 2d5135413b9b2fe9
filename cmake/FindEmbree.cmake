# Finds Embree 4 (Ubuntu 24.04) or 3 (Debian 12) as the target Embree::Embree. The packages' own configuration files are
# not used, because they differ in name and dependencies. Only the header and the library are needed.
foreach(major 4 3)
  find_path(Embree_INCLUDE_DIR embree${major}/rtcore.h)
  if(Embree_INCLUDE_DIR)
    find_library(Embree_LIBRARY embree${major})
    break()
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Embree REQUIRED_VARS Embree_LIBRARY Embree_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install libembree-dev")
if(Embree_FOUND AND NOT TARGET Embree::Embree)
  add_library(Embree::Embree UNKNOWN IMPORTED)
  set_target_properties(Embree::Embree PROPERTIES
    IMPORTED_LOCATION "${Embree_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${Embree_INCLUDE_DIR}")
endif()
mark_as_advanced(Embree_INCLUDE_DIR Embree_LIBRARY)
