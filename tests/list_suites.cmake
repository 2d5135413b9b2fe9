# Writes a CTest script with one test for each suite of a GoogleTest program: its cases share a process, and so a Vulkan device and what
# it has compiled.
#
#     cmake -DPROGRAM=... -DFILE=... -DPROPERTIES=... -P list_suites.cmake
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests OUTPUT_VARIABLE listing TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
# Lines of cases are indented. Those of suites are "Suite." or "Suite/0.  # TypeParam = ...".
string(REGEX REPLACE "\n +[^\n]*" "" listing "\n${listing}")
string(REGEX MATCHALL "[^\n ]+\\.( +#[^\n]*)?\n" suites "${listing}")
list(REMOVE_ITEM PROPERTIES "")
list(JOIN PROPERTIES "]==] [==[" properties)
set(script "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "\\.( +#.*)?\n$" "" suite "${suite}")
  # It is skipped if all of its cases are.
  string(APPEND script "add_test([==[${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])
set_tests_properties([==[${suite}]==] PROPERTIES [==[${properties}]==]
  SKIP_REGULAR_EXPRESSION [==[\\[  PASSED  ] 0 tests\\.\n(\\[  SKIPPED ][^\n]*\n)+$]==])\n")
endforeach()
file(WRITE "${FILE}" "${script}")
