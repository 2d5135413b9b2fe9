#include "samples/bench/variant.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

namespace walr {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// Splits at the first separator. Without a separator, the second part is empty.
std::pair<std::string, std::string> splitOnce(const std::string& text, char separator) {
  const std::size_t at = text.find(separator);
  return {text.substr(0, at), at == std::string::npos ? "" : text.substr(at + 1)};
}

Variant methodVariant(const std::string& text) {
  const auto [method, preset] = splitOnce(text, ':');
  Variant variant{.name = text, .method = method, .preset = preset, .settings = {}};
  makeVariant(variant);
  return variant;
}

/// Whether no other picture of the benchmark has a name that begins with this one: errors and their change end so, and
/// the pictures that no variant made begin with "_".
bool isFileName(const std::string& name) {
  if (name.ends_with(".errors") || name.ends_with(".change")) return false;
  return !name.empty() && name.front() != '.' && name.front() != '_' && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view(".:=-_").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

}  // namespace

std::vector<Variant> allMethods() {
  std::vector<Variant> variants;
  for (const std::string& method : denoiserNames()) {
    variants.push_back(methodVariant(method));
    const std::vector<std::string> presets = makeDenoiser(method)->presets();
    for (std::size_t i = 1; i < presets.size(); ++i) variants.push_back(methodVariant(method + ":" + presets[i]));
  }
  return variants;
}

std::vector<Variant> parseMethods(const std::string& list) {
  if (list == "all") return allMethods();
  std::vector<Variant> variants;
  for (const std::string& method : split(list, ',')) variants.push_back(methodVariant(method));
  return variants;
}

Variant parseVariant(const std::string& text, LightKinds lights) {
  const auto [name, rest] = splitOnce(text, '=');
  if (!isFileName(name) || rest.empty()) {
    throw std::invalid_argument(
        "'" + text +
        "': give NAME=METHOD[:PRESET][,SETTING=VALUE]...; NAME consists of letters, digits and . : - _, does not begin "
        "with . or _, and does not end with .errors or .change");
  }
  const std::vector<std::string> parts = split(rest, ',');
  Variant variant = methodVariant(parts.front());
  variant.name = name;
  for (std::size_t i = 1; i < parts.size(); ++i) variant.settings.push_back(splitOnce(parts[i], '='));
  const std::unique_ptr<Denoiser> method = makeVariant(variant);
  for (const auto& [setting, value] : variant.settings) method->requireEffect(setting, lights);
  return variant;
}

std::unique_ptr<Denoiser> makeVariant(const Variant& variant) {
  std::unique_ptr<Denoiser> method = makeDenoiser(variant.method);
  if (!variant.preset.empty()) method->usePreset(variant.preset);
  for (const auto& [name, value] : variant.settings) method->set(name, value);
  return method;
}

std::vector<SettingValue> settingsOf(const Variant& variant) {
  std::vector<SettingValue> values;
  for (const SettingText& setting : makeVariant(variant)->settings()) values.emplace_back(setting.name, setting.value);
  return values;
}

void requireDistinctNames(const std::vector<Variant>& variants) {
  for (std::size_t i = 0; i < variants.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (variants[i].name != variants[j].name) continue;
      if (variants[i] != variants[j]) {
        throw std::invalid_argument("the name '" + variants[i].name +
                                    "' is used for two different variants; choose another");
      }
      throw std::invalid_argument("'" + variants[i].name + "' is given twice");
    }
  }
}

std::vector<Variant> withBaseline(std::vector<Variant> variants) {
  const Variant baseline = methodVariant(std::string(kBaseline));
  const auto found = std::ranges::find(variants, baseline);
  if (found != variants.end()) variants.erase(found);
  variants.insert(variants.begin(), baseline);
  requireDistinctNames(variants);
  return variants;
}

}  // namespace walr
