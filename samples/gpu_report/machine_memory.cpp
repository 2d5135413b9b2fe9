#include "samples/gpu_report/machine_memory.h"

#include <algorithm>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace walr {
namespace {

/// What a limit on the process leaves; nothing without a limit.
std::optional<std::uint64_t> leftOfLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  std::uint64_t pages = 0;  // The first number of statm: the size of the address space.
  std::ifstream("/proc/self/statm") >> pages;
  const std::uint64_t used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur > used ? limit.rlim_cur - used : 0;
}

}  // namespace

std::optional<std::uint64_t> freeMachineMemory(const std::filesystem::path& meminfo) {
  std::ifstream table(meminfo);
  for (std::string line; std::getline(table, line);) {
    constexpr std::string_view kKey = "MemAvailable:";
    if (!line.starts_with(kKey)) continue;
    const std::uint64_t available = std::stoull(line.substr(kKey.size())) * 1024;
    return std::min(available, leftOfLimit().value_or(available));
  }
  return std::nullopt;
}

}  // namespace walr
