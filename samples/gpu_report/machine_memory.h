#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace walr {

/// Bytes of the machine's memory that this process may still take: what is free, at most what `ulimit -v` leaves it.
/// The operating system grants more than that and ends a process that uses it, so who needs much asks first.
/// @param meminfo the kernel's table
/// @returns nothing where the operating system has no such table
std::optional<std::uint64_t> freeMachineMemory(const std::filesystem::path& meminfo = "/proc/meminfo");

}  // namespace walr
