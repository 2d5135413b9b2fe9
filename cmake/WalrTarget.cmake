# walr_target(<target>): sets the compile options of all targets of the project.
function(walr_target target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  if(MSVC)  # Also clang-cl, which takes the same options.
    target_compile_options(${target} PRIVATE /W4 /permissive- /utf-8 $<$<COMPILE_LANGUAGE:CXX>:/Zc:__cplusplus>
      $<$<BOOL:${WALR_WARNINGS_AS_ERRORS}>:/WX>)
    # <windows.h> defines min and max as macros, and the standard C functions are not deprecated.
    target_compile_definitions(${target} PRIVATE NOMINMAX _CRT_SECURE_NO_WARNINGS)
  else()
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic $<$<BOOL:${WALR_WARNINGS_AS_ERRORS}>:-Werror>)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # A quarter less compile time: gcc's default collects garbage whenever a source has used another 128 MiB.
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=1000000>)
    # Joined sources are included by another one, and gcc takes them for headers.
    target_compile_options(${target} PRIVATE $<$<BOOL:${CMAKE_UNITY_BUILD}>:$<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>>)
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    walr_sanitizer_policy(${target})
  endif()
endfunction()

# walr_compile_fast(<target>): optimizes a target less. For code that takes longer to compile than to run.
function(walr_compile_fast target)
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
  endif()
endfunction()

# walr_library(<name> SOURCES ...): adds a library target walr_<name> with the alias walr::<name>. Include paths start at
# the project's root ("framegraph/declare/graph.h").
function(walr_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  add_library(walr_${name} STATIC ${ARG_SOURCES})
  add_library(walr::${name} ALIAS walr_${name})
  set_target_properties(walr_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(walr_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/walr>)
  walr_target(walr_${name})
endfunction()
