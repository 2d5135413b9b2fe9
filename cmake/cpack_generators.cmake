# cpack reads this for each kind of package. TGZ holds the bundle, ZIP the library for Windows, Debian packages the components
# one by one.
if(CPACK_GENERATOR MATCHES "^(TGZ|ZIP)$")
  set(CPACK_PACKAGE_FILE_NAME "walr-${CPACK_PACKAGE_VERSION}-${CPACK_SYSTEM_NAME}")
  if(CPACK_GENERATOR STREQUAL "TGZ")
    set(CPACK_COMPONENTS_ALL bundle)
  endif()
  set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
  set(CPACK_PACKAGING_INSTALL_PREFIX /)
endif()
