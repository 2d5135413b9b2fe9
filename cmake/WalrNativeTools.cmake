# Build tools when walr is built for another machine than the one that builds: they run on the latter. They are built with
# its own compiler, or WALR_EMBED_SHADER names a program embed_shader that a native build of this version has made.
set(WALR_EMBED_SHADER "" CACHE FILEPATH "When cross-compiling: embed_shader of a native build; empty: build it, too")

add_executable(embed_shader IMPORTED GLOBAL)
if(WALR_EMBED_SHADER)
  set_target_properties(embed_shader PROPERTIES IMPORTED_LOCATION "${WALR_EMBED_SHADER}")
else()
  include(ExternalProject)
  set(tools "${CMAKE_CURRENT_BINARY_DIR}/native")
  # The compilers and flags of the cross build are not passed on.
  ExternalProject_Add(walr_native_tools
    SOURCE_DIR "${PROJECT_SOURCE_DIR}/framegraph/tools/native" BINARY_DIR "${tools}" PREFIX "${tools}-steps"
    CMAKE_GENERATOR Ninja CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release
    BUILD_ALWAYS ON BUILD_BYPRODUCTS "${tools}/tools/embed_shader" INSTALL_COMMAND "")
  set_target_properties(embed_shader PROPERTIES IMPORTED_LOCATION "${tools}/tools/embed_shader")
  add_dependencies(embed_shader walr_native_tools)
endif()
