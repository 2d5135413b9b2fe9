#include "tests/passes/walr_run.h"

#include <stdexcept>
#include <string>
#include <utility>

#include <glm/gtc/packing.hpp>

#include "shaders/temporal/antilag.h"
#include "tests/passes/texel_codec.h"

namespace walr::test {
namespace {

using fg::vk::kOverwritable;
using fg::vk::kReadable;
using fg::vk::kUploaded;

/// The last version of the resource of this name; invalid where there is none.
fg::Texture findTexture(const fg::Graph& graph, const std::string& name) {
  const auto& resources = graph.desc().resources;
  for (std::uint32_t i = 0; i < resources.size(); ++i) {
    if (resources[i].name == name) return {{i, resources[i].versions}};
  }
  return {};
}

/// A guide by its name, with or without history.
fg::Texture findGuide(const fg::Graph& graph, const std::string& name) {
  const fg::Texture kept = findTexture(graph, name + ".current");
  return kept.valid() ? kept : findTexture(graph, name);
}

fg::Texture textureNamed(const fg::Graph& graph, const std::string& name) {
  const fg::Texture texture = findTexture(graph, name);
  if (!texture.valid()) throw std::logic_error("the graph has no texture named \"" + name + "\"");
  return texture;
}

std::size_t momentTextures(MomentStorage storage) {
  switch (storage) {
    case MomentStorage::Centred16:
    case MomentStorage::Raw11:
      return 2;
    case MomentStorage::Raw16:
      return 3;
    case MomentStorage::Raw32:
      return 4;
  }
  return 0;
}

fg::Extent extentOf(glm::ivec2 size) {
  return {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)};
}

}  // namespace

WalrRun::WalrRun(const fg::test::TestDevice& device, glm::ivec2 size, AnyWalr settings,
                 const InputConventions& conventions, bool inspect, const SceneDescription& scene,
                 const std::vector<std::string>& views)
    : size_(size),
      settings_(std::move(settings)),
      copyImage_(reinterpret_cast<PFN_vkCmdCopyImage>(
          device.context().instance.vkGetDeviceProcAddr(device.context().view.device, "vkCmdCopyImage"))),
      inspect_(inspect) {
  settings_.change([](auto& s) { s.fitWindow = false; });
  const fg::Extent extent = extentOf(size);
  const fg::TextureDesc halves{VK_FORMAT_R16G16B16A16_SFLOAT, extent};
  fg::Graph graph;
  const fg::Extent lightExtent = conventions.light.lightingExtent(extent);
  inputs_.lighting = graph.import("lighting", {halves.format, lightExtent}, kUploaded);
  inputs_.depth = graph.import("depth", {VK_FORMAT_R32_SFLOAT, extent}, kUploaded);
  inputs_.normal = graph.import("normal", halves, kUploaded);
  inputs_.motion = graph.import("motion", halves, kUploaded);
  inputs_.albedo = graph.import("albedo", halves, kUploaded);
  inputs_.frame = graph.upload("frame", sizeof(FrameConstants));
  inputs_.conventions = conventions;
  inputs_.scene = scene;
  const fg::Texture output = graph.import("output", halves, kOverwritable);

  for (const std::string& view : views)
    inspection_.want(view, graph.import("view of " + view, {kViewFormat, extent}, kOverwritable));
  const StageGraph inspected(graph, inspection_);
  output_ = settings_.blocks() != nullptr ? addWalr(inspected, inputs_, output, *settings_.blocks())
                                          : addWalrPaper(inspected, inputs_, output, *settings_.pixels());
  inspection_.requireViews();
  for (const DebugView& view : inspection_.views()) graph.exported(view.texture, kReadable);
  graph.exported(output_, kReadable);
  if (inspect) inspectStages(graph);
  run_ = std::make_unique<fg::test::GraphRun>(device, graph, fg::vk::ExecutorOptions{.shared = device.pipelines()});
}

void WalrRun::inspectStages(fg::Graph& graph) {
  constexpr std::array kMomentNames{"moments a ", "moments b ", "moments c ", "moments d "};
  depth_ = tap(graph, findGuide(graph, "guides.depth"));
  const WalrPaperSettings* const pixels = settings_.pixels();
  if (pixels != nullptr) {
    shadingNormal_ = tap(graph, textureNamed(graph, "guides.shading normal"));
  } else {
    features_ = tap(graph, textureNamed(graph, "guides.features"));
  }
  const fg::Texture geometricNormal = findGuide(graph, "guides.geometric normal");
  if (geometricNormal.valid()) geometricNormal_ = tap(graph, geometricNormal);
  const fg::Texture onGrid = findTexture(graph, "accumulated on the light grid.current");
  accumulated_ = tap(graph, onGrid.valid() ? onGrid : textureNamed(graph, "accumulated.current"));
  if (settings_.accumulation().antilag.enabled) {
    antilagTiles_ = tap(graph, textureNamed(graph, "antilag.tiles"));
    antilag_ = tap(graph, textureNamed(graph, "antilag.factor.current"));
  }
  for (std::uint32_t t = 0; pixels != nullptr && t + 1 < pixels->regression.iterations; ++t) {
    const std::string number = std::to_string(t);
    Iteration iteration;
    for (std::size_t i = 0; i < momentTextures(pixels->regression.storage); ++i)
      iteration.moments.push_back(tap(graph, textureNamed(graph, kMomentNames.at(i) + number)));
    iteration.depth = tap(graph, textureNamed(graph, "depth and edges " + number));
    iterations_.push_back(iteration);
  }
  filtered_ = tap(graph, textureNamed(graph, "filtered"));
  resolved_ = tap(graph, textureNamed(graph, "resolved.current"));
}

