#include "passes/settings/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "passes/settings/text.h"

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

/// A setting that was renamed or removed.
struct FormerSetting {
  std::string_view name;
  std::string_view now;     ///< Its new name; empty if it was removed.
  std::string_view wayOut;  ///< What to do instead, if it was removed.
};

constexpr std::string_view kFixed = "its value, which was measured, is fixed; leave it out";

constexpr std::array kFormerSettings{
    FormerSetting{"accumulation.max-samples", "accumulation.max-history", {}},
    FormerSetting{"accumulation.max-moment-samples", "accumulation.max-moment-history", {}},
    FormerSetting{"antialiasing.max-samples", "antialiasing.max-history", {}},
    FormerSetting{"fitted.max-samples", "fitted.max-history", {}},
    FormerSetting{"accumulation.respond-to-change", "accumulation.antilag", {}},
    FormerSetting{"accumulation.change-radius", {}, kFixed},
    FormerSetting{"accumulation.antilag-radius", {}, kFixed},
    FormerSetting{"accumulation.change-low", "accumulation.antilag-low", {}},
    FormerSetting{"accumulation.change-high", "accumulation.antilag-high", {}},
    FormerSetting{"walr.filter", {}, "method walr regresses over blocks of pixels, method walr_paper over pixels"},
    FormerSetting{"occlusion.steps", {}, "occlusion.rings counts rings of four pixels, two for a former step"},
    FormerSetting{"blocks.sort-tiles", {}, "tiles are no longer sorted; leave it out"},
    FormerSetting{"blocks.sdf-fraction", {}, kFixed},
    FormerSetting{"blocks.ridge", {}, kFixed},
    FormerSetting{"blocks.coarse-reach", {}, kFixed},
    FormerSetting{"blocks.coarse-resolution", {}, kFixed},
    FormerSetting{"blocks.coarse-growth-occlusion", {}, kFixed},
    FormerSetting{"blocks.coarse-least-share", {}, kFixed},
    FormerSetting{"blocks.residual-frames", {}, kFixed},
    FormerSetting{"blocks.residual-radius", {}, kFixed},
    FormerSetting{"blocks.residual-edge-gain", {}, kFixed},
    FormerSetting{"blocks.residual-least-share", {}, kFixed},
    FormerSetting{"blocks.innovation-bias", {}, kFixed},
    FormerSetting{"antialiasing.edge-clip-gamma", {}, kFixed},
    FormerSetting{"antialiasing.filter-radius", {}, kFixed},
    FormerSetting{"antialiasing.history-sharpness", {}, kFixed},
    FormerSetting{"guides.tangent-tolerance", {}, kFixed},
    FormerSetting{"guides.normal-agreement", {}, kFixed},
};

/// Number of letters to insert, delete or replace to turn one text into the other.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

/// The stage of a name "stage.setting"; empty if it has none.
std::string_view stageOf(std::string_view name) {
  const std::size_t dot = name.find('.');
  return dot == std::string_view::npos ? std::string_view() : name.substr(0, dot);
}
std::string_view withoutStage(std::string_view name) {
  return name.substr(name.find('.') + 1);
}

/// Known names that a mistaken one may have meant, likeliest first: similar spelling, the same stage, or the same
/// setting of another stage.
std::vector<std::string_view> nearNames(std::string_view name, const std::vector<std::string_view>& known) {
  constexpr std::size_t kMost = 6;
  const auto isNear = [&](std::string_view other) {
    return editDistance(name, other) <= name.size() / 4 || withoutStage(other) == withoutStage(name) ||
           (!stageOf(name).empty() && stageOf(other) == stageOf(name));
  };
  std::vector<std::string_view> near;
  std::ranges::copy_if(known, std::back_inserter(near), isNear);
  std::ranges::stable_sort(near, {}, [&](std::string_view other) {
    return withoutStage(other) == withoutStage(name) ? 0 : editDistance(name, other);
  });
  near.resize(std::min(near.size(), kMost));
  return near;
}

[[noreturn]] void rejectUnknown(std::string_view name, const std::vector<std::string_view>& known) {
  std::string message = "there is no setting \"" + std::string(name) + "\" here";
  std::string_view meant = name;
  const auto former = std::ranges::find(kFormerSettings, name, &FormerSetting::name);
  if (former != kFormerSettings.end()) {
    if (former->now.empty()) throw std::invalid_argument(message + ": " + std::string(former->wayOut));
    message += ": it is called " + std::string(former->now) + " now";
    if (std::ranges::find(known, former->now) != known.end()) throw std::invalid_argument(message);
    message += ", which is not a setting here either";
    meant = former->now;
  }
  const std::vector<std::string_view> near = nearNames(meant, known);
  message += near.empty() ? "; known settings: " + join(known) : "; near ones: " + join(near);
  throw std::invalid_argument(message);
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
  [[nodiscard]] const std::vector<std::string_view>& known() const { return known_; }

 private:
  bool matches(const SettingInfo& info) {
    known_.push_back(info.name);
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
  std::vector<std::string_view> known_;
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
                    descriptionOf(info), std::string(info.source), info.lights});
  }
};

/// A name without "specular-", by which the settings of the two lights differ.
std::string withoutLight(std::string_view name) {
  constexpr std::string_view kLight = "specular-";
  std::string shared(name);
  if (const std::size_t at = shared.find(kLight); at != std::string::npos) shared.erase(at, kLight.size());
  return shared;
}

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

std::string descriptionOf(const SettingInfo& info) {
  const std::string_view kind = !info.lights.specular  ? "Diffuse light: "
                                : !info.lights.diffuse ? "Specular light: "
                                                       : "";
  return std::string(kind) + std::string(info.description);
}

void Configurable::set(std::string_view name, std::string_view value) {
  Setter setter(name, value);
  visitSettings(setter);
  if (!setter.found()) rejectUnknown(name, setter.known());
}

void Configurable::requireEffect(std::string_view name, LightKinds lights) {
  const std::vector<SettingText> all = settings();
  const auto found = std::ranges::find(all, name, &SettingText::name);
  if (found == all.end() || haveInCommon(found->lights, lights)) return;
  const auto counterpart = std::ranges::find_if(all, [&](const SettingText& other) {
    return other.name != name && withoutLight(other.name) == withoutLight(name);
  });
  throw std::invalid_argument(
      "setting " + std::string(name) + " acts on " +
      (found->lights.diffuse ? "diffuse light only, and only specular" : "specular light only, and only diffuse") +
      " light is denoised here: " + (counterpart == all.end() ? "leave it out" : "set " + counterpart->name));
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
