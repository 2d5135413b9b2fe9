# WALR_SANITIZE=address,undefined or WALR_SANITIZE=thread builds every target with these sanitizers. A program fails at the
# first error that they find.
set(WALR_SANITIZE "" CACHE STRING "Sanitizers to build with (value of -fsanitize=); empty for none")

if(WALR_SANITIZE)
  if(MSVC)
    message(FATAL_ERROR "WALR_SANITIZE works with gcc and clang only: leave it empty for ${CMAKE_CXX_COMPILER_ID}.")
  endif()
  add_compile_options(-fsanitize=${WALR_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${WALR_SANITIZE})
  add_subdirectory(tests/sanitizers)
endif()

# walr_sanitizer_policy(<executable>): links the settings of a sanitized build (tests/sanitizers/policy.c).
function(walr_sanitizer_policy executable)
  if(WALR_SANITIZE)
    target_link_libraries(${executable} PRIVATE walr_sanitizer_policy)
  endif()
endfunction()
