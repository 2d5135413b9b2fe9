#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "framegraph/vulkan/device_context.h"
#include "samples/gpu_render/device_buffer.h"
#include "samples/gpu_render/ray_functions.h"

namespace walr::gpu_render {

/// The triangles of one geometry, in buffers on the device.
struct TriangleGeometry {
  VkDeviceAddress positions = 0;  ///< 3 floats each, without padding.
  std::uint32_t vertices = 0;
  VkDeviceAddress indices = 0;  ///< 3 unsigned integers for a triangle.
  std::uint32_t triangles = 0;
  bool opaque = true;  ///< False: the shader decides for every hit whether it counts.
};

/// An acceleration structure with the memory to build it any number of times.
class AccelerationStructure {
 public:
  AccelerationStructure() = default;
  /// Of triangles.
  /// @param device  must outlive this
  AccelerationStructure(const fg::vk::DeviceContext& device, const RayFunctions& functions,
                        std::span<const TriangleGeometry> geometries, const std::string& name);
  /// Of instances.
  /// @param instances  address of `VkAccelerationStructureInstanceKHR`s
  AccelerationStructure(const fg::vk::DeviceContext& device, const RayFunctions& functions, VkDeviceAddress instances,
                        std::uint32_t count, const std::string& name);
  AccelerationStructure(AccelerationStructure&& other) noexcept { swap(other); }
  AccelerationStructure& operator=(AccelerationStructure&& other) noexcept {
    swap(other);
    return *this;
  }
  AccelerationStructure(const AccelerationStructure&) = delete;
  AccelerationStructure& operator=(const AccelerationStructure&) = delete;
  ~AccelerationStructure();

  [[nodiscard]] VkAccelerationStructureKHR handle() const { return handle_; }
  [[nodiscard]] VkDeviceAddress address() const { return address_; }
  [[nodiscard]] std::uint64_t bytes() const { return storage_.size() + scratch_.size(); }

  /// Record a build. The caller records the barriers: against earlier builds and uses before it, and for its result
  /// after.
  void build(VkCommandBuffer commandBuffer) const;
  /// Free the scratch memory of a structure that is not built again; the device must have finished the build.
  void freeScratch() { scratch_ = {}; }

 private:
  void create(const fg::vk::DeviceContext& device, VkAccelerationStructureTypeKHR type, const std::string& name);
  void swap(AccelerationStructure& other) noexcept;

  const fg::vk::DeviceContext* device_ = nullptr;
  const RayFunctions* functions_ = nullptr;
  VkAccelerationStructureTypeKHR type_{};
  std::vector<VkAccelerationStructureGeometryKHR> geometries_;
  std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges_;
  DeviceBuffer storage_;
  DeviceBuffer scratch_;
  VkDeviceAddress scratchAddress_ = 0;  // Aligned as the device asks.
  VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
  VkDeviceAddress address_ = 0;
};

}  // namespace walr::gpu_render
