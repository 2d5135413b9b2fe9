#include "framegraph/vulkan/validation_settings.h"

namespace fg::vk {
namespace {

constexpr auto kLayerSettingsType = static_cast<VkStructureType>(1000496000);
constexpr std::uint32_t kBool32 = 0;  // VK_LAYER_SETTING_TYPE_BOOL32_EXT
constexpr VkBool32 kOn = VK_TRUE;
constexpr VkBool32 kOff = VK_FALSE;
constexpr VkValidationFeatureEnableEXT kSynchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;

}  // namespace

ValidationSettings::ValidationSettings(bool layerSettings) : layerSettings_(layerSettings) {
  // A version of the layer ignores settings that it does not know.
  for (const char* setting : {"validate_sync", "syncval_shader_accesses_heuristic"}) {
    entries_.push_back({kValidationLayer, setting, kBool32, 1, &kOn});
  }
  entries_.push_back({kValidationLayer, "enable_message_limit", kBool32, 1, &kOff});
  settings_ = {kLayerSettingsType, nullptr, static_cast<std::uint32_t>(entries_.size()), entries_.data()};
  features_.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features_.enabledValidationFeatureCount = 1;
  features_.pEnabledValidationFeatures = &kSynchronization;
}

const char* ValidationSettings::extension() const {
  return layerSettings_ ? nullptr : VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME;
}

const void* ValidationSettings::chain() const {
  return layerSettings_ ? static_cast<const void*>(&settings_) : &features_;
}

}  // namespace fg::vk
