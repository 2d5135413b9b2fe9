#include "samples/host/window/window.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

namespace walr::host {
namespace {

[[noreturn]] void throwComplaint(const std::string& action) {
  const char* complaint = nullptr;
  glfwGetError(&complaint);
  throw std::runtime_error(action + ": " + (complaint != nullptr ? complaint : "unknown error") +
                           ". Without a display, run with --headless.");
}

}  // namespace

bool Window::available() {
  return glfwInit() == GLFW_TRUE && glfwVulkanSupported() == GLFW_TRUE;
}

std::vector<const char*> Window::instanceExtensions() {
  std::uint32_t count = 0;
  const char** const names = glfwGetRequiredInstanceExtensions(&count);
  const std::span<const char*> required(names, count);
  return {required.begin(), required.end()};
}

Window::Window(const std::string& title, fg::Extent size) {
  if (glfwInit() != GLFW_TRUE) {
    throwComplaint("starting GLFW");
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  auto width = static_cast<int>(size.width);
  auto height = static_cast<int>(size.height);
  if (GLFWmonitor* const screen = glfwGetPrimaryMonitor(); screen != nullptr) {
    int mostColumns = 0;
    int mostRows = 0;
    glfwGetMonitorWorkarea(screen, nullptr, nullptr, &mostColumns, &mostRows);
    if (mostColumns > 0) width = std::min(width, mostColumns);
    if (mostRows > 0) height = std::min(height, mostRows);
  }
  handle_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (handle_ == nullptr) {
    throwComplaint("opening a window");
  }
  glfwSetWindowUserPointer(handle_, this);
  glfwSetDropCallback(handle_, [](GLFWwindow* window, int count, const char** paths) {
    if (count > 0) static_cast<Window*>(glfwGetWindowUserPointer(window))->dropped_ = *paths;
  });
}

Window::~Window() {
  glfwDestroyWindow(handle_);
  glfwTerminate();
}

bool Window::closed() const {
  return glfwWindowShouldClose(handle_) == GLFW_TRUE;
}

fg::Extent Window::size() const {
  if (glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) == GLFW_TRUE) return {};
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(handle_, &width, &height);
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

bool Window::keyDown(int key) const {
  return glfwGetKey(handle_, key) == GLFW_PRESS;
}

Surface::Surface(const Window& window, VkInstance instance) : instance_(instance) {
  if (glfwCreateWindowSurface(instance, window.handle(), nullptr, &handle_) != VK_SUCCESS) {
    throwComplaint("making a surface for the window");
  }
}

Surface::~Surface() {
  vkDestroySurfaceKHR(instance_, handle_, nullptr);
}

}  // namespace walr::host
