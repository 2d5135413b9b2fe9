#include "tests/damaged_files.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>

#include <gtest/gtest.h>

namespace {

// Libraries of the program come here, too.
std::atomic<std::size_t> largest = 0;

}  // namespace

#ifdef WALR_COUNT_REQUESTS
namespace {

void note(std::size_t bytes) {
  std::size_t known = largest;
  while (bytes > known && !largest.compare_exchange_weak(known, bytes)) {
  }
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier): names of glibc.
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void* malloc(std::size_t bytes) noexcept {
  note(bytes);
  return __libc_malloc(bytes);
}
void* calloc(std::size_t count, std::size_t bytes) noexcept {
  note(count * bytes);
  return __libc_calloc(count, bytes);
}
void* realloc(void* memory, std::size_t bytes) noexcept {
  note(bytes);
  return __libc_realloc(memory, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept {
  note(bytes);
  return __libc_memalign(alignment, bytes);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) noexcept {
  note(bytes);
  *memory = __libc_memalign(alignment, bytes);
  return *memory != nullptr ? 0 : ENOMEM;
}
}
#endif

namespace walr::test {
namespace {

std::uint64_t fromEnvironment(const char* variable, std::uint64_t otherwise) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace

std::size_t takeLargestRequest() {
  return largest.exchange(0);
}

std::size_t below(std::mt19937_64& random, std::size_t bound) {
  return static_cast<std::size_t>(random() % bound);
}

void tryDamagedFiles(const DamagedFiles& damaged) {
  const std::uint64_t files = fromEnvironment("WALR_FILES", damaged.files);
  const std::uint64_t first = fromEnvironment("WALR_SEED", 1);
  std::uint64_t read = 0;
  std::size_t largestOfAll = 0;
  double longest = 0.0;
  for (std::uint64_t seed = first; seed < first + files; ++seed) {
    std::mt19937_64 random(seed);
    takeLargestRequest();
    const std::clock_t begin = std::clock();  // The processor's time: other programs may hold this one up.
    try {
      read += damaged.read(random, seed) ? 1 : 0;
    } catch (const std::exception& error) {
      FAIL() << "seed " << seed << ": " << error.what();
    }
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const std::size_t request = takeLargestRequest();
    ASSERT_LE(request, damaged.largestRequest) << "seed " << seed;
    EXPECT_LT(seconds, 1.0) << "seed " << seed;
    largestOfAll = std::max(largestOfAll, request);
    longest = std::max(longest, seconds);
  }
  std::cout << files << " files, " << read << " of them read; largest request " << largestOfAll << " bytes, longest "
            << longest << " s of the processor\n";
  EXPECT_GT(read, files / 50);
  EXPECT_LT(read, files - files / 50);
}

}  // namespace walr::test
