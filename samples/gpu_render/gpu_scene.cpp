#include "samples/gpu_render/gpu_scene.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>

#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/memory_barrier.h"
#include "samples/gpu_render/shaders.h"
#include "samples/gpu_render/trace_frame.h"
#include "samples/render/scene_error.h"

namespace walr::gpu_render {
namespace {

constexpr VkPipelineStageFlags2 kBuild = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
constexpr VkPipelineStageFlags2 kTrace = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kCopy = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkAccessFlags2 kStructureRead = VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
constexpr VkAccessFlags2 kStructureWrite = VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;

constexpr VkBufferUsageFlags kBuildInputUsage =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

void requireRayQueries(const GpuDevice& gpu) {
  if (gpu.missingForRayQueries().empty()) return;
  throw fg::vk::Unsupported("the path tracer on the GPU needs ray queries; the device '" + gpu.name() + "' lacks " +
                            gpu.missingForRayQueries() + ": use --tracer cpu, or another --device");
}

VkTransformMatrixKHR rowsOf(const glm::mat4& matrix) {
  VkTransformMatrixKHR result{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) result.matrix[row][column] = matrix[column][row];
  }
  return result;
}

}  // namespace

// Copies arrays to the device while the scene is made.
class GpuScene::Upload {
 public:
  Upload(const fg::vk::DeviceContext& device, const RayFunctions& functions, VkCommandBuffer commandBuffer)
      : device_(device), functions_(functions), commandBuffer_(commandBuffer) {}

  template <typename T>
  DeviceBuffer copy(const std::vector<T>& values, VkBufferUsageFlags usage, const std::string& name) {
    const std::uint64_t size = values.size() * sizeof(T);
    DeviceBuffer buffer(device_, functions_, size, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::Device, name);
    if (size == 0) return buffer;
    const DeviceBuffer& staging = staging_.emplace_back(device_, functions_, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                        Placement::Staging, name + " staging");
    std::memcpy(staging.mapped(), values.data(), size);
    const VkBufferCopy region{0, 0, size};
    device_.functions.vkCmdCopyBuffer(commandBuffer_, staging.handle(), buffer.handle(), 1, &region);
    return buffer;
  }
  // Keep a buffer until the copies are done.
  const DeviceBuffer& keep(DeviceBuffer buffer) { return staging_.emplace_back(std::move(buffer)); }
  [[nodiscard]] VkCommandBuffer commandBuffer() const { return commandBuffer_; }

 private:
  const fg::vk::DeviceContext& device_;
  const RayFunctions& functions_;
  VkCommandBuffer commandBuffer_;
  std::vector<DeviceBuffer> staging_;
};

GpuScene::GpuScene(const GpuDevice& gpu, const render::World& world)
    : device_((requireRayQueries(gpu), gpu.device().context())),
      functions_(RayFunctions::load(device_)),
      specular_(world.scene().specular),
      instances_(world.instances().size()),
      punctualLights_(world.lights().punctual().size()),
      emitters_(emissiveTriangles(world)) {
  const SceneArrays arrays = sceneArrays(world);
  fg::vk::FrameQueue queue(device_, gpu.device().queue(), 1);
  const fg::vk::Frame frame = queue.begin();
  Upload upload(device_, functions_, frame.commandBuffer);
  uploadArrays(arrays, upload);
  buildStructures(world, arrays, upload);
  queue.submit(frame);
  queue.waitAll();
  still_.freeScratch();
  for (AccelerationStructure& structure : moving_) structure.freeScratch();
}

void GpuScene::uploadArrays(const SceneArrays& arrays, Upload& upload) {
  const auto add = [&](const char* binding, const auto& values, const char* what, VkBufferUsageFlags usage = 0) {
    const std::uint64_t bytes = values.size() * sizeof(values[0]);
    const std::uint64_t most = device_.properties.limits.maxStorageBufferRange;
    if (bytes > most) {
      throw render::SceneError(std::string("the scene's ") + what + " take " + std::to_string(bytes >> 20U) +
                               " MiB, but a buffer of the device holds at most " + std::to_string(most >> 20U) +
                               " MiB: use --tracer cpu, or smaller ones");
    }
    arrays_.push_back({binding, upload.copy(values, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | usage, what)});
  };
  add("Floats", arrays.floats, "vertices", kBuildInputUsage);
  add("Indices", arrays.indices, "triangles", kBuildInputUsage);
  add("Meshes", arrays.meshes, "meshes");
  add("Materials", arrays.materials, "materials");
  add("Textures", arrays.textures, "textures");
  add("Texels", arrays.texels, "images");
  add("ByteValues", arrays.byteValues, "values of bytes");
  add("StillInstances", arrays.stillInstances, "still objects");
  add("Sky", arrays.sky, "sky");
}

const DeviceBuffer& GpuScene::array(const char* binding) const {
  return std::ranges::find(arrays_, std::string_view(binding), &Array::binding)->buffer;
}

