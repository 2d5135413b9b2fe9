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

/// Elements that may wait between two stages: enough to hide a slow one now and then, and few enough that memory stays
/// small whatever the length of the job.
inline constexpr std::size_t kPipelineDepth = 2;

/// Run three stages side by side on three threads, in order, for the elements 0 to `count` - 1. `process` and `drain`
/// run on the calling thread.
/// @param read     std::size_t -> Input
/// @param process  Input -> std::optional<Output>: takes an element, and gives one that is done where there is one
/// @param drain    () -> std::optional<Output>: after the last element, what `process` still holds, until there is none
/// @param write    Output -> void
/// @throws whatever a stage threw first; the others stop after the element they are at
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
