#include "samples/denoise/pipeline.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace walr {
namespace {

constexpr auto kIdentity = [](auto element) { return element; };
constexpr auto kAtOnce = [](auto element) { return std::optional(element); };
/// A `drain` for stages that hold no elements.
template <typename Output>
std::optional<Output> noMore() {
  return std::nullopt;
}

TEST(Pipeline, HandsEveryElementThroughInOrder) {
  std::vector<std::string> written;
  runPipeline(
      5, [](std::size_t i) { return static_cast<int>(i); }, [](int i) { return std::optional(std::to_string(i * i)); },
      noMore<std::string>, [&](std::string text) { written.push_back(std::move(text)); });
  EXPECT_EQ(written, (std::vector<std::string>{"0", "1", "4", "9", "16"}));
}

TEST(Pipeline, HandsOnWhatAStageHoldsBack) {
  std::deque<std::size_t> held;
  const auto oldest = [&]() -> std::optional<std::size_t> {
    if (held.empty()) return std::nullopt;
    const std::size_t element = held.front();
    held.pop_front();
    return element;
  };
  for (const std::size_t count : {1U, 3U, 9U}) {
    std::vector<std::size_t> written;
    const auto process = [&](std::size_t element) {
      const std::optional<std::size_t> done = held.size() == 3 ? oldest() : std::nullopt;
      held.push_back(element);
      return done;
    };
    runPipeline(count, kIdentity, process, oldest, [&](std::size_t element) { written.push_back(element); });
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(written, all);
  }
}

TEST(Pipeline, AnEmptyJobEnds) {
  runPipeline(0, kIdentity, kAtOnce, noMore<std::size_t>, [](std::size_t) { FAIL(); });
}

TEST(Pipeline, HoldsFewElementsHoweverLongTheJob) {
  std::atomic<int> alive = 0;
  std::atomic<int> most = 0;
  const auto make = [&](std::size_t) {
    const int now = ++alive;
    most = std::max(most.load(), now);
    return std::shared_ptr<int>(new int(0), [&](const int* element) {
      delete element;
      --alive;
    });
  };
  // The slowest stage is the last, so that the queues before it fill up.
  runPipeline(200, make, kAtOnce, noMore<std::shared_ptr<int>>,
              [](const std::shared_ptr<int>&) { std::this_thread::sleep_for(std::chrono::microseconds(200)); });
  // Two queues, and one element in each of the three stages.
  EXPECT_LE(most, 2 * static_cast<int>(kPipelineDepth) + 3);
  EXPECT_EQ(alive, 0);
}

TEST(Pipeline, StagesOverlap) {
  using namespace std::chrono_literals;
  const auto slow = [](auto element) {
    std::this_thread::sleep_for(10ms);
    return element;
  };
  const auto start = std::chrono::steady_clock::now();
  runPipeline(
      20, slow, [&](std::size_t element) { return std::optional(slow(element)); }, noMore<std::size_t>,
      [&](std::size_t element) { slow(element); });
  // In sequence the stages would take 600 ms, concurrently 220 ms.
  EXPECT_LT(std::chrono::steady_clock::now() - start, 500ms);
}

class FailingStage : public testing::TestWithParam<int> {};

TEST_P(FailingStage, StopsTheOthersAndIsReported) {
  const auto stage = [](int number) {
    return [number](std::size_t element) {
      if (GetParam() == number && element == 3) {
        throw std::runtime_error("stage " + std::to_string(number));
      }
      return element;
    };
  };
  std::size_t written = 0;
  try {
    const auto process = [middle = stage(1)](std::size_t element) { return std::optional(middle(element)); };
    runPipeline(1000, stage(0), process, noMore<std::size_t>, [&, write = stage(2)](std::size_t element) {
      write(element);
      ++written;
    });
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), "stage " + std::to_string(GetParam()));
  }
  EXPECT_LE(written, 3U);
}

INSTANTIATE_TEST_SUITE_P(EachStage, FailingStage, testing::Values(0, 1, 2));

}  // namespace
}  // namespace walr