fg::Texture WalrRun::tap(fg::Graph& graph, fg::Texture texture) {
  const fg::TextureDesc desc = graph.textureDesc(texture);
  const std::string name = "copy of " + graph.desc().resources[texture.resource].name;
  fg::Texture copy = graph.import(name, desc, kOverwritable);
  fg::PassBuilder pass =
      graph.callback(name, [copyImage = copyImage_, texture, copy, desc](const fg::RecordContext& c) {
        const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        const VkImageCopy region{layers, {}, layers, {}, {desc.extent.width, desc.extent.height, 1}};
        copyImage(c.commandBuffer, c.image(texture), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, c.image(copy),
                  VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
      });
  pass.access(texture, fg::Access::TransferRead);
  copy = pass.access(copy, fg::Access::TransferWrite);
  graph.exported(copy, kReadable);
  return copy;
}

WalrStages WalrRun::frame(const reference::HostFrame& frame) {
  run_->fill(inputs_.lighting, encodeLighting(frame));
  run_->fill(inputs_.depth, encodeFloats(frame.depth));
  run_->fill(inputs_.normal, encodeHalves(frame.normal));
  run_->fill(inputs_.motion, encodeHalves(frame.motion));
  run_->fill(inputs_.albedo, encodeHalves(frame.albedo));
  run_->executor().upload(inputs_.frame, frame.constants);
  run_->frame();

  const auto halves = [&](fg::Texture t) { return decodeHalves(run_->texels<std::uint16_t>(t), size_); };
  const auto words = [&](fg::Texture t) { return run_->texels<std::uint32_t>(t); };
  const auto wordsIfAny = [&](fg::Texture t) { return t.valid() ? words(t) : std::vector<std::uint32_t>(); };
  WalrStages stages;
  stages.outputBits = run_->texels<std::uint16_t>(output_);
  stages.output = decodeHalves(stages.outputBits, size_);
  for (const DebugView& view : inspection_.views()) {
    const std::vector<float> texels = run_->texels<float>(view.texture);
    reference::Image<glm::dvec3>& image = stages.views[view.name] = reference::Image<glm::dvec3>(size_);
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
      image.pixels()[i] = {texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]};
  }
  if (!inspect_) return stages;
  stages.guides = decodeGuides({.depth = words(depth_),
                                .shadingNormal = wordsIfAny(shadingNormal_),
                                .features = wordsIfAny(features_),
                                .geometricNormal = wordsIfAny(geometricNormal_)},
                               size_);
  const bool packedPictures = settings_.packsAntialiasing();
  const double longest = settings_.antialiasing().maxHistory;
  if (settings_.packsAccumulation()) {
    const std::vector<std::uint32_t> texels = words(accumulated_);
    stages.onLightGrid = texels.size() != stages.guides.pixels().size();
    stages.accumulated = stages.onLightGrid ? decodeLightGrid(texels, frame) : decodeAccumulated(texels, size_);
  } else {
    stages.accumulated = halves(accumulated_);
  }
  if (antilag_.valid()) {
    const glm::ivec2 tiles = (size_ + kAntilagTile - 1) / kAntilagTile;
    const std::vector<float> sums = run_->texels<float>(antilagTiles_);
    const std::vector<std::uint16_t> antilag = run_->texels<std::uint16_t>(antilag_);
    stages.antilagTiles = reference::Image<glm::dvec2>(tiles);
    stages.antilag = reference::Image<double>(tiles);
    const std::size_t count = stages.antilag.pixels().size(), channels = antilag.size() / count;
    for (std::size_t i = 0; i < count; ++i) {
      stages.antilagTiles.pixels()[i] = {sums[4 * i], sums[4 * i + 1]};
      stages.antilag.pixels()[i] = double(glm::unpackHalf1x16(antilag[channels * i]));
    }
  }
  for (const Iteration& iteration : iterations_) {
    std::vector<std::vector<std::uint32_t>> textures;
    for (const fg::Texture& texture : iteration.moments) textures.push_back(words(texture));
    reference::AtrousState state{decodeMoments(settings_.pixels()->regression.storage, textures, size_),
                                 reference::Image<int>(size_)};
    const std::vector<std::uint32_t> depth = words(iteration.depth);
    for (std::size_t i = 0; i < depth.size(); ++i) state.distances.pixels()[i] = decodeEdgeDistance(depth[i]);
    stages.iterations.push_back(std::move(state));
  }
  stages.filtered = packedPictures ? decodeFiltered(words(filtered_), size_) : halves(filtered_);
  stages.resolved = packedPictures ? decodeResolved(words(resolved_), longest, size_) : halves(resolved_);
  return stages;
}

}  // namespace walr::test
