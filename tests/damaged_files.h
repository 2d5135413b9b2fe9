#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

/// Files that are damaged at random. The environment chooses how many are tried, and another first seed:
/// WALR_FILES=1000000 WALR_SEED=1.
namespace walr::test {

/// The largest request for memory since the last call, in bytes; 0 with sanitizers, which have allocators of their own.
std::size_t takeLargestRequest();

struct DamagedFiles {
  /// Make a file and read it. @returns whether it was read, and not refused
  std::function<bool(std::mt19937_64& random, std::uint64_t seed)> read;
  std::size_t largestRequest;  ///< Bytes: no file may ask for more.
  std::uint64_t files = 1500;  ///< Unless the environment says otherwise.
};

/// Expect of each file that it takes less than a second and no larger request, and of all that some are read and some
/// are not.
void tryDamagedFiles(const DamagedFiles& damaged);

/// A number below `bound`.
std::size_t below(std::mt19937_64& random, std::size_t bound);

}  // namespace walr::test
