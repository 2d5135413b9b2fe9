# walr_add_shaders(<name>
#   NAMESPACE <namespace>       C++ namespace of the variables, for instance walr::shaders
#   HEADER <path>               how the header is included, for instance shaders/shaders.h
#   [TARGET <environment>]      of the SPIR-V, if it is not vulkan1.1
#   [INCLUDE_DIRS <dir>...]     searched by #include, after the including file's own folder
#   SHADERS <shader>...)
#
# Adds a library walr_<name> (alias walr::<name>) of compute shaders. GLSL is compiled to SPIR-V and reflected at build
# time, so programs read no shader files at run time. Every <shader> is one string:
#
#   "atrous.comp"                                               -> extern const fg::Shader atrous;
#   "edge_trace.comp VARIANT raw16 DEFINES STORAGE=RAW16 HALF"  -> extern const fg::Shader edgeTraceRaw16;
#   "fit.comp AXES view=VIEW packed=PACKED"                     -> const fg::Shader& fit(FitVariant);
#   "layer.comp IN_HALVES layer.halves"                         -> layer, with `fg::Shader::inHalves` of another of the shaders
#
# The names in fg::Shader::name are "atrous" and "edge_trace.raw16". AXES compiles a shader for every combination of the
# words, with the define of each, and generates a function that chooses one: fit({.packed = true}) returns "fit.packed". A
# switch that only decides which inputs are read needs no axis: see PassBuilder::unread. A shader is rebuilt when it or an
# included file changes. SPIR-V targets Vulkan 1.1, the oldest version on which a host can have synchronization2, unless
# TARGET says otherwise.
# Bindings must be in descriptor set 0. A binding has the name of its variable, or of its block if the block has no instance
# name. Unused bindings are left out. The compiler numbers bindings that have no number. See framegraph/tools/reflect.h.
# Only debug builds embed names in the SPIR-V, for validation messages.
# With WALR_RELOAD_SHADERS, the property WALR_SHADER_COMMANDS of the library is a file with a line for every shader: its name,
# its SPIR-V and the words of the command that compiles it, but for the output, all separated by tabs.
find_program(GLSLANG_VALIDATOR NAMES glslangValidator glslang REQUIRED
  DOC "glslang's compiler (Debian package glslang-tools)")

# _walr_shader_identifier(<out> <words>): camelCase of words that are separated by anything but letters and digits.
function(_walr_shader_identifier out words)
  string(REGEX REPLACE "[^A-Za-z0-9]+" ";" parts "${words}")
  list(POP_FRONT parts identifier)
  foreach(part IN LISTS parts)
    string(SUBSTRING "${part}" 0 1 initial)
    string(SUBSTRING "${part}" 1 -1 rest)
    string(TOUPPER "${initial}" initial)
    string(APPEND identifier "${initial}${rest}")
  endforeach()
  set(${out} "${identifier}" PARENT_SCOPE)
endfunction()

# _walr_combinations(<out> <axis>...): all combinations of axes such as packed=PACKED, joined by "+" after a "-". A
# combination includes the i-th axis if bit i of its index is set.
function(_walr_combinations out)
  set(combinations "-")
  foreach(axis IN LISTS ARGN)
    list(TRANSFORM combinations APPEND "+${axis}" OUTPUT_VARIABLE more)
    list(APPEND combinations ${more})
  endforeach()
  set(${out} "${combinations}" PARENT_SCOPE)
endfunction()

