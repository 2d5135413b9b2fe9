#include "integration/setting_info.h"

#include <charconv>

namespace walr {
namespace {

/// The shortest text that reads back as the same value.
template <typename Number>
std::string text(Number value) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return {buffer, end};
}

class Describer final : public SettingVisitor {
 public:
  void visit(const SettingInfo& info, float& value) override { addNumber(info, SettingKind::Number, text(value)); }
  void visit(const SettingInfo& info, std::uint32_t& value) override {
    addNumber(info, SettingKind::Integer, text(value));
  }
  void visit(const SettingInfo& info, bool& value) override {
    add(info, SettingKind::Switch, value ? "on" : "off").choices = {"off", "on"};
  }
  void choice(const SettingInfo& info, std::span<const std::string_view> names, std::uint32_t& value) override {
    add(info, SettingKind::Choice, std::string(names[value])).choices.assign(names.begin(), names.end());
  }

  std::vector<SettingDescription> list;

 private:
  SettingDescription& add(const SettingInfo& info, SettingKind kind, std::string value) {
    SettingDescription& setting = list.emplace_back();
    setting.name = info.name;
    setting.kind = kind;
    setting.value = std::move(value);
    setting.unit = info.unit;
    setting.description = descriptionOf(info);
    setting.source = info.source;
    setting.lights = info.lights;
    return setting;
  }
  void addNumber(const SettingInfo& info, SettingKind kind, std::string value) {
    SettingDescription& setting = add(info, kind, std::move(value));
    setting.least = info.least;
    setting.most = info.most;
  }
};

}  // namespace

std::vector<SettingDescription> describeSettings(Configurable& configurable) {
  Describer describer;
  configurable.visitSettings(describer);
  return std::move(describer.list);
}

}  // namespace walr
