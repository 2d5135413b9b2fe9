# The bundle: `cpack -G TGZ` makes walr-VERSION-linux-x86_64.tar.gz, whose programs run from any folder on a machine
# that has glibc, the Vulkan loader and a Vulkan driver. samples/docs/bundle.md describes it, tests/bundle tests it.
#
#   bin/walr, bin/walr-host  start the programs in libexec/ (samples/bundle/launch.c)
#   lib/                     the programs' libraries
#   lib/fallback/GROUP/      libraries that Vulkan drivers use, too: taken only if the machine lacks one of the group
#   samples/, doc/           scenes, a short noisy sequence, the manual and guides
#   licenses/                of everything that is in the programs and libraries

# These libraries are opened by GLFW while it runs, if they are there.
set(libraries_of_glfw "")
if(TARGET walr_host_window)
  foreach(name IN ITEMS libX11-xcb.so.1 libXcursor.so.1 libXi.so.6 libXinerama.so.1 libXrandr.so.2 libXrender.so.1
      libXxf86vm.so.1)
    find_library(path NAMES "${name}" NO_CACHE)
    if(path)
      list(APPEND libraries_of_glfw "${path}")
    else()
      message(STATUS "The bundle lacks ${name}, which GLFW uses if it is there")
    endif()
    unset(path)
  endforeach()
endif()

# What is compiled into the programs: the licences are those of the packages of these headers.
set(compiled_in "")
foreach(header IN ITEMS glm/glm.hpp CLI/CLI.hpp nlohmann/json.hpp tiny_gltf.h imgui.h stb_image.h vulkan/vulkan.h
    draco/compression/decode.h)
  find_path(folder "${header}" PATH_SUFFIXES stb imgui NO_CACHE)
  if(folder)
    list(APPEND compiled_in "${folder}/${header}")
  endif()
  unset(folder)
endforeach()

foreach(program IN ITEMS walr walr-host)
  # Only the bundle keeps this RPATH, because it copies the program as it was built; CMake's own installation drops it.
  # RPATH, unlike RUNPATH, also holds for the libraries of the libraries.
  set_target_properties(${program} PROPERTIES BUILD_RPATH "\$ORIGIN/../lib")
  target_link_options(${program} PRIVATE LINKER:--disable-new-dtags)
  install(PROGRAMS "$<TARGET_FILE:${program}>" DESTINATION libexec COMPONENT bundle EXCLUDE_FROM_ALL)
  install(PROGRAMS "$<TARGET_FILE:walr-launch>" DESTINATION bin RENAME ${program} COMPONENT bundle EXCLUDE_FROM_ALL)
endforeach()

set(settings
  "set(BUILD [[${PROJECT_BINARY_DIR}]])"
  "set(PROGRAMS [[$<TARGET_FILE:walr>]] [[$<TARGET_FILE:walr-host>]])"
  "set(OPENED_LIBRARIES [[${libraries_of_glfw}]])"
  "set(COMPILED_IN [[${compiled_in}]])"
  "set(SCENE [[${PROJECT_BINARY_DIR}/samples/scenes/box.gltf]])"
  "set(STRIP [[${CMAKE_STRIP}]])")
list(JOIN settings "\n" settings)
install(CODE "${settings}" COMPONENT bundle EXCLUDE_FROM_ALL)
install(SCRIPT cmake/bundle_contents.cmake COMPONENT bundle EXCLUDE_FROM_ALL)

install(FILES samples/bundle/README.md LICENSE CHANGELOG.md DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL)
install(PROGRAMS samples/bundle/try.sh DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL)
foreach(scene IN ITEMS box kitchen turntable)
  install(FILES "${PROJECT_BINARY_DIR}/samples/scenes/${scene}.gltf" DESTINATION samples/scenes COMPONENT bundle EXCLUDE_FROM_ALL)
endforeach()
install(PROGRAMS samples/blender/export_frames.py DESTINATION samples/blender COMPONENT bundle EXCLUDE_FROM_ALL)
walr_install_guides(doc bundle EXCLUDE_FROM_ALL)
