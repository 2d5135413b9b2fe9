#include "samples/render/tiles.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace walr::render {

void forEachTile(std::uint32_t width, std::uint32_t height, unsigned int threads,
                 const std::function<void(const Tile&)>& work, const std::function<void(std::uint64_t)>& pixelsDone) {
  // Small enough to balance the load of threads, large enough to make the cost of scheduling negligible.
  constexpr std::uint32_t kSide = 16;
  const std::uint32_t columns = (width + kSide - 1) / kSide;
  const std::uint32_t rows = (height + kSide - 1) / kSide;
  std::atomic<std::uint32_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    for (std::uint32_t tile = next++; tile < columns * rows; tile = next++) {
      const std::uint32_t x0 = tile % columns * kSide;
      const std::uint32_t y0 = tile / columns * kSide;
      const Tile area{x0, y0, std::min(x0 + kSide, width), std::min(y0 + kSide, height)};
      try {
        work(area);
        const std::lock_guard lock(mutex);
        pixelsDone(std::uint64_t{area.x1 - area.x0} * (area.y1 - area.y0));
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = failure ? failure : std::current_exception();
        next = columns * rows;
      }
    }
  };
  const unsigned int wanted = threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  const unsigned int count = std::min(wanted, columns * rows);
  {
    std::vector<std::jthread> workers;
    for (unsigned int i = 1; i < count; ++i) {
      workers.emplace_back(run);
    }
    run();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace walr::render
