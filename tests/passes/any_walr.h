#pragma once

#include <variant>

#include "passes/methods/walr_method.h"
#include "passes/methods/walr_paper.h"

namespace walr::test {

/// The method without the share of accumulated light.
inline WalrSettings walrWithoutShare() {
  WalrSettings settings;
  settings.blocks.share.enabled = false;
  return settings;
}

/// Settings of `walr` or of `walr_paper`, for tests of what both methods promise.
class AnyWalr {
 public:
  AnyWalr(const WalrSettings& settings) : settings_(settings) {}
  AnyWalr(const WalrPaperSettings& settings) : settings_(settings) {}

  /// The settings of `walr`; null for `walr_paper`.
  [[nodiscard]] const WalrSettings* blocks() const { return std::get_if<WalrSettings>(&settings_); }
  /// The settings of `walr_paper`; null for `walr`.
  [[nodiscard]] const WalrPaperSettings* pixels() const { return std::get_if<WalrPaperSettings>(&settings_); }

  /// Call `use` with the settings, whichever method they belong to.
  template <typename Use>
  decltype(auto) with(Use&& use) const {
    return std::visit(use, settings_);
  }
  template <typename Change>
  void change(Change&& change) {
    std::visit(change, settings_);
  }

  [[nodiscard]] const PrepareGuidesSettings& guides() const {
    return with([](const auto& s) -> const PrepareGuidesSettings& { return s.guides; });
  }
  [[nodiscard]] const TemporalAccumulationSettings& accumulation() const {
    return with([](const auto& s) -> const TemporalAccumulationSettings& { return s.accumulation; });
  }
  [[nodiscard]] const TemporalAntialiasingSettings& antialiasing() const {
    return with([](const auto& s) -> const TemporalAntialiasingSettings& { return s.antialiasing; });
  }

  [[nodiscard]] bool packsAccumulation() const { return accumulation().storage == LightStorage::Packed; }
  [[nodiscard]] bool packsAntialiasing() const { return antialiasing().storage == LightStorage::Packed; }

 private:
  std::variant<WalrSettings, WalrPaperSettings> settings_;
};

}  // namespace walr::test
