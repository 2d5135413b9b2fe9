# Builds embedding.c for Visual Studio's ABI: clang compiles it, and lld-link links it to the archive's walr.lib. Microsoft's
# headers and libraries are not used: the C headers are MinGW's, and the C library is msvcrt.dll, a part of Windows.
# cmake -DSOURCE=... -DSTAGING=... -DVULKAN_LOADER=... -DCLANG=... -DLLD_LINK=... -DLLVM_DLLTOOL=... -DOBJDUMP=...
#   -P make_visual_studio_host.cmake
cmake_policy(VERSION 3.25)
set(folder "${STAGING}/visual-studio")
file(MAKE_DIRECTORY "${folder}")
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output
    WORKING_DIRECTORY "${folder}")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${result}\n${output}")
  endif()
endfunction()
# import_library(<name> <function>...): writes <name>.lib for <name>.dll.
function(import_library name)
  list(JOIN ARGN "\n" functions)
  file(WRITE "${folder}/${name}.def" "LIBRARY ${name}.dll\nEXPORTS\n${functions}\n")
  run("${LLVM_DLLTOOL}" -m i386:x86-64 -d ${name}.def -l ${name}.lib)
endfunction()

import_library(msvcrt exit fprintf memcpy memset printf __iob_func)
execute_process(COMMAND "${OBJDUMP}" -p "${VULKAN_LOADER}" OUTPUT_VARIABLE exports COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "vk[A-Z][A-Za-z0-9]*" exports "${exports}")
list(REMOVE_DUPLICATES exports)
import_library(vulkan-1 ${exports})

file(GLOB root "${STAGING}/unpacked/walr-*")
set(compile "${CLANG}" --target=x86_64-pc-windows-msvc -std=c11 -O2 -c)
# MinGW's headers know no clang of this ABI: they take it for gcc.
run(${compile} -fgnuc-version=4.2.1 -D__USE_MINGW_ANSI_STDIO=0 -DWALR_SHARED -isystem /usr/x86_64-w64-mingw32/include
  -I "${SOURCE}/build-windows/headers/include" -I "${root}/include" "${SOURCE}/samples/embedding/embedding.c" -o embedding.obj)
run(${compile} "${SOURCE}/tests/windows/c_runtime.c" -o c_runtime.obj)
run("${LLD_LINK}" /nologo /subsystem:console /entry:start /nodefaultlib /out:embedding.exe embedding.obj c_runtime.obj
  "${root}/lib/walr.lib" vulkan-1.lib msvcrt.lib)
