# Puts into the bundle what is known only after the build: libraries, licences, the sample sequence. Runs as an install
# script, with these variables and CMAKE_INSTALL_PREFIX set by WalrBundle.cmake:
#
#   BUILD             build folder; the sequence is rendered there once
#   PROGRAMS          the programs; the first one is `walr`
#   OPENED_LIBRARIES  libraries that the programs open while they run
#   COMPILED_IN       headers of what is compiled into the programs
#   SCENE             the scene of the sample sequence
#   STRIP             the program strip
block()
cmake_policy(VERSION 3.25)
set(bundle "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")

# run(<out> <program> <argument>...)
function(run out)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${output}\n${error}")
  endif()
  set(${out} "${output}" PARENT_SCOPE)
endfunction()

# Symbols and debug information are of no use on another machine.
file(GLOB started "${bundle}/bin/*")
file(GLOB programs "${bundle}/libexec/*")
run(ignored "${STRIP}" ${started} ${programs})
# CMake ends the RPATH of a build with an empty folder, which would be the one that the user is in.
foreach(program IN LISTS programs)
  file(RPATH_SET FILE "${program}" NEW_RPATH "\$ORIGIN/../lib")
endforeach()

# Libraries: all but glibc's and the Vulkan loader, which belong to the machine.
file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${PROGRAMS} LIBRARIES ${OPENED_LIBRARIES}
  RESOLVED_DEPENDENCIES_VAR libraries
  PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|dl|m|pthread|rt)\\.so" "^libvulkan\\.so")
foreach(library IN LISTS libraries OPENED_LIBRARIES)
  cmake_path(GET library FILENAME name)
  if(name MATCHES "^lib(stdc\\+\\+|gcc_s)\\.")
    set(folder lib/fallback/c++)
  elseif(name MATCHES "^libz\\.")
    set(folder lib/fallback/zlib)
  elseif(name MATCHES "^lib(X|xcb|bsd|md)")
    set(folder lib/fallback/x11)
  else()
    set(folder lib)
  endif()
  file(REAL_PATH "${library}" file)
  file(MAKE_DIRECTORY "${bundle}/${folder}")
  file(COPY_FILE "${file}" "${bundle}/${folder}/${name}")
  list(APPEND sources "${file}")
endforeach()

# Licences: every file comes from a package, whose folder of documents has them. Common ones are referred to by path.
find_program(DPKG_QUERY dpkg-query NO_CACHE)
if(NOT DPKG_QUERY)
  message(FATAL_ERROR "The licences of the bundle's libraries are taken from Debian packages: make the bundle on "
    "Debian or Ubuntu.")
endif()
foreach(file IN LISTS sources COMPILED_IN)
  # The database may know the file by its path below / instead of /usr.
  file(REAL_PATH "${file}" file)
  string(REGEX REPLACE "^/usr" "" short "${file}")
  execute_process(COMMAND "${DPKG_QUERY}" --search "${file}" "${short}" OUTPUT_VARIABLE found ERROR_QUIET)
  if(NOT found MATCHES "^([^:, ]+)")
    message(FATAL_ERROR "No package owns ${file}, so its licence is unknown. Build with the distribution's libraries.")
  endif()
  list(APPEND packages "${CMAKE_MATCH_1}")
endforeach()
list(REMOVE_DUPLICATES packages)
list(SORT packages)
file(MAKE_DIRECTORY "${bundle}/licenses/common-licenses")
set(table "")
foreach(package IN LISTS packages)
  file(READ "/usr/share/doc/${package}/copyright" text)
  file(COPY_FILE "/usr/share/doc/${package}/copyright" "${bundle}/licenses/${package}.txt")
  string(REGEX MATCHALL "/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]" common "${text}")
  foreach(path IN LISTS common)
    if(EXISTS "${path}")
      cmake_path(GET path FILENAME name)
      file(REAL_PATH "${path}" file)
      file(COPY_FILE "${file}" "${bundle}/licenses/common-licenses/${name}")
    endif()
  endforeach()
  run(source "${DPKG_QUERY}" --show "--showformat=\${source:Package} \${source:Version}\n" "${package}")
  string(REGEX REPLACE "\n.*" "" source "${source}")
  string(APPEND table "${package}: ${source}\n")
endforeach()
file(WRITE "${bundle}/licenses/README.txt"
"walr itself is under the MIT licence (LICENSE). It contains or comes with parts of these packages of the
distribution it was built on. Each file PACKAGE.txt holds a package's licences. A path
/usr/share/common-licenses/NAME in it means common-licenses/NAME here. The source code of each package is the
distribution's source package of the name and version given:

${table}")

# The sample sequence, rendered once into the build folder. The last frame has a reference, so that errors are measured.
list(GET PROGRAMS 0 walr)
set(sequence "${BUILD}/bundle/box")
if(NOT EXISTS "${sequence}/ref_0005.exr")
  message(STATUS "Rendering the bundle's sample sequence to ${sequence}")
  run(ignored "${walr}" render "${SCENE}" --output "${sequence}" --frames 0-5 --size 256x144 --reference-spp 128
    --reference-frames 5-5)
endif()
file(INSTALL "${sequence}" DESTINATION "${bundle}/samples" FILES_MATCHING PATTERN "*.exr" PATTERN "render.json")
endblock()
