#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "framegraph/declare/graph.h"

namespace walr::costs {

/// What the driver's compiler says of one compute pipeline.
struct CompiledShader {
  std::uint64_t vectorRegisters = 0;  ///< Per thread.
  std::uint64_t sharedBytes = 0;      ///< LDS per work group.
  std::uint64_t spills = 0;           ///< Scalar and vector registers.
  std::uint64_t scratchBytes = 0;     ///< Per wave.
  std::uint64_t waves = 0;            ///< Waves of 64 threads that a SIMD holds at a time, 16 at most.
  std::uint64_t instructions = 0;
  std::uint64_t inverseThroughput = 0;  ///< ACO's own guess of a wave's cycles, which knows no trip counts.
  std::string assembly;
};

/// Select Mesa's driver for AMD GPUs and, if the environment names no family of GPUs, Navi 21. Only before the process
/// first calls Vulkan.
/// @returns false if the driver is not installed
bool selectRadv();

/// Thrown where the driver has no null device.
class NoNullDevice : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A device of Mesa's driver for AMD GPUs that is no hardware: it compiles pipelines and can do nothing else.
class NullDevice {
 public:
  /// @throws NoNullDevice
  /// @throws std::runtime_error naming the call that failed, or the device that is none of Mesa's null devices
  NullDevice();
  ~NullDevice();
  NullDevice(const NullDevice&) = delete;
  NullDevice& operator=(const NullDevice&) = delete;

  /// "Mesa 22.3.6", without the distribution's own version.
  [[nodiscard]] const std::string& driver() const { return driver_; }
  /// "NAVI21".
  [[nodiscard]] const std::string& family() const { return family_; }
  /// @throws std::runtime_error naming the shader and the call that failed, or a pipeline of several executables
  /// A pipeline that was compiled before is not compiled again.
  [[nodiscard]] const CompiledShader& compile(const fg::ComputeDispatch& dispatch);

 private:
  [[nodiscard]] CompiledShader compileNew(const fg::ComputeDispatch& dispatch) const;
  [[nodiscard]] CompiledShader describe(VkPipeline pipeline, const std::string& shader) const;

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  std::uint64_t smallestWave_ = 0;  ///< Threads: RADV counts in waves of so many.
  std::string driver_;
  std::string family_;
  std::map<std::pair<const fg::Shader*, std::vector<std::uint32_t>>, CompiledShader> compiled_;
};

}  // namespace walr::costs
