#include "passes/settings.h"

#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "passes/text.h"

namespace walr {
namespace {

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string rangeText(const SettingInfo& info) {
  return number(info.least) + ".." + number(info.most);
}

[[noreturn]] void reject(const SettingInfo& info, std::string_view value, const std::string& allowed) {
  throw std::invalid_argument("setting " + std::string(info.name) + " cannot be \"" + std::string(value) +
                              "\"; it takes " + allowed);
}

/// The ends of a range are values of the setting's own type.
template <typename Number>
bool inRange(const SettingInfo& info, Number value) {
  return value >= static_cast<Number>(info.least) && value <= static_cast<Number>(info.most);
}

template <typename Number>
void checkRange(const SettingInfo& info, Number value) {
  if (!inRange(info, value)) reject(info, number(value), rangeText(info));
}

/// Parses one value into the setting of the given name.
class Setter final : public SettingVisitor {
 public:
  Setter(std::string_view name, std::string_view text) : name_(name), text_(text) {}

  void visit(const SettingInfo& info, float& value) override { parseNumber(info, value); }
  void visit(const SettingInfo& info, std::uint32_t& value) override { parseNumber(info, value); }
  void visit(const SettingInfo& info, bool& value) override {
    static constexpr std::string_view kNames[] = {"off", "on"};
    std::uint32_t index = value ? 1 : 0;
    choice(info, kNames, index);
    value = index == 1;
  }
  void choice(const SettingInfo& info, std::span<const std::string_view> names, std::uint32_t& value) override {
    if (!matches(info)) return;
    for (std::uint32_t i = 0; i < names.size(); ++i) {
      if (names[i] == text_) {
        value = i;
        return;
      }
    }
    reject(info, text_, join(names));
  }

  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] const std::string& known() const { return known_; }

 private:
  bool matches(const SettingInfo& info) {
    known_.append(known_.empty() ? "" : ", ").append(info.name);
    found_ = found_ || info.name == name_;
    return info.name == name_;
  }

  template <typename Number>
  void parseNumber(const SettingInfo& info, Number& value) {
    if (!matches(info)) return;
    Number parsed{};
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), parsed);
    const bool whole = error == std::errc() && end == text_.data() + text_.size();
    if (!whole || !inRange(info, parsed)) reject(info, text_, rangeText(info));
    value = parsed;
  }

  std::string_view name_;
  std::string_view text_;
  bool found_ = false;
  std::string known_;
};

class Lister final : public SettingVisitor {
 public:
  void visit(const SettingInfo& info, float& value) override { add(info, number(value), rangeText(info)); }
  void visit(const SettingInfo& info, std::uint32_t& value) override { add(info, number(value), rangeText(info)); }
  void visit(const SettingInfo& info, bool& value) override { add(info, value ? "on" : "off", "on, off"); }
  void choice(const SettingInfo& info, std::span<const std::string_view> names, std::uint32_t& value) override {
    add(info, std::string(names[value]), join(names));
  }

  std::vector<SettingText> list;

 private:
  void add(const SettingInfo& info, std::string value, std::string range) {
    list.push_back({std::string(info.name), std::move(value), std::move(range), std::string(info.unit),
                    std::string(info.description), std::string(info.source)});
  }
};

class RangeChecker final : public SettingVisitor {
 public:
  void visit(const SettingInfo& info, float& value) override { checkRange(info, value); }
  void visit(const SettingInfo& info, std::uint32_t& value) override { checkRange(info, value); }
  void visit(const SettingInfo& /*info*/, bool& /*value*/) override {}
  void choice(const SettingInfo& info, std::span<const std::string_view> names, std::uint32_t& value) override {
    if (value >= names.size()) reject(info, number(value), join(names));
  }
};

}  // namespace

void Configurable::set(std::string_view name, std::string_view value) {
  Setter setter(name, value);
  visitSettings(setter);
  if (!setter.found()) {
    throw std::invalid_argument("there is no setting \"" + std::string(name) + "\"; known settings: " + setter.known());
  }
}

std::vector<SettingText> Configurable::settings() {
  Lister lister;
  visitSettings(lister);
  return std::move(lister.list);
}

void Configurable::checkSettings() {
  RangeChecker checker;
  visitSettings(checker);
}

}  // namespace walr
