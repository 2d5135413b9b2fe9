# Writes a CTest script for a GoogleTest program, with one test for each of its suites. Cases of a test share a process, and so a Vulkan
# device and what it has compiled.
#
#     cmake -DPROGRAM=... -DFILE=... -DPROPERTIES=... -DTOGETHER=... -P list_suites.cmake
#
# With TOGETHER, all suites are one test, named as the program, but for those that are skipped without shared data.
cmake_policy(VERSION 3.25)
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests OUTPUT_VARIABLE listing TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
# Lines of cases are indented. Those of suites are "Suite." or "Suite/0.  # TypeParam = ...".
string(REGEX REPLACE "\n +[^\n]*" "" listing "\n${listing}")
string(REGEX MATCHALL "[^\n ]+\\.( +#[^\n]*)?\n" suites "${listing}")
list(TRANSFORM suites REPLACE "\\.( +#.*)?\n$" "")
list(REMOVE_ITEM PROPERTIES "")
list(JOIN PROPERTIES "]==] [==[" properties)
set(script "")
function(add_suites name filter)
  # It is skipped if all of its cases are.
  string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${filter}]==])
set_tests_properties([==[${name}]==] PROPERTIES [==[${properties}]==]
  SKIP_REGULAR_EXPRESSION [==[\\[  PASSED  ] 0 tests\\.\n(\\[  SKIPPED ][^\n]*\n)+$]==])\n")
  set(script "${script}" PARENT_SCOPE)
endfunction()
if(TOGETHER)
  set(rest ${suites})
  list(FILTER suites INCLUDE REGEX "SharedData")
  list(REMOVE_ITEM rest ${suites})
  if(rest)
    cmake_path(GET PROGRAM STEM program)
    add_suites(${program} "-*SharedData*")
  endif()
endif()
foreach(suite IN LISTS suites)
  add_suites("${suite}" "${suite}.*")
endforeach()
file(WRITE "${FILE}" "${script}")
