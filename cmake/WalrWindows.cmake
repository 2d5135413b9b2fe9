# What is installed on Windows only, included by WalrInstall.cmake.

# MinGW writes libwalr.dll.a, which MinGW's linker takes. Visual Studio's linker and lld-link take walr.lib.
if(MINGW)
  find_program(LLVM_DLLTOOL llvm-dlltool DOC "Writes the import library for Visual Studio (Debian package llvm)")
  if(LLVM_DLLTOOL)
    set(definition "${PROJECT_BINARY_DIR}/integration/c_api/walr_shared.def")
    set(import_library "${CMAKE_CURRENT_BINARY_DIR}/walr.lib")
    add_custom_command(OUTPUT "${import_library}"
      COMMAND "${LLVM_DLLTOOL}" -m i386:x86-64 -d "${definition}" -l "${import_library}"
      DEPENDS "${definition}" COMMENT "Writing walr.lib" VERBATIM)
    add_custom_target(walr_import_library ALL DEPENDS "${import_library}")
    install(FILES "${import_library}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
  else()
    message(STATUS "No walr.lib is made for Visual Studio, because llvm-dlltool is missing (Debian package llvm)")
  endif()
endif()

# Parts of these Debian packages are compiled or linked into the libraries. Their licences ask to come along.
if(CMAKE_CROSSCOMPILING)
  foreach(package IN ITEMS mingw-w64-x86-64-dev g++-mingw-w64-x86-64-posix libglm-dev nlohmann-json3-dev)
    install(FILES "/usr/share/doc/${package}/copyright" DESTINATION "${CMAKE_INSTALL_DOCDIR}/licenses" RENAME "${package}.txt"
      COMPONENT runtime OPTIONAL)
  endforeach()
endif()
