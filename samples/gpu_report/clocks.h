#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace walr {

/// Clock rates of a GPU at one moment, as far as its driver tells them.
struct Clocks {
  std::optional<double> coreMegahertz;
  std::optional<double> memoryMegahertz;
};

/// Clock rates during a run.
struct ClockReading {
  std::string when;  ///< "before", "after 1920 x 1080".
  Clocks clocks;
};

/// Reads clock rates where a driver offers them: NVIDIA's by its program nvidia-smi; AMD's and Intel's in sysfs. Vulkan
/// has no such query.
class ClockReader {
 public:
  /// @param vendor, device PCI numbers as in VkPhysicalDeviceProperties
  /// @param name of the device, by which nvidia-smi's lines are told apart
  /// @param sysfs folder of the graphics cards
  ClockReader(std::uint32_t vendor, std::uint32_t device, std::string name,
              const std::filesystem::path& sysfs = "/sys/class/drm");

  /// Where the rates come from; empty if they are not known.
  [[nodiscard]] const std::string& source() const { return source_; }
  /// Why they are not known; empty if they are.
  [[nodiscard]] const std::string& whyNot() const { return whyNot_; }
  /// Nothing if the rates are not known.
  [[nodiscard]] std::optional<Clocks> read() const;

 private:
  [[nodiscard]] std::optional<Clocks> tryRead() const;

  std::uint32_t vendor_;
  std::string name_;
  std::filesystem::path card_;  ///< Folder of the card in sysfs; empty if there is none.
  std::string source_;
  std::string whyNot_;
};

/// Rates from `nvidia-smi --query-gpu=name,clocks.sm,clocks.mem --format=csv,noheader,nounits`: those of the first line
/// with the name.
std::optional<Clocks> parseNvidiaSmi(const std::string& lines, const std::string& name);
/// The rate that amdgpu marks as current in a file such as pp_dpm_sclk: "1: 2300Mhz *".
std::optional<double> parseCurrentLevel(const std::string& levels);

}  // namespace walr
