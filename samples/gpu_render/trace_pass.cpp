#include "samples/gpu_render/trace_pass.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace walr::gpu_render {
namespace {

// The scene may have none of the elements, but a buffer has at least one.
template <typename T>
std::uint64_t bytesOf(std::size_t count) {
  return std::max<std::size_t>(count, 1) * sizeof(T);
}

template <typename T>
void upload(fg::vk::Executor& executor, fg::Buffer buffer, const std::vector<T>& values) {
  if (values.empty()) {
    executor.upload(buffer, T{});
  } else {
    executor.upload(buffer, std::as_bytes(std::span(values)));
  }
}

}  // namespace

VkFormat TracedTextures::format(Precision precision) {
  return precision == Precision::Half ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
}

TraceInputs declareTraceInputs(fg::Graph& graph, const GpuScene& scene) {
  return {graph.upload("objects", bytesOf<InstanceData>(scene.instances())),
          graph.upload("punctual lights", bytesOf<PunctualLightData>(scene.punctualLights())),
          graph.upload("emitters", bytesOf<EmitterData>(scene.emitters())),
          graph.upload("placements", bytesOf<VkAccelerationStructureInstanceKHR>(scene.placementCount())),
          graph.upload("trace constants", sizeof(TraceConstants))};
}

void addTrace(fg::Graph& graph, const GpuScene& scene, Precision precision, const TraceInputs& inputs,
              TracedTextures& textures) {
  struct Output {
    const char* binding;
    fg::Texture TracedTextures::*texture;
  };
  static constexpr std::array<Output, 11> kAll{{{"outDirect", &TracedTextures::direct},
                                                {"outIndirect", &TracedTextures::indirect},
                                                {"outNormal", &TracedTextures::normal},
                                                {"outAlbedo", &TracedTextures::albedo},
                                                {"outEmission", &TracedTextures::emission},
                                                {"outMotion", &TracedTextures::motion},
                                                {"outDepth", &TracedTextures::depth},
                                                {"outObjectId", &TracedTextures::objectId},
                                                {"outSpecular", &TracedTextures::specular},
                                                {"outSpecularAlbedo", &TracedTextures::specularAlbedo},
                                                {"outSpecularMotion", &TracedTextures::specularMotion}}};
  const std::span<const Output> outputs = std::span(kAll).first(scene.specular() ? 11 : 8);
  const fg::Extent extent = graph.textureDesc(textures.depth).extent;
  fg::PassBuilder pass = graph.callback(
      kTracePass, [&scene, precision, inputs, textures, extent, outputs](const fg::RecordContext& context) {
        scene.recordBuild(context.commandBuffer, context.buffer(inputs.placements));
        const TracePipeline& pipeline = scene.pipeline(precision);
        TracePipeline::Bindings bindings(pipeline);
        scene.bind(bindings);
        bindings.buffer("Trace", context.buffer(inputs.constants))
            .buffer("Instances", context.buffer(inputs.instances))
            .buffer("PunctualLights", context.buffer(inputs.punctualLights))
            .buffer("Emitters", context.buffer(inputs.emitters));
        for (const Output& output : outputs) bindings.image(output.binding, context.view(textures.*output.texture));
        pipeline.dispatch(context.commandBuffer, bindings, extent.width, extent.height);
      });
  pass.access(inputs.placements, fg::Access::TransferRead);
  pass.access(inputs.constants, fg::Access::UniformRead);
  for (const fg::Buffer buffer : {inputs.instances, inputs.punctualLights, inputs.emitters}) {
    pass.access(buffer, fg::Access::StorageRead);
  }
  for (const Output& output : outputs) {
    textures.*output.texture = pass.access(textures.*output.texture, fg::Access::StorageWrite);
  }
}

void uploadTrace(fg::vk::Executor& executor, const TraceInputs& inputs, const TraceData& data) {
  upload(executor, inputs.instances, data.state.instances);
  upload(executor, inputs.punctualLights, data.state.punctualLights);
  upload(executor, inputs.emitters, data.state.emitters);
  upload(executor, inputs.placements, data.placements);
  executor.upload(inputs.constants, data.constants);
}

}  // namespace walr::gpu_render
