# WALR_SANITIZE=address,undefined or WALR_SANITIZE=thread: every target is built with these sanitizers, and any finding ends
# the program with an error.
set(WALR_SANITIZE "" CACHE STRING "Sanitizers to build with, as the compiler's -fsanitize= takes them; none if empty")

if(WALR_SANITIZE)
  add_compile_options(-fsanitize=${WALR_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${WALR_SANITIZE})
  add_subdirectory(tests/sanitizers)
endif()
