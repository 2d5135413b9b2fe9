#include "tests/vulkan/random_graph.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

std::uint32_t hash(std::uint32_t x) {
  const std::uint32_t state = x * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

}  // namespace

/// A variant of mix.comp and its bindings.
struct RandomGraph::Variant {
  const Shader* shader = nullptr;
  std::uint32_t sampled = 0;
  bool loads = false;
  std::uint32_t stored = 0;
  bool updates = false;
  bool readsBuffer = false;
  bool writesBuffer = false;
  bool readsUniform = false;
};

const std::vector<RandomGraph::Variant>& RandomGraph::variants() {
  static const std::vector<Variant> all = {
      {.shader = &shaders::mixGenerate, .stored = 1, .readsUniform = true},
      {.shader = &shaders::mixSample1, .sampled = 1, .stored = 1},
      {.shader = &shaders::mixSample2, .sampled = 2, .stored = 1},
      {.shader = &shaders::mixSample3, .sampled = 3, .stored = 1},
      {.shader = &shaders::mixSample1Store2, .sampled = 1, .stored = 2},
      {.shader = &shaders::mixLoad, .loads = true, .stored = 1},
      {.shader = &shaders::mixSample1Load, .sampled = 1, .loads = true, .stored = 1},
      {.shader = &shaders::mixUpdate, .sampled = 1, .updates = true},
      {.shader = &shaders::mixUpdateStore, .stored = 1, .updates = true},
      {.shader = &shaders::mixToBuffer, .sampled = 2, .writesBuffer = true},
      {.shader = &shaders::mixFromBuffer, .stored = 1, .readsBuffer = true, .readsUniform = true},
  };
  return all;
}

RandomGraph::RandomGraph(std::uint32_t seed, const vk::DeviceFunctions& functions)
    : functions_(&functions), random_(seed) {
  frame_ = graph_.upload("frame", sizeof(std::uint32_t));
  remember(frame_);
  declareImports();
  declareHistories();
  const std::uint32_t passes = 1 + below(16);
  for (std::uint32_t i = 0; i < passes; ++i) addRandomPass();
  for (const History& history : histories_) finish(history.current.resource);
  for (const Texture output : outputs_) {
    finish(output.resource);
    graph_.exported(latest(output.resource), vk::kReadable);
  }
}

Extent RandomGraph::randomExtent() {
  static constexpr Extent kExtents[] = {{1, 1}, {7, 3}, {16, 16}, {33, 9}, {40, 24}};
  return kExtents[below(std::size(kExtents))];
}

Texture RandomGraph::latest(std::uint32_t resource) const {
  return {{resource, versions_[resource]}};
}

Extent RandomGraph::extentOf(std::uint32_t resource) const {
  return graph_.textureDesc(latest(resource)).extent;
}

void RandomGraph::remember(ResourceVersion version) {
  versions_.resize(graph_.desc().resources.size());
  values_.resize(graph_.desc().resources.size());
  versions_[version.resource] = version.version;
}

std::uint32_t RandomGraph::newTexture(Extent extent) {
  const Texture texture = graph_.texture(nextName("texture"), {VK_FORMAT_R32_UINT, extent});
  remember(texture);
  return texture.resource;
}

std::uint32_t RandomGraph::draw(const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& taken) {
  std::vector<std::uint32_t> free;
  std::ranges::copy_if(from, std::back_inserter(free),
                       [&](std::uint32_t resource) { return std::ranges::find(taken, resource) == taken.end(); });
  if (free.empty()) return kNone;
  return taken.emplace_back(free[below(static_cast<std::uint32_t>(free.size()))]);
}

void RandomGraph::declareImports() {
  for (std::uint32_t i = below(3); i > 0; --i) {
    const TextureDesc desc{VK_FORMAT_R32_UINT, randomExtent()};
    const Texture input = graph_.import(nextName("input"), desc, vk::kUploaded);
    remember(input);
    auto& texels = values_[input.resource];
    texels.resize(static_cast<std::size_t>(desc.extent.width) * desc.extent.height);
    std::ranges::generate(texels, std::ref(random_));
    readable_.push_back(input.resource);
    inputs_.push_back(input);
  }
  for (std::uint32_t i = 1 + below(3); i > 0; --i) {
    const Texture output = importOutput(graph_, nextName("output"), {VK_FORMAT_R32_UINT, randomExtent()});
    remember(output);
    outputs_.push_back(output);
  }
}

void RandomGraph::declareHistories() {
  for (std::uint32_t i = below(3); i > 0; --i) {
    const History history = graph_.history(nextName("history"), {VK_FORMAT_R32_UINT, randomExtent()});
    remember(history.previous);
    remember(history.current);
    readable_.push_back(history.previous.resource);
    histories_.push_back(history);
    resetHistoryOnCpu(history);
  }
}

void RandomGraph::addRandomPass() {
  if (chance(8)) return addClear();
  const Variant& variant = variants()[below(static_cast<std::uint32_t>(variants().size()))];
  const bool enoughToRead = readable_.size() >= variant.sampled + (variant.loads ? 1u : 0u) + 1u;
  const bool possible =
      enoughToRead && (!variant.updates || !writable_.empty()) && (!variant.readsBuffer || !buffers_.empty());
  const bool again = variant.stored == 1 && !variant.updates && !writable_.empty() && chance(3);
  const std::uint32_t target = again ? writable_[below(static_cast<std::uint32_t>(writable_.size()))] : kNone;
  addMix(possible ? variant : variants().front(), target);
}

