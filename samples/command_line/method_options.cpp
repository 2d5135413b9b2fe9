#include "samples/command_line/method_options.h"

#include <algorithm>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "integration/denoise_graph.h"
#include "samples/command_line/usage_error.h"

namespace walr {
namespace {

std::string presetHelp() {
  std::string text = "A named choice of values for the method's settings; --set then changes single ones.";
  for (const std::string& method : denoiserNames()) {
    const std::vector<std::string> presets = makeDenoiser(method)->presets();
    for (std::size_t i = 0; i < presets.size(); ++i) {
      text += (i == 0 ? " " + method + ": " : ", ") + presets[i] + (i == 0 ? " (default)" : "");
    }
    text += presets.empty() ? "" : ".";
  }
  return text;
}

/// Calls `apply` and reports its std::invalid_argument as an error of the option.
template <typename Function>
void applyOption(const std::string& option, Function apply) {
  try {
    apply();
  } catch (const std::invalid_argument& error) {
    throw UsageError(option + ": " + error.what());
  }
}

}  // namespace

void addMethodOptions(CLI::App& command, MethodOptions& options) {
  command.add_option("--method", options.name, "Denoising method")
      ->type_name("NAME")
      ->check(CLI::IsMember(denoiserNames()))
      ->capture_default_str();
  command.add_option("--preset", options.preset, presetHelp())->type_name("NAME");
  command.add_flag("--spatial-only", options.spatialOnly,
                   "Filter each frame separately, without temporal stages: same as --set spatial-only=on");
  command
      .add_option("--set", options.settings,
                  "Change one setting of the method; repeatable. 'walr graph "
                  "--list-settings' lists them with unit, range and default")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

std::unique_ptr<Denoiser> makeMethod(const MethodOptions& options, LightKinds lights) {
  std::unique_ptr<Denoiser> method = makeDenoiser(options.name);
  if (!options.preset.empty()) {
    applyOption("--preset " + options.preset, [&] { method->usePreset(options.preset); });
  }
  if (options.spatialOnly) applyOption("--spatial-only", [&] { method->set("spatial-only", "on"); });
  for (const std::string& setting : options.settings) {
    const std::size_t split = setting.find('=');
    if (split == std::string::npos) {
      throw UsageError("--set " + setting + ": give NAME=VALUE");
    }
    const std::string name = setting.substr(0, split);
    applyOption("--set " + setting, [&] {
      method->requireEffect(name, lights);
      method->set(name, setting.substr(split + 1));
    });
  }
  // Settings that contradict each other are found when the method is declared. The size does not matter for that.
  applyOption("--method " + options.name, [&] {
    constexpr fg::Extent kAnySize{64, 64};
    (void)declareDenoiseGraph(*method, kAnySize, InputConventions{}, kComputeHost);
  });
  return method;
}

std::optional<std::string> presetInUse(std::string_view methodName, Denoiser& method) {
  const std::vector<SettingText> settings = method.settings();
  const std::unique_ptr<Denoiser> other = makeDenoiser(methodName);
  for (const std::string& preset : other->presets()) {
    other->usePreset(preset);
    if (std::ranges::equal(other->settings(), settings, {}, &SettingText::value, &SettingText::value)) {
      return preset;
    }
  }
  return std::nullopt;
}

}  // namespace walr
