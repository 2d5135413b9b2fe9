#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "integration/stage_ports.h"

namespace walr {

/// Ports of the taps that "temporal_accumulation_with_taps" keeps: the second where these hold the light that passes
/// through, besides, as anti-aliasing with `antialiasing.storage` packed takes them.
inline constexpr std::string_view kHistoryTaps = "history-taps";
inline constexpr std::string_view kHistoryTapsWithLight = "history-taps-with-light";

/// A stage of the methods: its settings, and how it declares its passes between ports.
class Stage : public Configurable {
 public:
  [[nodiscard]] virtual std::vector<std::string> presets() const { return {}; }
  /// @throws std::invalid_argument naming the unknown preset and the known ones
  virtual void usePreset(std::string_view name);
  virtual void declare(StagePorts& ports) = 0;
};

/// An output of a stage that its settings decide about: with others it makes another output in its place.
struct SettingsOutput {
  std::string_view name;
  VkFormat format;
  std::string_view description;
};

/// A kind of stage by name.
struct StageType {
  std::string name;
  std::string description;
  bool composition = false;  ///< A whole method.
  std::unique_ptr<Stage> (*make)(std::string_view name);
  std::vector<SettingsOutput> settingsOutputs = {};
};

/// All of them, the whole methods last; whatever a stage takes, an earlier one makes.
const std::vector<StageType>& stageTypes();

}  // namespace walr
