#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vulkan/vulkan.h>

#include "framegraph/declare/graph.h"

struct GLFWwindow;

namespace walr::host {

/// A window on the screen, through GLFW.
class Window {
 public:
  /// Whether there is a display to open a window on.
  static bool available();
  /// Instance extensions that a window's surface needs.
  static std::vector<const char*> instanceExtensions();

  /// @param size  wanted; at most that of the screen without its bars
  /// @throws std::runtime_error with GLFW's message
  Window(const std::string& title, fg::Extent size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  [[nodiscard]] GLFWwindow* handle() const { return handle_; }
  /// Whether the user has closed the window.
  [[nodiscard]] bool closed() const;
  /// Size in pixels; 0 x 0 while the window is minimised, on any system.
  [[nodiscard]] fg::Extent size() const;
  /// Whether a key is down.
  /// @param key  GLFW_KEY_...
  [[nodiscard]] bool keyDown(int key) const;
  /// The first of the files that the user has dropped onto the window since the last call.
  std::optional<std::filesystem::path> takeDroppedFile() { return std::exchange(dropped_, std::nullopt); }

 private:
  GLFWwindow* handle_ = nullptr;
  std::optional<std::filesystem::path> dropped_;
};

/// The Vulkan surface of a window.
class Surface {
 public:
  /// @param instance  created with `Window::instanceExtensions`; must outlive the surface
  /// @throws std::runtime_error with GLFW's message
  Surface(const Window& window, VkInstance instance);
  ~Surface();
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  [[nodiscard]] VkSurfaceKHR handle() const { return handle_; }

 private:
  VkInstance instance_;
  VkSurfaceKHR handle_ = VK_NULL_HANDLE;
};

}  // namespace walr::host
