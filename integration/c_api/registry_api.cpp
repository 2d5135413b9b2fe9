#include <deque>
#include <string>
#include <vector>

#include <walr/walr.h>

#include "integration/c_api/error.h"
#include "integration/registry.h"

namespace walr::api {
namespace {

/// The registry's pass types as C structures. Their strings are those of the registry and live as long as the program.
class PassTypeTable {
 public:
  PassTypeTable() {
    for (const PassType& type : passTypes()) add(type);
  }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(types_.size()); }
  [[nodiscard]] const WalrPassType* at(std::uint32_t index) const {
    return index < types_.size() ? &types_[index] : nullptr;
  }

 private:
  void add(const PassType& type) {
    auto& ports = ports_.emplace_back();
    for (const Port& port : type.ports) ports.push_back(&allPorts_.emplace_back(convert(port)));
    auto& settings = settings_.emplace_back();
    for (const SettingDescription& setting : type.settings) {
      settings.push_back(&allSettings_.emplace_back(convert(setting)));
    }
    const auto& presets = strings(type.presets);
    const auto& passes = strings(type.passes);
    types_.push_back({.struct_size = sizeof(WalrPassType),
                      .method = type.composition ? VK_TRUE : VK_FALSE,
                      .name = type.name.c_str(),
                      .description = type.description.c_str(),
                      .ports = ports.data(),
                      .settings = settings.data(),
                      .presets = presets.data(),
                      .passes = passes.data(),
                      .port_count = static_cast<std::uint32_t>(ports.size()),
                      .setting_count = static_cast<std::uint32_t>(settings.size()),
                      .preset_count = static_cast<std::uint32_t>(presets.size()),
                      .pass_count = static_cast<std::uint32_t>(passes.size())});
  }

  const std::vector<const char*>& strings(const std::vector<std::string>& texts) {
    auto& pointers = strings_.emplace_back();
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    return pointers;
  }

  static WalrPort convert(const Port& port) {
    return {.struct_size = sizeof(WalrPort),
            .output = port.output ? VK_TRUE : VK_FALSE,
            .name = port.name.c_str(),
            .optional = port.optional ? VK_TRUE : VK_FALSE,
            .buffer = port.buffer ? VK_TRUE : VK_FALSE,
            .format = port.format,
            .image_usage = port.imageUsage,
            .buffer_usage = port.bufferUsage,
            .reserved = 0,
            .buffer_size = port.size,
            .description = port.description.c_str()};
  }

  WalrSetting convert(const SettingDescription& setting) {
    const auto& choices = strings(setting.choices);
    return {.struct_size = sizeof(WalrSetting),
            .kind = static_cast<WalrSettingKind>(setting.kind),
            .name = setting.name.c_str(),
            .default_value = setting.value.c_str(),
            .least = setting.least,
            .most = setting.most,
            .choices = choices.data(),
            .choice_count = static_cast<std::uint32_t>(choices.size()),
            .lights = (setting.lights.diffuse ? 1U << WALR_LIGHT_DIFFUSE : 0U) |
                      (setting.lights.specular ? 1U << WALR_LIGHT_SPECULAR : 0U),
            .unit = setting.unit.c_str(),
            .description = setting.description.c_str(),
            .source = setting.source.c_str()};
  }

  // Deques never move their elements, which others point to.
  std::deque<WalrPort> allPorts_;
  std::deque<WalrSetting> allSettings_;
  std::deque<std::vector<const WalrPort*>> ports_;
  std::deque<std::vector<const WalrSetting*>> settings_;
  std::deque<std::vector<const char*>> strings_;
  std::deque<WalrPassType> types_;
};

const PassTypeTable* table() {
  static const PassTypeTable kTable;
  return &kTable;
}

}  // namespace
}  // namespace walr::api

uint32_t walr_pass_type_count(void) {
  uint32_t count = 0;
  walr::api::guarded([&] { count = walr::api::table()->count(); });
  return count;
}

const WalrPassType* walr_pass_type(uint32_t index) {
  const WalrPassType* type = nullptr;
  walr::api::guarded([&] { type = walr::api::table()->at(index); });
  return type;
}
