#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "samples/denoise/gpu_device.h"
#include "samples/gpu_render/acceleration_structure.h"
#include "samples/gpu_render/device_buffer.h"
#include "samples/gpu_render/ray_functions.h"
#include "samples/gpu_render/scene_arrays.h"
#include "samples/gpu_render/trace_pipeline.h"
#include "samples/render/world.h"

namespace walr::gpu_render {

/// Formats of the traced images.
enum class Precision : std::uint8_t {
  Half,   ///< RGBA16F: the formats of the denoiser's inputs.
  Float,  ///< RGBA32F.
};

/// A scene on a GPU, ready to be traced. Like `render::RayCaster`, it has one acceleration structure in world space for
/// all still instances, and one in object space for each mesh that moves. Their instances form the top-level structure,
/// which is built anew in every frame in which something moves. Meshes do not change their shape.
class GpuScene {
 public:
  /// @param gpu    with `GpuDevice::Options::rayQueries`; must outlive this
  /// @param world  its scene, and the transforms of still instances; not needed afterwards
  /// @throws fg::vk::Unsupported naming what the device lacks for ray queries
  /// @throws render::SceneError naming a part of the scene that exceeds a limit of the device
  GpuScene(const GpuDevice& gpu, const render::World& world);

  /// The instances of the top-level structure for the world's current transforms, always of the same number.
  [[nodiscard]] std::vector<VkAccelerationStructureInstanceKHR> placements(const render::World& world) const;

  /// Record the build of the top-level structure.
  /// @param placements  buffer with `placements`, readable by copies
  void recordBuild(VkCommandBuffer commandBuffer, VkBuffer placements) const;

  /// The descriptors of the scene's parts that do not change.
  void bind(TracePipeline::Bindings& bindings) const;
  /// Compile the shader for a precision, unless that is done. A driver may take long for it.
  void prepare(Precision precision);
  /// @throws std::logic_error unless the precision was prepared
  [[nodiscard]] const TracePipeline& pipeline(Precision precision) const;

  [[nodiscard]] const fg::vk::DeviceContext& device() const { return device_; }
  /// Whether frames hold specular light.
  [[nodiscard]] bool specular() const { return specular_; }
  /// Numbers of array elements that change from frame to frame.
  [[nodiscard]] std::size_t instances() const { return instances_; }
  [[nodiscard]] std::size_t punctualLights() const { return punctualLights_; }
  [[nodiscard]] std::size_t emitters() const { return emitters_; }
  [[nodiscard]] std::size_t placementCount() const { return placementCount_; }
  /// Device memory of the scene, bytes.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  struct Array {
    const char* binding;
    DeviceBuffer buffer;
  };
  class Upload;

  void uploadArrays(const SceneArrays& arrays, Upload& upload);
  void buildStructures(const render::World& world, const SceneArrays& arrays, Upload& upload);
  [[nodiscard]] const DeviceBuffer& array(const char* binding) const;

  const fg::vk::DeviceContext& device_;
  RayFunctions functions_;
  bool specular_;
  std::size_t instances_;
  std::size_t punctualLights_;
  std::size_t emitters_;
  std::size_t placementCount_ = 0;
  std::vector<Array> arrays_;
  AccelerationStructure still_;                // Without a handle if everything moves.
  std::vector<AccelerationStructure> moving_;  // Per mesh; without a handle if no instance of it moves.
  DeviceBuffer placed_;                        // What the top-level structure is built from.
  AccelerationStructure top_;
  std::array<std::unique_ptr<TracePipeline>, 2> pipelines_;  // By precision; null until `prepare`.
};

}  // namespace walr::gpu_render