# _walr_variant_chooser(<out> <identifier> <axes> <modules>): C++ code that chooses a module by the names of axes. The
# modules are in the order of _walr_combinations.
function(_walr_variant_chooser out identifier axes modules)
  string(SUBSTRING "${identifier}" 0 1 initial)
  string(SUBSTRING "${identifier}" 1 -1 rest)
  string(TOUPPER "${initial}" initial)
  set(type "${initial}${rest}Variant")
  set(members "")
  set(index "")
  set(bit 1)
  foreach(axis IN LISTS axes)
    string(REGEX REPLACE "=.*" "" word "${axis}")
    string(APPEND members " bool ${word} = false;")
    list(APPEND index "(variant.${word} ? ${bit} : 0)")
    math(EXPR bit "2 * ${bit}")
  endforeach()
  list(JOIN index " + " index)
  list(TRANSFORM modules PREPEND "&modules::")
  list(JOIN modules ", " modules)
  set(${out} "struct ${type} {${members} };
inline const fg::Shader& ${identifier}(${type} variant) {
  static constexpr const fg::Shader* kModules[] = {${modules}};
  return *kModules[${index}];
}
" PARENT_SCOPE)
endfunction()

function(walr_add_shaders name)
  cmake_parse_arguments(ARG "" "NAMESPACE;HEADER;TARGET" "INCLUDE_DIRS;SHADERS" ${ARGN})
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/${name}")
  list(TRANSFORM ARG_INCLUDE_DIRS PREPEND "-I" OUTPUT_VARIABLE includes)
  if(NOT ARG_TARGET)
    set(ARG_TARGET vulkan1.1)
  endif()

  set(variables "")
  set(modules "")
  set(choosers "")
  set(all "")
  set(sources "")
  set(command_lines "")
  foreach(shader IN LISTS ARG_SHADERS)
    separate_arguments(words UNIX_COMMAND "${shader}")
    list(POP_FRONT words file)
    cmake_parse_arguments(SHADER "" "VARIANT;IN_HALVES" "DEFINES;AXES" ${words})
    get_filename_component(stem "${file}" NAME_WE)
    string(JOIN "." base "${stem}" ${SHADER_VARIANT})
    _walr_shader_identifier(family "${base}")
    set(in_halves "")
    if(SHADER_IN_HALVES)
      _walr_shader_identifier(in_halves "${SHADER_IN_HALVES}")
    endif()
    _walr_combinations(combinations ${SHADER_AXES})
    set(choices "")
    foreach(combination IN LISTS combinations)
      string(REGEX MATCHALL "[^+-][^+]*" combined "${combination}")
      list(TRANSFORM combined REPLACE "=.*" "" OUTPUT_VARIABLE words)
      list(TRANSFORM combined REPLACE ".*=" "")
      list(JOIN words "." words)
      string(JOIN "." shader_name "${base}" ${words})
      _walr_shader_identifier(identifier "${shader_name}")
      set(namespace "${ARG_NAMESPACE}")
      if(SHADER_AXES)
        string(APPEND namespace "::modules")
        string(APPEND modules "extern const fg::Shader ${identifier};\n")
        list(APPEND choices "${identifier}")
        list(APPEND all "&modules::${identifier}")
      else()
        string(APPEND variables "extern const fg::Shader ${identifier};\n")
        list(APPEND all "&${identifier}")
      endif()
      list(TRANSFORM SHADER_DEFINES PREPEND "-D" OUTPUT_VARIABLE defines)
      list(TRANSFORM combined PREPEND "-D")

      set(spirv "${generated}/${shader_name}.spv")
      set(source "${generated}/${shader_name}.cpp")
      set(command "${GLSLANG_VALIDATOR}" -V --target-env ${ARG_TARGET} --auto-map-bindings ${includes} ${defines} ${combined})
      list(JOIN command "\t" words)
      string(APPEND command_lines "${shader_name}\t${spirv}\t${words}\t${CMAKE_CURRENT_SOURCE_DIR}/${file}\n")
      add_custom_command(OUTPUT "${spirv}"
        COMMAND ${command} --depfile "${spirv}.d" -o "${spirv}" "${CMAKE_CURRENT_SOURCE_DIR}/${file}"
        DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${file}" DEPFILE "${spirv}.d"
        COMMENT "Compiling shader ${shader_name}" VERBATIM)
      add_custom_command(OUTPUT "${source}"
        COMMAND embed_shader "${spirv}" "${source}" "${ARG_HEADER}" "${namespace}" "${identifier}" "${shader_name}"
          "$<IF:$<CONFIG:Debug>,names,no-names>" ${in_halves}
        DEPENDS embed_shader "${spirv}"
        COMMENT "Embedding shader ${shader_name}" VERBATIM)
      list(APPEND sources "${source}")
    endforeach()
    if(SHADER_AXES)
      _walr_variant_chooser(chooser "${family}" "${SHADER_AXES}" "${choices}")
      string(APPEND choosers "${chooser}")
    endif()
  endforeach()
  list(JOIN all ", " all)

  set(header "${generated}/include/${ARG_HEADER}")
  file(CONFIGURE OUTPUT "${header}" @ONLY CONTENT [[// Generated by walr_add_shaders.
#pragma once

#include "framegraph/declare/shader.h"

namespace @ARG_NAMESPACE@ {
@variables@
namespace modules {
@modules@}  // namespace modules

@choosers@
/// Every shader above.
inline constexpr const fg::Shader* kAll[] = {@all@};
}  // namespace @ARG_NAMESPACE@
]])
  walr_library(${name} SOURCES ${sources} "${header}")
  # Most of the time goes into the header, so some shaders share a source.
  set_target_properties(walr_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
  if(WALR_RELOAD_SHADERS)
    file(CONFIGURE OUTPUT "${generated}/commands.txt" CONTENT "${command_lines}" @ONLY)
    set_target_properties(walr_${name} PROPERTIES WALR_SHADER_COMMANDS "${generated}/commands.txt")
  endif()
  target_include_directories(walr_${name} PUBLIC $<BUILD_INTERFACE:${generated}/include>)
  target_link_libraries(walr_${name} PUBLIC walr::framegraph)
endfunction()
