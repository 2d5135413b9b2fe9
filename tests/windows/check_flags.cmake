# Configures walr for Visual Studio's compiler, which clang stands in for, and checks which options that gets.
# cmake -DSOURCE=... -DSTAGING=... -DCLANG=... -DLLD_LINK=... -P check_flags.cmake
cmake_policy(VERSION 3.25)
set(folder "${STAGING}/flags")
file(REMOVE_RECURSE "${folder}")
file(MAKE_DIRECTORY "${folder}")
file(CREATE_LINK "${CLANG}" "${folder}/clang-cl" SYMBOLIC)  # By this name, clang takes Visual Studio's options.
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${folder}/build" -G Ninja
  "-DCMAKE_TOOLCHAIN_FILE=${SOURCE}/tests/windows/clang_cl.cmake" "-DCLANG_CL=${folder}/clang-cl" "-DLLD_LINK=${LLD_LINK}"
  "-DHEADERS=${SOURCE}/build-windows/headers" -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
  -DWALR_BUILD_SAMPLES=OFF -DWALR_BUILD_TESTS=OFF -DWALR_WARNINGS_AS_ERRORS=ON
  COMMAND_ERROR_IS_FATAL ANY)
file(READ "${folder}/build/compile_commands.json" commands)
string(JSON last LENGTH "${commands}")
math(EXPR last "${last} - 1")
foreach(i RANGE ${last})
  string(JSON command GET "${commands}" ${i} command)
  foreach(option IN ITEMS /W4 /WX /permissive- /utf-8 /Zc:__cplusplus -std:c++20)
    string(FIND "${command}" " ${option} " at)
    if(at EQUAL -1)
      message(FATAL_ERROR "${option} is missing: ${command}")
    endif()
  endforeach()
  if(command MATCHES " (-[Wfgm][^ ]*|-O[0-9s]|-std=[^ ]*|-pedantic) ")
    message(FATAL_ERROR "${CMAKE_MATCH_1} is an option of gcc: ${command}")
  endif()
endforeach()
file(READ "${folder}/build/build.ninja" build)
if(NOT build MATCHES "/DEF:[^ \n]*walr_shared.def" OR build MATCHES "--version-script|--no-undefined")
  message(FATAL_ERROR "walr.dll does not get its functions from a module definition file")
endif()
