# The target docs builds the Doxygen site in build/docs/html. Any warning is an error. The target exists only if doxygen
# is found.
find_package(Doxygen OPTIONAL_COMPONENTS dot QUIET)
if(DOXYGEN_FOUND)
  set(DOXYGEN_PROJECT_NAME walr)
  set(DOXYGEN_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/docs")
  set(DOXYGEN_USE_MDFILE_AS_MAINPAGE "${PROJECT_SOURCE_DIR}/README.md")
  set(DOXYGEN_FILE_PATTERNS *.h *.md)
  set(DOXYGEN_EXCLUDE_PATTERNS */build*/* */tests/*)
  set(DOXYGEN_STRIP_FROM_PATH "${PROJECT_SOURCE_DIR}")
  set(DOXYGEN_EXTRACT_ALL YES)
  set(DOXYGEN_EXTRACT_STATIC YES)
  set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
  set(DOXYGEN_GENERATE_LATEX NO)
  set(DOXYGEN_HAVE_DOT NO)
  set(DOXYGEN_FILTER_PATTERNS
    "*/include/walr/walr*.h=sed -E -f ${PROJECT_SOURCE_DIR}/cmake/doxygen_c_comments.sed")
  set(DOXYGEN_QUIET YES)
  # A parameter with a self-explanatory name needs no @param line.
  set(DOXYGEN_WARN_IF_INCOMPLETE_DOC NO)
  set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
  set(DOXYGEN_MACRO_EXPANSION YES)
  set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
  set(DOXYGEN_PREDEFINED __cplusplus WALR_API=)
  doxygen_add_docs(docs "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
    "${PROJECT_SOURCE_DIR}/framegraph" "${PROJECT_SOURCE_DIR}/passes" "${PROJECT_SOURCE_DIR}/shaders/constants"
    "${PROJECT_SOURCE_DIR}/integration" "${PROJECT_SOURCE_DIR}/samples" WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
endif()
