#include "samples/gpu_report/clocks.h"

#include <fstream>
#include <sstream>
#include <utility>

#include "samples/bench/child_process.h"

namespace walr {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kAmd = 0x1002;
constexpr std::uint32_t kIntel = 0x8086;
constexpr std::uint32_t kNvidia = 0x10de;

std::string textOf(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::optional<double> numberIn(const std::string& text) {
  std::istringstream stream(text);
  double value = 0.0;
  return stream >> value ? std::optional(value) : std::nullopt;
}

/// The number in a file such as vendor: "0x1002".
std::optional<std::uint32_t> hexadecimal(const fs::path& file) {
  std::istringstream stream(textOf(file));
  std::uint32_t value = 0;
  return stream >> std::hex >> value ? std::optional(value) : std::nullopt;
}

fs::path cardOf(std::uint32_t vendor, std::uint32_t device, const fs::path& sysfs) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(sysfs, ignored)) {
    const fs::path& card = entry.path();
    if (hexadecimal(card / "device" / "vendor") == vendor && hexadecimal(card / "device" / "device") == device) {
      return card;
    }
  }
  return {};
}

}  // namespace

std::optional<Clocks> parseNvidiaSmi(const std::string& lines, const std::string& name) {
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(name + ",")) continue;
    std::string core;
    std::string memory;
    std::istringstream rest(line.substr(name.size() + 1));
    std::getline(rest, core, ',');
    std::getline(rest, memory, ',');
    return Clocks{numberIn(core), numberIn(memory)};
  }
  return std::nullopt;
}

std::optional<double> parseCurrentLevel(const std::string& levels) {
  std::istringstream stream(levels);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos && line.find('*') != std::string::npos) return numberIn(line.substr(colon + 1));
  }
  return std::nullopt;
}

ClockReader::ClockReader(std::uint32_t vendor, std::uint32_t device, std::string name, const fs::path& sysfs)
    : vendor_(vendor), name_(std::move(name)), card_(cardOf(vendor, device, sysfs)) {
  const std::optional<Clocks> clocks = tryRead();
  if (clocks && (clocks->coreMegahertz || clocks->memoryMegahertz)) {
    source_ = vendor_ == kNvidia ? "nvidia-smi" : card_.string();
  } else if (vendor_ == kNvidia) {
    whyNot_ = "nvidia-smi cannot be run, or does not list '" + name_ + "'";
  } else if (vendor_ == kAmd || vendor_ == kIntel) {
    whyNot_ = "no card in " + sysfs.string() + " tells the clock rates of this device";
  } else {
    whyNot_ = "no way is known to ask this device's driver";
  }
}

std::optional<Clocks> ClockReader::tryRead() const {
  if (vendor_ == kNvidia) {
    const ChildResult result =
        runChild({"nvidia-smi", "--query-gpu=name,clocks.sm,clocks.mem", "--format=csv,noheader,nounits"},
                 ChildOutput::Captured);
    return result.exitCode == 0 ? parseNvidiaSmi(result.output, name_) : std::nullopt;
  }
  if (card_.empty()) return std::nullopt;
  if (vendor_ == kAmd) {
    return Clocks{parseCurrentLevel(textOf(card_ / "device" / "pp_dpm_sclk")),
                  parseCurrentLevel(textOf(card_ / "device" / "pp_dpm_mclk"))};
  }
  if (vendor_ == kIntel) return Clocks{numberIn(textOf(card_ / "gt_act_freq_mhz")), std::nullopt};
  return std::nullopt;
}

std::optional<Clocks> ClockReader::read() const {
  return source_.empty() ? std::nullopt : tryRead();
}

}  // namespace walr
