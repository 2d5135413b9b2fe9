# Finds Dear ImGui with its GLFW and Vulkan backends as the target ImGui::ImGui. Distributions package it as a static
# library that contains the backends (libimgui-dev). Its users must link GLFW, Vulkan and stb themselves.
include(CheckCXXSourceCompiles)
include(CMakePushCheckState)
find_path(ImGui_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
find_library(ImGui_LIBRARY imgui)
find_library(ImGui_Stb_LIBRARY stb)
find_package(glfw3 3.3 QUIET)

if(ImGui_INCLUDE_DIR AND ImGui_LIBRARY AND ImGui_Stb_LIBRARY AND TARGET glfw)
  cmake_push_check_state(RESET)
  set(CMAKE_REQUIRED_INCLUDES "${ImGui_INCLUDE_DIR}")
  set(CMAKE_REQUIRED_LIBRARIES "${ImGui_LIBRARY}" "${ImGui_Stb_LIBRARY}" glfw Vulkan::Vulkan)
  check_cxx_source_compiles([[
    #define GLFW_INCLUDE_VULKAN
    #include <GLFW/glfw3.h>
    #include <imgui.h>
    #include <backends/imgui_impl_glfw.h>
    #include <backends/imgui_impl_vulkan.h>
    int main() {
      ImGui::CreateContext();
      ImGui_ImplGlfw_InitForVulkan(nullptr, true);
      ImGui_ImplVulkan_RenderDrawData(nullptr, VK_NULL_HANDLE);
    }]] ImGui_HAS_BACKENDS)
  cmake_pop_check_state()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ImGui REQUIRED_VARS ImGui_LIBRARY ImGui_INCLUDE_DIR ImGui_Stb_LIBRARY ImGui_HAS_BACKENDS
  REASON_FAILURE_MESSAGE "install libimgui-dev and libglfw3-dev")
if(ImGui_FOUND AND NOT TARGET ImGui::ImGui)
  add_library(ImGui::ImGui UNKNOWN IMPORTED)
  set_target_properties(ImGui::ImGui PROPERTIES
    IMPORTED_LOCATION "${ImGui_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${ImGui_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${ImGui_Stb_LIBRARY};glfw;Vulkan::Vulkan")
endif()
mark_as_advanced(ImGui_INCLUDE_DIR ImGui_LIBRARY ImGui_Stb_LIBRARY)