void RandomGraph::finish(std::uint32_t target) {
  const Variant* variant = nullptr;
  do {
    variant = &variants()[1 + below(3)];  // The variants that sample one to three textures.
  } while (readable_.size() < variant->sampled && readable_.size() > 0);
  addMix(readable_.empty() ? variants().front() : *variant, target);
}

void RandomGraph::addClear() {
  const std::uint32_t resource = newTexture(randomExtent());
  const Texture texture = latest(resource);
  const std::uint32_t color = random_();
  auto pass = graph_.callback(nextName("clear"), [functions = functions_, texture, color](const RecordContext& record) {
    const VkClearColorValue value = {.uint32 = {color, color, color, color}};
    const VkImageSubresourceRange whole = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    functions->vkCmdClearColorImage(record.commandBuffer, record.image(texture), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                    &value, 1, &whole);
  });
  remember(pass.access(texture, Access::TransferWrite));
  readable_.push_back(resource);
  writable_.push_back(resource);
  Operation operation;
  operation.extent = extentOf(resource);
  operation.isClear = true;
  operation.seed = color;
  operation.writes.emplace_back(resource, 0);
  operations_.push_back(std::move(operation));
}

void RandomGraph::addMix(const Variant& variant, std::uint32_t target) {
  std::vector<std::uint32_t> taken;
  if (target != kNone) taken.push_back(target);
  const std::uint32_t updated = variant.updates ? draw(writable_, taken) : kNone;
  Operation operation;
  operation.extent = target != kNone ? extentOf(target) : updated != kNone ? extentOf(updated) : randomExtent();
  operation.seed = random_();
  const auto [width, height] = operation.extent;

  const bool indirect = chance(6);
  const Buffer arguments =
      indirect ? groupCount(graph_, nextName("arguments"), (width + 7) / 8, (height + 7) / 8) : Buffer{};
  auto pass = graph_.compute(nextName("pass"), *variant.shader);
  for (std::uint32_t i = 0; i < variant.sampled; ++i) {
    operation.reads.push_back(draw(readable_, taken));
    pass.sample("sampled" + std::to_string(i), latest(operation.reads.back()));
  }
  if (variant.loads) {
    operation.reads.push_back(draw(readable_, taken));
    pass.load("loaded0", latest(operation.reads.back()));
  }
  if (variant.readsBuffer) {
    operation.reads.push_back(draw(buffers_, taken));
    const std::uint32_t buffer = operation.reads.back();
    pass.load("bufferIn", Buffer{{buffer, versions_[buffer]}});
  }
  if (variant.readsUniform) {
    operation.reads.push_back(frame_.resource);
    pass.uniform("frame", frame_);
  }
  if (updated != kNone) {
    operation.reads.push_back(updated);
    operation.writes.emplace_back(updated, 1);
    remember(pass.update("updated0", latest(updated)));
  }
  for (std::uint32_t i = 0; i < variant.stored; ++i) {
    const std::uint32_t stored = i == 0 && target != kNone ? target : newTexture(operation.extent);
    operation.writes.emplace_back(stored, 2 + i);
    remember(pass.store("stored" + std::to_string(i), latest(stored)));
    if (stored == target) continue;
    readable_.push_back(stored);
    writable_.push_back(stored);
  }
  if (variant.writesBuffer) {
    const Buffer buffer = pass.store(
        "bufferOut", graph_.buffer(nextName("buffer"), {sizeof(std::uint32_t) * std::uint64_t{width} * height}));
    remember(buffer);
    buffers_.push_back(buffer.resource);
    operation.writes.emplace_back(buffer.resource, 4);
  }
  struct Push {
    std::uint32_t seed;
    std::uint32_t width;
    std::uint32_t height;
  };
  pass.constants(Push{operation.seed, width, height});
  if (indirect) {
    pass.dispatchIndirect(arguments);
  } else {
    pass.dispatch(operation.extent);
  }
  operations_.push_back(std::move(operation));
}

std::uint32_t RandomGraph::read(std::uint32_t resource, std::uint32_t x, std::uint32_t y, std::uint32_t index) const {
  const std::vector<std::uint32_t>& values = values_[resource];
  if (std::holds_alternative<BufferDesc>(graph_.desc().resources[resource].desc)) return values[index % values.size()];
  const Extent extent = extentOf(resource);
  return values[(y % extent.height) * extent.width + x % extent.width];
}

void RandomGraph::run(const Operation& operation) {
  const std::size_t count = static_cast<std::size_t>(operation.extent.width) * operation.extent.height;
  for (const auto& [resource, addend] : operation.writes) values_[resource].resize(count);
  for (std::uint32_t index = 0; index < count; ++index) {
    const std::uint32_t x = index % operation.extent.width;
    const std::uint32_t y = index / operation.extent.width;
    std::uint32_t value = operation.isClear ? operation.seed : hash(operation.seed + index);
    for (const std::uint32_t resource : operation.reads) value = hash(value ^ read(resource, x, y, index));
    for (const auto& [resource, addend] : operation.writes) values_[resource][index] = value + addend;
  }
}

void RandomGraph::runOnCpu(std::uint32_t frameValue) {
  values_[frame_.resource] = {frameValue};
  for (const Operation& operation : operations_) run(operation);
  for (const History& history : histories_) values_[history.previous.resource] = values_[history.current.resource];
}

void RandomGraph::resetHistoryOnCpu(const History& history) {
  const Extent extent = extentOf(history.previous.resource);
  values_[history.previous.resource].assign(static_cast<std::size_t>(extent.width) * extent.height, 0);
}

}  // namespace fg::test
