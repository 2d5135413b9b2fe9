# Install rules. Components: runtime (shared library, plug-in), dev (headers, static library,
# CMake and pkg-config files, guides), cpp (the C++ libraries with their headers), and tools (the program walr). `cpack`
# makes Debian packages of them.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/walr")

install(TARGETS walr_shared EXPORT walr-shared
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT dev)
install(TARGETS walr_static EXPORT walr-static ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
install(TARGETS walr_plugin LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/walr" COMPONENT runtime)
install(DIRECTORY integration/include/walr DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev)

install(TARGETS walr_framegraph walr_framegraph_vulkan walr_shaders walr_passes walr_integration
  EXPORT walr-cpp ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT cpp)
foreach(folder IN ITEMS framegraph/declare framegraph/plan framegraph/check framegraph/compile framegraph/verify
    framegraph/inspect framegraph/vulkan passes shaders/constants integration)
  file(GLOB headers CONFIGURE_DEPENDS "${folder}/*.h")
  install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/walr/${folder}" COMPONENT cpp)
endforeach()

foreach(part IN ITEMS shared static cpp)
  set(component dev)
  if(part STREQUAL "cpp")
    set(component cpp)
  endif()
  install(EXPORT walr-${part} NAMESPACE walr:: DESTINATION "${package_dir}" COMPONENT ${component})
endforeach()
configure_package_config_file(cmake/walrConfig.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/walrConfig.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/walrConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
file(RELATIVE_PATH WALR_PC_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(cmake/walr.pc.in "${CMAKE_CURRENT_BINARY_DIR}/walr.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/walrConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/walrConfigVersion.cmake"
  DESTINATION "${package_dir}" COMPONENT dev)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/walr.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)
# The guides are installed in the folders of the source tree, so that links between them work. The documentation of the
# headers is installed if the target docs has been built.
install(FILES integration/README.md integration/ADAPTERS.md DESTINATION "${CMAKE_INSTALL_DOCDIR}/integration" COMPONENT dev)
install(FILES passes/WALR.md passes/WALR_EXPERIMENTS.md passes/GLOSSARY.md passes/BIBLIOGRAPHY.md
  DESTINATION "${CMAKE_INSTALL_DOCDIR}/passes" COMPONENT dev)
install(FILES passes/images/walr.svg DESTINATION "${CMAKE_INSTALL_DOCDIR}/passes/images" COMPONENT dev)
install(FILES samples/embedding/embedding.c DESTINATION "${CMAKE_INSTALL_DOCDIR}/samples/embedding" COMPONENT dev)
install(FILES samples/README.md DESTINATION "${CMAKE_INSTALL_DOCDIR}/samples" COMPONENT dev)
install(DIRECTORY samples/docs DESTINATION "${CMAKE_INSTALL_DOCDIR}/samples" COMPONENT dev FILES_MATCHING PATTERN "*.md")
install(DIRECTORY "${CMAKE_BINARY_DIR}/docs/html" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT dev OPTIONAL)
if(TARGET walr)
  install(TARGETS walr RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tools)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "walr")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime dev cpp)
if(TARGET walr)
  list(APPEND CPACK_COMPONENTS_ALL tools)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME "libwalr${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libwalr-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "${CPACK_DEBIAN_RUNTIME_PACKAGE_NAME} (= ${PROJECT_VERSION}), libvulkan-dev")
set(CPACK_DEBIAN_CPP_PACKAGE_NAME libwalr-cpp-dev)
set(CPACK_DEBIAN_CPP_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_CPP_PACKAGE_DEPENDS "libwalr-dev (= ${PROJECT_VERSION}), libglm-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME walr-tools)
include(CPack)
