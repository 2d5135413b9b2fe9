#include "samples/gpu_render/acceleration_structure.h"

#include "framegraph/vulkan/error.h"

namespace walr::gpu_render {
namespace {

VkAccelerationStructureBuildGeometryInfoKHR buildInfo(VkAccelerationStructureTypeKHR type,
                                                      std::span<const VkAccelerationStructureGeometryKHR> geometries) {
  VkAccelerationStructureBuildGeometryInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
  info.type = type;
  info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = static_cast<std::uint32_t>(geometries.size());
  info.pGeometries = geometries.data();
  return info;
}

std::uint64_t scratchAlignment(const fg::vk::DeviceContext& device) {
  VkPhysicalDeviceAccelerationStructurePropertiesKHR structures{};
  structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &structures;
  device.instance.vkGetPhysicalDeviceProperties2(device.view.physicalDevice, &properties);
  return structures.minAccelerationStructureScratchOffsetAlignment;
}

}  // namespace

AccelerationStructure::AccelerationStructure(const fg::vk::DeviceContext& device, const RayFunctions& functions,
                                             std::span<const TriangleGeometry> geometries, const std::string& name)
    : functions_(&functions) {
  for (const TriangleGeometry& triangles : geometries) {
    VkAccelerationStructureGeometryKHR geometry{};
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = triangles.opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : 0;
    VkAccelerationStructureGeometryTrianglesDataKHR& data = geometry.geometry.triangles;
    data.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
    data.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    data.vertexData.deviceAddress = triangles.positions;
    data.vertexStride = 3 * sizeof(float);
    data.maxVertex = triangles.vertices == 0 ? 0 : triangles.vertices - 1;
    data.indexType = VK_INDEX_TYPE_UINT32;
    data.indexData.deviceAddress = triangles.indices;
    geometries_.push_back(geometry);
    ranges_.push_back({triangles.triangles, 0, 0, 0});
  }
  create(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, name);
}

AccelerationStructure::AccelerationStructure(const fg::vk::DeviceContext& device, const RayFunctions& functions,
                                             VkDeviceAddress instances, std::uint32_t count, const std::string& name)
    : functions_(&functions) {
  VkAccelerationStructureGeometryKHR geometry{};
  geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  geometry.geometry.instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
  geometry.geometry.instances.data.deviceAddress = instances;
  geometries_.push_back(geometry);
  ranges_.push_back({count, 0, 0, 0});
  create(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, name);
}

void AccelerationStructure::create(const fg::vk::DeviceContext& device, VkAccelerationStructureTypeKHR type,
                                   const std::string& name) {
  device_ = &device;
  type_ = type;
  const VkAccelerationStructureBuildGeometryInfoKHR info = buildInfo(type, geometries_);
  std::vector<std::uint32_t> counts;
  for (const VkAccelerationStructureBuildRangeInfoKHR& range : ranges_) counts.push_back(range.primitiveCount);
  VkAccelerationStructureBuildSizesInfoKHR sizes{};
  sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
  functions_->vkGetAccelerationStructureBuildSizesKHR(
      device.view.device, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, counts.data(), &sizes);
  storage_ = DeviceBuffer(device, *functions_, sizes.accelerationStructureSize,
                          VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR, Placement::Device, name);
  const std::uint64_t alignment = scratchAlignment(device);
  scratch_ = DeviceBuffer(device, *functions_, sizes.buildScratchSize + alignment, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                          Placement::Device, name + " scratch");
  scratchAddress_ = (scratch_.address() + alignment - 1) / alignment * alignment;
  VkAccelerationStructureCreateInfoKHR createInfo{};
  createInfo.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
  createInfo.buffer = storage_.handle();
  createInfo.size = sizes.accelerationStructureSize;
  createInfo.type = type;
  fg::vk::check(
      functions_->vkCreateAccelerationStructureKHR(device.view.device, &createInfo, device.view.allocator, &handle_),
      "creating the acceleration structure '" + name + "'");
  device.setName(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, handle_, name);
  VkAccelerationStructureDeviceAddressInfoKHR addressInfo{};
  addressInfo.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
  addressInfo.accelerationStructure = handle_;
  address_ = functions_->vkGetAccelerationStructureDeviceAddressKHR(device.view.device, &addressInfo);
}

AccelerationStructure::~AccelerationStructure() {
  if (handle_ == VK_NULL_HANDLE) return;
  functions_->vkDestroyAccelerationStructureKHR(device_->view.device, handle_, device_->view.allocator);
}

void AccelerationStructure::build(VkCommandBuffer commandBuffer) const {
  VkAccelerationStructureBuildGeometryInfoKHR info = buildInfo(type_, geometries_);
  info.dstAccelerationStructure = handle_;
  info.scratchData.deviceAddress = scratchAddress_;
  const VkAccelerationStructureBuildRangeInfoKHR* const ranges = ranges_.data();
  functions_->vkCmdBuildAccelerationStructuresKHR(commandBuffer, 1, &info, &ranges);
}

void AccelerationStructure::swap(AccelerationStructure& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(functions_, other.functions_);
  std::swap(type_, other.type_);
  std::swap(geometries_, other.geometries_);
  std::swap(ranges_, other.ranges_);
  std::swap(storage_, other.storage_);
  std::swap(scratch_, other.scratch_);
  std::swap(scratchAddress_, other.scratchAddress_);
  std::swap(handle_, other.handle_);
  std::swap(address_, other.address_);
}

}  // namespace walr::gpu_render
