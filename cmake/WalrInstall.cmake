# Install rules. Components: runtime (shared library, plug-in), dev (headers, static library,
# CMake and pkg-config files, guides), cpp (the C++ libraries with their headers), and tools (the program walr). `cpack`
# makes Debian packages of them, or one ZIP archive for Windows. `cpack -G TGZ` makes an archive of the component bundle
# (WalrBundle.cmake).
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/walr")

install(TARGETS walr_shared EXPORT walr-shared
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT runtime
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT dev
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
install(TARGETS walr_plugin LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/walr" COMPONENT runtime)
install(DIRECTORY integration/include/walr DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev)

set(parts shared)
if(WALR_STATIC_LIBRARIES)
  list(APPEND parts static cpp)
  install(TARGETS walr_static EXPORT walr-static ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
  install(TARGETS walr_framegraph walr_framegraph_vulkan walr_shaders walr_passes walr_integration
    EXPORT walr-cpp ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT cpp)
  foreach(folder IN ITEMS framegraph/declare framegraph/plan framegraph/check framegraph/compile framegraph/verify
      framegraph/inspect framegraph/vulkan passes/* shaders/* integration)
    file(GLOB headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}" "${folder}/*.h")
    foreach(header IN LISTS headers)
      cmake_path(GET header PARENT_PATH place)
      install(FILES ${header} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/walr/${place}" COMPONENT cpp)
    endforeach()
  endforeach()
endif()

foreach(part IN LISTS parts)
  set(component dev)
  if(part STREQUAL "cpp")
    set(component cpp)
  endif()
  install(EXPORT walr-${part} NAMESPACE walr:: DESTINATION "${package_dir}" COMPONENT ${component})
endforeach()
set(WALR_PLUGIN_PATH "${CMAKE_INSTALL_LIBDIR}/walr/walr_plugin${CMAKE_SHARED_MODULE_SUFFIX}")
configure_package_config_file(cmake/walrConfig.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/walrConfig.cmake"
  INSTALL_DESTINATION "${package_dir}" PATH_VARS WALR_PLUGIN_PATH CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/walrConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
file(RELATIVE_PATH WALR_PC_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
set(WALR_PC_PRIVATE stdc++ m ${CMAKE_DL_LIBS})
list(TRANSFORM WALR_PC_PRIVATE PREPEND -l)
list(JOIN WALR_PC_PRIVATE " " WALR_PC_PRIVATE)
configure_file(cmake/walr.pc.in "${CMAKE_CURRENT_BINARY_DIR}/walr.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/walrConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/walrConfigVersion.cmake"
  cmake/WalrVulkanHeaders.cmake DESTINATION "${package_dir}" COMPONENT dev)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/walr.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)
# walr_install_guides(<folder> <component> [EXCLUDE_FROM_ALL]): installs the guides in the folders of the source tree, so
# that links between them work.
function(walr_install_guides folder component)
  set(options COMPONENT ${component} ${ARGN})
  install(FILES integration/README.md integration/ADAPTERS.md DESTINATION "${folder}/integration" ${options})
  install(DIRECTORY integration/docs DESTINATION "${folder}/integration" ${options} FILES_MATCHING PATTERN "*.md")
  install(FILES passes/WALR.md passes/SPECULAR.md passes/AT_REST.md passes/EXPECTED_ERROR.md passes/LEARNT.md passes/GLOSSARY.md
    passes/BIBLIOGRAPHY.md DESTINATION "${folder}/passes" ${options})
  install(FILES passes/images/walr.svg DESTINATION "${folder}/passes/images" ${options})
  install(FILES samples/embedding/embedding.c samples/embedding/sequence.cpp DESTINATION "${folder}/samples/embedding" ${options})
  install(FILES samples/README.md DESTINATION "${folder}/samples" ${options})
  install(FILES samples/results/GPU.md samples/results/RATES.md samples/results/REFLECTIONS.md DESTINATION "${folder}/samples/results" ${options})
  install(DIRECTORY samples/docs DESTINATION "${folder}/samples" ${options} FILES_MATCHING PATTERN "*.md")
endfunction()
walr_install_guides("${CMAKE_INSTALL_DOCDIR}" dev)
# The documentation of the headers is installed if the target docs has been built.
install(DIRECTORY "${CMAKE_BINARY_DIR}/docs/html" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT dev OPTIONAL)
if(TARGET walr)
  install(TARGETS walr RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tools)
  include(WalrBundle)
endif()

if(WIN32)
  include(WalrWindows)
  set(CPACK_GENERATOR ZIP)
else()
  set(CPACK_GENERATOR DEB)
endif()
set(CPACK_PACKAGE_CONTACT "walr")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
string(TOLOWER "${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}" CPACK_SYSTEM_NAME)
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_SOURCE_DIR}/cmake/cpack_generators.cmake")
set(CPACK_COMPONENTS_ALL runtime dev)
if(WALR_STATIC_LIBRARIES)
  list(APPEND CPACK_COMPONENTS_ALL cpp)
endif()
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
if(PROJECT_IS_TOP_LEVEL)
  include(CPack)
endif()
