# Runs PROGRAM, which must write LINE as its whole standard output and end with exit code 0. Its errors are not shown.
execute_process(COMMAND "${PROGRAM}" RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_QUIET)
if(NOT result EQUAL 0 OR NOT output STREQUAL LINE)
  message(FATAL_ERROR "${PROGRAM}: exit code ${result}, output '${output}'")
endif()
