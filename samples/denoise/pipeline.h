#pragma once

#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

#include "samples/denoise/bounded_queue.h"

namespace walr {

/// Number of elements that may wait between two stages. A few are enough to hide an occasional slow element, and memory
/// does not grow with the length of the job.
inline constexpr std::size_t kPipelineDepth = 2;

/// Run three stages concurrently on three threads for the elements 0 to `count` - 1, in order. `process` and `drain`
/// run on the calling thread.
/// @param read     std::size_t -> Input
/// @param process  Input -> std::optional<Output>: takes an element, and returns a finished one if there is one
/// @param drain    () -> std::optional<Output>: after the last element, returns those that `process` still holds, then
///                 nullopt
/// @param write    Output -> void
/// @throws the first exception of a stage; the other stages stop after their current element
template <typename Read, typename Process, typename Drain, typename Write>
void runPipeline(std::size_t count, Read read, Process process, Drain drain, Write write) {
  using Input = std::invoke_result_t<Read, std::size_t>;
  using Output = typename std::invoke_result_t<Process, Input>::value_type;
  BoundedQueue<Input> inputs(kPipelineDepth);
  BoundedQueue<Output> outputs(kPipelineDepth);
  std::mutex mutex;
  std::exception_ptr firstError;

  const auto guarded = [&](auto&& stage) {
    try {
      stage();
    } catch (...) {
      {
        const std::lock_guard lock(mutex);
        if (!firstError) {
          firstError = std::current_exception();
        }
      }
      inputs.abandon();
      outputs.abandon();
    }
  };

  {
    const std::jthread reader([&] {
      guarded([&] {
        for (std::size_t i = 0; i < count && inputs.push(read(i)); ++i) {
        }
        inputs.close();
      });
    });
    const std::jthread writer([&] {
      guarded([&] {
        while (std::optional<Output> output = outputs.pop()) {
          write(std::move(*output));
        }
      });
    });
    guarded([&] {
      bool wanted = true;
      const auto hand = [&](std::optional<Output> output) {
        if (output) wanted = outputs.push(std::move(*output));
        return output.has_value();
      };
      while (wanted) {
        std::optional<Input> input = inputs.pop();
        if (!input) break;
        hand(process(std::move(*input)));
      }
      while (wanted && hand(drain())) {
      }
      outputs.close();
    });
  }
  if (firstError) {
    std::rethrow_exception(firstError);
  }
}

}  // namespace walr
