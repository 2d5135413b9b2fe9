#pragma once

#include <cstdint>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace fg::vk {

/// The name of the Khronos validation layer.
inline constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
/// The instance extension by which a layer takes settings from the program.
inline constexpr const char* kLayerSettingsExtension = "VK_EXT_layer_settings";

/// Tells the Khronos validation layer to check synchronization, which it does not do by default, and to report every
/// message. Newer versions of the layer leave out what shaders access unless they are told otherwise, and so would see
/// no hazard between compute passes; and they leave out the eleventh message of a kind and all after it.
class ValidationSettings {
 public:
  /// @param layerSettings whether the layer has the extension VK_EXT_layer_settings. Versions without it do not know
  ///        shader accesses as a setting: they always check them.
  explicit ValidationSettings(bool layerSettings);
  ValidationSettings(const ValidationSettings&) = delete;
  ValidationSettings& operator=(const ValidationSettings&) = delete;

  /// The instance extension to enable; null if none. The layer reads its settings whether or not their extension is
  /// enabled, and loaders that are older than it refuse it.
  [[nodiscard]] const char* extension() const;
  /// For `VkInstanceCreateInfo::pNext`. Valid as long as this object.
  [[nodiscard]] const void* chain() const;

 private:
  // Those of VK_EXT_layer_settings, which is newer than the headers of Debian 12.
  struct LayerSetting {
    const char* layer;
    const char* setting;
    std::uint32_t type;
    std::uint32_t valueCount;
    const void* values;
  };
  struct LayerSettings {
    VkStructureType sType;
    const void* pNext;
    std::uint32_t settingCount;
    const LayerSetting* settings;
  };

  bool layerSettings_;
  std::vector<LayerSetting> entries_;
  LayerSettings settings_{};
  VkValidationFeaturesEXT features_{};
};

}  // namespace fg::vk
