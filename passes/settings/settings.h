#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace walr {

/// Description of one setting. Its default is the value in a default-constructed settings struct.
struct SettingInfo {
  std::string_view name;         ///< As `--set` takes it.
  std::string_view description;  ///< One line.
  std::string_view unit;         ///< "frames", "pixels", "fraction of depth"; empty for a pure number or a switch.
  double least = 0.0;            ///< Smallest value; numbers only.
  double most = 1.0;             ///< Largest value; numbers only.
  std::string_view source;       ///< Paper and section, or "measured".
};

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

/// One setting with its present value as text, for listings.
struct SettingText {
  std::string name;
  std::string value;
  std::string range;  ///< "0..1", "on, off", or the names of a choice.
  std::string unit;
  std::string description;
  std::string source;
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
  /// All settings with their present values.
  [[nodiscard]] std::vector<SettingText> settings();
  /// @throws std::invalid_argument naming the first setting outside its range
  void checkSettings();
};

}  // namespace walr
