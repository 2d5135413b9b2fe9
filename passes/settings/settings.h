#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace walr {

/// Kinds of light.
struct LightKinds {
  bool diffuse = true;
  bool specular = true;
};
inline constexpr LightKinds kDiffuseLight{true, false};
inline constexpr LightKinds kSpecularLight{false, true};
inline bool haveInCommon(LightKinds a, LightKinds b) {
  return (a.diffuse && b.diffuse) || (a.specular && b.specular);
}

/// Description of one setting. Its default is the value in a default-constructed settings struct.
struct SettingInfo {
  std::string_view name;         ///< As `--set` takes it.
  std::string_view description;  ///< One line.
  std::string_view unit;         ///< "frames", "pixels", "fraction of depth"; empty for a pure number or a switch.
  double least = 0.0;            ///< Smallest value; numbers only.
  double most = 1.0;             ///< Largest value; numbers only.
  std::string_view source;       ///< Paper and section, or "measured".
  LightKinds lights = {};        ///< That the setting acts on.
};

/// The description, which begins with the kind of light where the setting acts on one only.
std::string descriptionOf(const SettingInfo& info);

/// Visits the settings of a denoiser: every settings struct has a `visit(SettingVisitor&)` that names its members.
class SettingVisitor {
 public:
  virtual ~SettingVisitor() = default;
  virtual void visit(const SettingInfo& info, float& value) = 0;
  virtual void visit(const SettingInfo& info, std::uint32_t& value) = 0;
  virtual void visit(const SettingInfo& info, bool& value) = 0;
  /// An enumeration, as the index of its name.
  virtual void choice(const SettingInfo& info, std::span<const std::string_view> names, std::uint32_t& value) = 0;

  template <typename Enum>
  void visitEnum(const SettingInfo& info, std::span<const std::string_view> names, Enum& value) {
    auto index = static_cast<std::uint32_t>(value);
    choice(info, names, index);
    value = static_cast<Enum>(index);
  }
};

/// Hands settings on to another visitor as settings that act on these lights only.
class SettingsOfLight final : public SettingVisitor {
 public:
  SettingsOfLight(SettingVisitor& visitor, LightKinds lights) : visitor_(visitor), lights_(lights) {}
  void visit(const SettingInfo& info, float& value) override { visitor_.visit(limited(info), value); }
  void visit(const SettingInfo& info, std::uint32_t& value) override { visitor_.visit(limited(info), value); }
  void visit(const SettingInfo& info, bool& value) override { visitor_.visit(limited(info), value); }
  void choice(const SettingInfo& info, std::span<const std::string_view> names, std::uint32_t& value) override {
    visitor_.choice(limited(info), names, value);
  }

 private:
  [[nodiscard]] SettingInfo limited(SettingInfo info) const {
    info.lights = lights_;
    return info;
  }

  SettingVisitor& visitor_;
  LightKinds lights_;
};

/// One setting with its present value as text, for listings.
struct SettingText {
  std::string name;
  std::string value;
  std::string range;  ///< "0..1", "on, off", or the names of a choice.
  std::string unit;
  std::string description;
  std::string source;
  LightKinds lights;  ///< That the setting acts on.
};

/// Anything that has settings.
class Configurable {
 public:
  virtual ~Configurable() = default;
  virtual void visitSettings(SettingVisitor& visitor) = 0;

  /// Set by name from text.
  /// @throws std::invalid_argument naming the setting and its range; for an unknown name, the near ones that there are,
  ///         or what a former setting is called now
  void set(std::string_view name, std::string_view value);
  /// Refuse a setting that acts on none of the lights that are denoised. An unknown name passes: `set` refuses it.
  /// @throws std::invalid_argument naming the setting and the kind of light that it acts on
  void requireEffect(std::string_view name, LightKinds lights);
  /// All settings with their present values.
  [[nodiscard]] std::vector<SettingText> settings();
  /// @throws std::invalid_argument naming the first setting outside its range
  void checkSettings();
};

}  // namespace walr
