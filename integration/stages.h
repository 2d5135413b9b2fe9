#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "integration/stage_ports.h"

namespace walr {

/// Ports of the history taps that "temporal_accumulation_with_taps" outputs. It is the second one if
/// `antialiasing.storage` is packed; the texture then also holds the pass-through light.
inline constexpr std::string_view kHistoryTaps = "history-taps";
inline constexpr std::string_view kHistoryTapsWithLight = "history-taps-with-light";
inline constexpr std::string_view kAntilagFactor = "antilag";

/// A stage: it has settings and declares its passes between ports.
class Stage : public Configurable {
 public:
  [[nodiscard]] virtual std::vector<std::string> presets() const { return {}; }
  /// @throws std::invalid_argument naming the unknown preset and the known ones
  virtual void usePreset(std::string_view name);
  virtual void declare(StagePorts& ports) = 0;
};

/// An output that a stage has only with some values of its settings.
struct SettingsOutput {
  std::string_view name;
  VkFormat format;
  std::string_view description;
  std::uint32_t tile = 1;  ///< `Port::tile`.
};

/// A stage or method by name.
struct StageType {
  std::string name;
  std::string description;
  bool composition = false;  ///< A whole method.
  std::unique_ptr<Stage> (*make)(std::string_view name);
  std::vector<SettingsOutput> settingsOutputs = {};
};

/// All stages, then all methods. Each input of a stage is an output of an earlier stage or comes from the host.
const std::vector<StageType>& stageTypes();

}  // namespace walr