void GpuScene::buildStructures(const render::World& world, const SceneArrays& arrays, Upload& upload) {
  const render::Scene& scene = world.scene();
  // The custom index of a placement has 24 bits.
  constexpr std::size_t kMostInstances = (std::size_t{1} << 24U) - 1;
  if (instances_ > kMostInstances) {
    throw render::SceneError("the scene has more than 2^24 - 1 objects: use --tracer cpu, or fewer");
  }
  const auto triangles = [&](std::uint32_t mesh, VkDeviceAddress positions) {
    return TriangleGeometry{positions, static_cast<std::uint32_t>(scene.meshes[mesh].positions.size()),
                            array("Indices").address() + arrays.meshes[mesh].triangles * sizeof(std::uint32_t),
                            static_cast<std::uint32_t>(scene.meshes[mesh].triangles.size()),
                            !scene.materials[scene.meshes[mesh].material].alphaCutoff};
  };
  std::vector<glm::vec3> positions;  // Of the still instances, in world space.
  moving_.resize(scene.meshes.size());
  for (const render::Instance& instance : world.instances()) {
    if (!instance.moves) {
      for (const glm::vec3& position : scene.meshes[instance.mesh].positions) {
        positions.emplace_back(instance.worldFromObject * glm::vec4(position, 1.0F));
      }
    } else if (moving_[instance.mesh].handle() == VK_NULL_HANDLE) {
      const TriangleGeometry geometry =
          triangles(instance.mesh, array("Floats").address() + arrays.meshes[instance.mesh].positions * sizeof(float));
      moving_[instance.mesh] =
          AccelerationStructure(device_, functions_, {&geometry, 1}, "mesh '" + scene.meshes[instance.mesh].name + "'");
    }
    placementCount_ += instance.moves ? 1 : 0;
  }
  if (!positions.empty()) {
    const DeviceBuffer& placed = upload.keep(upload.copy(positions, kBuildInputUsage, "still vertices"));
    VkDeviceAddress next = placed.address();
    std::vector<TriangleGeometry> geometries;
    for (const std::uint32_t still : arrays.stillInstances) {
      const std::uint32_t mesh = world.instances()[still].mesh;
      geometries.push_back(triangles(mesh, next));
      next += scene.meshes[mesh].positions.size() * sizeof(glm::vec3);
    }
    still_ = AccelerationStructure(device_, functions_, geometries, "still objects");
    ++placementCount_;
  }
  placed_ = DeviceBuffer(device_, functions_, placementCount_ * sizeof(VkAccelerationStructureInstanceKHR),
                         kBuildInputUsage, Placement::Device, "placements");
  top_ = AccelerationStructure(device_, functions_, placed_.address(), static_cast<std::uint32_t>(placementCount_),
                               "scene");
  fg::vk::recordMemoryBarrier(device_, upload.commandBuffer(), {kCopy, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                              {kBuild | kTrace, VK_ACCESS_2_SHADER_READ_BIT});
  if (still_.handle() != VK_NULL_HANDLE) still_.build(upload.commandBuffer());
  for (const AccelerationStructure& structure : moving_) {
    if (structure.handle() != VK_NULL_HANDLE) structure.build(upload.commandBuffer());
  }
}

std::vector<VkAccelerationStructureInstanceKHR> GpuScene::placements(const render::World& world) const {
  std::vector<VkAccelerationStructureInstanceKHR> result;
  const auto add = [&](const glm::mat4& transform, std::size_t index, const AccelerationStructure& structure) {
    VkAccelerationStructureInstanceKHR& placement = result.emplace_back();
    placement = {};
    placement.transform = rowsOf(transform);
    placement.instanceCustomIndex = static_cast<std::uint32_t>(index) & 0xffffffU;
    placement.mask = 0xff;
    placement.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    placement.accelerationStructureReference = structure.address();
  };
  if (still_.handle() != VK_NULL_HANDLE) add(glm::mat4(1.0F), instances_, still_);
  for (std::size_t i = 0; i < instances_; ++i) {
    const render::Instance& instance = world.instances()[i];
    if (instance.moves) add(instance.worldFromObject, i, moving_[instance.mesh]);
  }
  return result;
}

void GpuScene::recordBuild(VkCommandBuffer commandBuffer, VkBuffer placements) const {
  const auto barrier = [&](const fg::ExternalState& before, const fg::ExternalState& after) {
    fg::vk::recordMemoryBarrier(device_, commandBuffer, before, after);
  };
  // The previous frame's build has read the copies, and its rays the structure.
  barrier({kBuild | kTrace, kStructureRead | kStructureWrite},
          {kBuild | kCopy, kStructureRead | kStructureWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT});
  const VkBufferCopy region{0, 0, placementCount_ * sizeof(VkAccelerationStructureInstanceKHR)};
  device_.functions.vkCmdCopyBuffer(commandBuffer, placements, placed_.handle(), 1, &region);
  barrier({kCopy, VK_ACCESS_2_TRANSFER_WRITE_BIT}, {kBuild, VK_ACCESS_2_SHADER_READ_BIT});
  top_.build(commandBuffer);
  barrier({kBuild, kStructureWrite}, {kTrace, kStructureRead});
}

void GpuScene::bind(TracePipeline::Bindings& bindings) const {
  bindings.structure("scene", top_.handle());
  for (const Array& array : arrays_) bindings.buffer(array.binding, array.buffer.handle());
}

void GpuScene::prepare(Precision precision) {
  auto& pipeline = pipelines_.at(static_cast<std::size_t>(precision));
  const fg::Shader& half = specular_ ? shaders::traceSpecularHalf : shaders::traceHalf;
  const fg::Shader& single = specular_ ? shaders::traceSpecularFloat : shaders::traceFloat;
  const fg::Shader& shader = precision == Precision::Half ? half : single;
  if (!pipeline) pipeline = std::make_unique<TracePipeline>(device_, functions_, shader);
}

const TracePipeline& GpuScene::pipeline(Precision precision) const {
  const auto& pipeline = pipelines_.at(static_cast<std::size_t>(precision));
  if (!pipeline) throw std::logic_error("the path tracer's shader was not prepared");
  return *pipeline;
}

std::uint64_t GpuScene::bytes() const {
  std::uint64_t sum = still_.bytes() + top_.bytes() + placed_.size();
  for (const Array& array : arrays_) sum += array.buffer.size();
  for (const AccelerationStructure& structure : moving_) sum += structure.bytes();
  return sum;
}

}  // namespace walr::gpu_render
