#include "tests/framegraph/random_graph.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <string>
#include <utility>

namespace fg::test {
namespace {

constexpr ExternalState kComputeWritten = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                           VK_IMAGE_LAYOUT_GENERAL};
constexpr ExternalState kComputeSampled = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
constexpr ExternalState kFragmentSampled = {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                            VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
constexpr ExternalState kWaitedFor = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_GENERAL};
constexpr ExternalState kCopied = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
/// The C API's default release.
constexpr ExternalState kAnyCommand = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                       VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                                       VK_IMAGE_LAYOUT_GENERAL};
constexpr ExternalState kSampledAnywhere = {
    VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT,
    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
constexpr std::array kStates = {kComputeWritten, kComputeSampled, kFragmentSampled, kWaitedFor,
                                kCopied,         kAnyCommand,     kSampledAnywhere};

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  Graph run(const RandomGraphLimits& limits) {
    declareResources();
    const std::uint32_t passes = limits.minPasses + below(limits.maxPasses - limits.minPasses + 1);
    for (std::uint32_t i = 0; i < passes; ++i) addPass();
    finishHistories();
    exportSome();
    return std::move(graph_);
  }

 private:
  struct TextureState {
    Texture handle;
    TextureDesc desc;
    bool history = false;
    bool exported = false;
  };
  struct BufferState {
    Buffer handle;
    bool readOnly = false;
    bool exported = false;
  };

  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_() % limit); }
  bool chance(std::uint32_t percent) { return below(100) < percent; }
  std::string name(const char* kind) { return kind + std::to_string(names_++); }

  TextureDesc randomDesc() {
    constexpr std::array kFormats = {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM,
                                     VK_FORMAT_R32G32B32A32_SFLOAT};
    constexpr std::array kExtents = {Extent{64, 32}, Extent{32, 16}, Extent{40, 24}, Extent{16, 16}};
    TextureDesc desc{kFormats[below(kFormats.size())], kExtents[below(kExtents.size())]};
    if (chance(15)) desc.mipLevels = 1 + below(4);
    if (chance(10)) desc.arrayLayers = 1 + below(3);
    return desc;
  }

  void declareResources() {
    for (std::uint32_t i = 0, count = below(3); i < count; ++i) {
      const TextureDesc desc = randomDesc();
      readable_.push_back({graph_.import(name("import"), desc, kStates[below(kStates.size())]), desc});
    }
    for (std::uint32_t i = 0, count = below(3); i < count; ++i) {
      const TextureDesc desc = randomDesc();
      const History history = graph_.history(name("history"), desc);
      previous_.push_back({history.previous, desc, true});
      unwritten_.push_back({history.current, desc, true});
    }
    if (chance(60)) buffers_.push_back({graph_.upload(name("upload"), 64 + below(4) * 64), true});
    if (chance(40)) buffers_.push_back({graph_.import(name("bufferImport"), BufferDesc{256}, kComputeWritten)});
  }

  /// The index of a handle that no access of this pass uses; -1 if there is none.
  template <typename State>
  int pick(const std::vector<State>& from) {
    if (from.empty()) return -1;
    const std::uint32_t index = below(static_cast<std::uint32_t>(from.size()));
    const std::uint32_t resource = from[index].handle.resource;
    if (std::ranges::find(touched_, resource) != touched_.end()) return -1;
    touched_.push_back(resource);
    return static_cast<int>(index);
  }

  Access randomRead() {
    constexpr std::array kReads = {Access::SampledRead, Access::SampledRead, Access::StorageRead, Access::TransferRead,
                                   Access::FragmentSampledRead};
    return kReads[below(kReads.size())];
  }
  Access randomWrite() {
    constexpr std::array kWrites = {Access::StorageWrite, Access::StorageWrite, Access::TransferWrite,
                                    Access::ColorWrite};
    return onceAnAttachment(kWrites[below(kWrites.size())]);
  }
  /// Attachments of one pass must have the same extent, so that a pass here has at most one.
  Access onceAnAttachment(Access access) {
    if (access != Access::ColorWrite && access != Access::ColorReadWrite) return access;
    if (std::exchange(hasAttachment_, true))
      return access == Access::ColorWrite ? Access::StorageWrite : Access::StorageReadWrite;
    return access;
  }

  SubresourceRange randomRange(const TextureDesc& desc) {
    SubresourceRange range;
    if (desc.mipLevels > 1 && chance(60)) range = {below(desc.mipLevels), 1, 0, VK_REMAINING_ARRAY_LAYERS};
    if (desc.arrayLayers > 1 && chance(40)) {
      range.baseLayer = below(desc.arrayLayers);
      range.layerCount = 1;
    }
    return range;
  }

  void addPass() {
    touched_.clear();
    hasAttachment_ = false;
    PassBuilder pass = graph_.callback(name("pass"), [](const RecordContext&) {});
    for (std::uint32_t i = 0, count = below(4); i < count; ++i) readTexture(pass);
    if (chance(30)) readBuffer(pass);
    for (std::uint32_t i = 0, count = 1 + (chance(25) ? 1 : 0); i < count; ++i) writeTexture(pass);
    if (chance(25)) writeBuffer(pass);
    if (chance(3)) pass.sideEffects();
  }

  void readTexture(PassBuilder& pass) {
    const std::vector<TextureState>& from = chance(25) ? previous_ : readable_;
    const int index = pick(from);
    if (index < 0) return;
    const TextureState& state = from[static_cast<std::size_t>(index)];
    pass.access(state.handle, randomRead(), randomRange(state.desc));
  }

  void readBuffer(PassBuilder& pass) {
    const int index = pick(buffers_);
    if (index < 0) return;
    constexpr std::array kReads = {Access::StorageRead, Access::UniformRead, Access::TransferRead, Access::VertexRead,
                                   Access::IndirectRead};
    pass.access(buffers_[static_cast<std::size_t>(index)].handle, kReads[below(kReads.size())]);
  }

  void writeTexture(PassBuilder& pass) {
    if (!unwritten_.empty() && chance(25)) {
      touched_.push_back(unwritten_.back().handle.resource);
      unwritten_.back().handle = pass.access(unwritten_.back().handle, randomWrite());
      readable_.push_back(unwritten_.back());
      unwritten_.pop_back();
      return;
    }
    const int index = chance(40) ? pick(readable_) : -1;
    if (index >= 0 && !readable_[static_cast<std::size_t>(index)].history) {
      TextureState& state = readable_[static_cast<std::size_t>(index)];
      const Access access =
          chance(40) ? onceAnAttachment(chance(70) ? Access::StorageReadWrite : Access::ColorReadWrite) : randomWrite();
      state.handle = pass.access(state.handle, access, randomRange(state.desc));
      return;
    }
    const TextureDesc desc = randomDesc();
    const Texture texture = graph_.texture(name("texture"), desc);
    touched_.push_back(texture.resource);
    readable_.push_back({pass.access(texture, randomWrite()), desc});
  }

  void writeBuffer(PassBuilder& pass) {
    const int index = chance(40) ? pick(buffers_) : -1;
    if (index >= 0) {
      BufferState& state = buffers_[static_cast<std::size_t>(index)];
      if (!state.readOnly)
        state.handle = pass.access(state.handle, chance(50) ? Access::StorageReadWrite : Access::TransferWrite);
      return;
    }
    const Buffer buffer = graph_.buffer(name("buffer"), BufferDesc{64 + below(8) * 200});
    touched_.push_back(buffer.resource);
    buffers_.push_back({pass.access(buffer, Access::StorageWrite)});
  }

  void finishHistories() {
    touched_.clear();
    hasAttachment_ = false;
    if (unwritten_.empty()) return;
    PassBuilder pass = graph_.callback(name("pass"), [](const RecordContext&) {});
    readTexture(pass);
    for (TextureState& state : unwritten_) {
      state.handle = pass.access(state.handle, randomWrite());
      readable_.push_back(state);
    }
  }

  void exportSome() {
    constexpr std::array kReleases = {kComputeSampled, kFragmentSampled, kWaitedFor,
                                      kCopied,         kAnyCommand,      kSampledAnywhere};
    for (const TextureState& state : readable_) {
      if (chance(35)) graph_.exported(state.handle, kReleases[below(kReleases.size())]);
    }
    for (const TextureState& state : previous_) {
      if (chance(10)) graph_.exported(state.handle, kReleases[below(kReleases.size())]);
    }
    for (const BufferState& state : buffers_) {
      if (!state.readOnly && chance(30)) graph_.exported(state.handle, kComputeSampled);
    }
  }

  std::mt19937_64 random_;
  Graph graph_;
  std::vector<TextureState> readable_;
  std::vector<TextureState> previous_;
  std::vector<TextureState> unwritten_;
  std::vector<BufferState> buffers_;
  std::vector<std::uint32_t> touched_;
  bool hasAttachment_ = false;
  std::uint32_t names_ = 0;
};

/// A random order of a list: the new index of every element.
std::vector<std::uint32_t> permutation(std::size_t count, std::mt19937_64& random) {
  std::vector<std::uint32_t> places(count);
  std::iota(places.begin(), places.end(), 0U);
  std::ranges::shuffle(places, random);
  return places;
}

template <typename Decl>
std::vector<Decl> moved(const std::vector<Decl>& list, const std::vector<std::uint32_t>& places) {
  std::vector<Decl> result(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) result[places[i]] = list[i];
  return result;
}

}  // namespace

Graph randomGraph(std::uint64_t seed, const RandomGraphLimits& limits) {
  return Generator(seed).run(limits);
}

GraphDesc shuffled(const GraphDesc& graph, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<std::uint32_t> resources = permutation(graph.resources.size(), random);
  const std::vector<std::uint32_t> histories = permutation(graph.histories.size(), random);
  GraphDesc result;
  result.resources = moved(graph.resources, resources);
  result.passes = moved(graph.passes, permutation(graph.passes.size(), random));
  result.histories = moved(graph.histories, histories);
  result.exports = moved(graph.exports, permutation(graph.exports.size(), random));
  for (ResourceDecl& resource : result.resources) {
    if (resource.history != kNone) resource.history = histories[resource.history];
  }
  for (PassDecl& pass : result.passes) {
    for (AccessDecl& access : pass.accesses) access.resource = resources[access.resource];
  }
  for (HistoryDecl& history : result.histories) {
    history.previous = resources[history.previous];
    history.current = resources[history.current];
  }
  for (ExportDecl& exported : result.exports) exported.resource.resource = resources[exported.resource.resource];
  return result;
}

}  // namespace fg::test
