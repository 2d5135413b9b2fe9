#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "framegraph/declare/shader.h"
#include "framegraph/declare/source_location.h"

/// Declare -> compile -> record. This header is the declaration: a plain value that says what every pass reads and
/// writes. It needs neither a Vulkan device nor the Vulkan loader.
namespace fg {

inline constexpr std::uint32_t kNone = ~0u;

/// Handle of a resource at one version. Every write makes a new version; a handle always names one version.
/// `Texture` and `Buffer` are distinct types over the same idea.
struct ResourceVersion {
  std::uint32_t resource = kNone;  ///< Index into `GraphDesc::resources`.
  std::uint32_t version = 0;       ///< 0: as declared, imported or carried over; n: after the n-th write.
  friend bool operator==(const ResourceVersion&, const ResourceVersion&) = default;
  [[nodiscard]] bool valid() const { return resource != kNone; }
};
struct Texture : ResourceVersion {};
struct Buffer : ResourceVersion {};

/// Size of a texture's base level in texels.
struct Extent {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  friend bool operator==(const Extent&, const Extent&) = default;
};

/// A two-dimensional texture, described and not yet made.
struct TextureDesc {
  VkFormat format = VK_FORMAT_UNDEFINED;
  Extent extent;
  std::uint32_t mipLevels = 1;
  std::uint32_t arrayLayers = 1;
  friend bool operator==(const TextureDesc&, const TextureDesc&) = default;
};

/// A linear buffer, described and not yet made.
struct BufferDesc {
  std::uint64_t size = 0;  ///< Bytes.
  friend bool operator==(const BufferDesc&, const BufferDesc&) = default;
};

/// Part of a texture. The default is the whole of it.
struct SubresourceRange {
  std::uint32_t baseMip = 0;
  std::uint32_t mipCount = VK_REMAINING_MIP_LEVELS;
  std::uint32_t baseLayer = 0;
  std::uint32_t layerCount = VK_REMAINING_ARRAY_LAYERS;
  friend bool operator==(const SubresourceRange&, const SubresourceRange&) = default;
};

/// How a pass touches a resource. Stage, access mask, layout and usage flags all follow from it (see access.h).
enum class Access : std::uint8_t {
  SampledRead,          ///< Compute: sampled image, read only.
  StorageRead,          ///< Compute: storage image or buffer, read only.
  StorageWrite,         ///< Compute: storage image or buffer, written; earlier contents are not needed.
  StorageReadWrite,     ///< Compute: in place; the earlier contents are read and a new version is written.
  UniformRead,          ///< Compute: uniform block.
  IndirectRead,         ///< Arguments of an indirect dispatch or draw.
  TransferRead,         ///< Source of a copy or blit.
  TransferWrite,        ///< Destination of a copy, blit or clear.
  ColorWrite,           ///< Colour attachment, cleared or fully overwritten.
  ColorReadWrite,       ///< Colour attachment, loaded and blended.
  DepthWrite,           ///< Depth attachment, cleared and written.
  DepthReadWrite,       ///< Depth attachment, loaded, tested and written.
  DepthRead,            ///< Depth attachment, tested only.
  FragmentSampledRead,  ///< Graphics: sampled in the fragment shader.
  VertexRead,           ///< Vertex buffer.
  IndexRead,            ///< Index buffer.
};

/// State of a resource at the border between the graph and its host.
struct ExternalState {
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< Ignored for buffers.
  friend bool operator==(const ExternalState&, const ExternalState&) = default;
};

/// What becomes of a resource's memory.
enum class Lifetime : std::uint8_t {
  Transient,        ///< Lives from its first to its last use in the frame; memory is aliased.
  Imported,         ///< Owned by the host; bound to the executor before recording.
  HistoryPrevious,  ///< What the last frame wrote into the matching HistoryCurrent; zero while there is none.
  HistoryCurrent,   ///< Kept for the next frame.
  Upload,           ///< Host-visible bytes written by the host every frame, one copy per frame in flight.
};

/// A texture that outlives its frame. Reading `previous` while no valid frame lies behind gives zeros, never garbage;
/// a pass may also be told the age (see `PassBuilder::historyAge`).
struct History {
  Texture previous;             ///< Last frame's contents, readable as it is.
  Texture current;              ///< To be written exactly once this frame.
  std::uint32_t index = kNone;  ///< Index into `GraphDesc::histories`.
};

/// One value that the executor fills into a pass's push constants when it records a frame.
struct HistoryAgeConstant {
  std::uint32_t history = kNone;  ///< Index into `GraphDesc::histories`.
  std::uint32_t offset = 0;       ///< Byte offset of a uint: frames behind `previous`, 0 while it is not valid.
};

/// Compute work as plain data: nothing here has to be run to be inspected.
struct ComputeDispatch {
  const Shader* shader = nullptr;
  std::vector<std::uint32_t> specialization;  ///< One word per entry of `shader->constants`, in that order.
  std::vector<bool> specialized;              ///< Which of them were set; leaving one out is an error.
  std::vector<std::string> unknownConstants;  ///< Names set that the shader does not have: an error of `compile`.
  std::vector<std::byte> constants;           ///< Push constants; size must be the shader's.
  std::vector<HistoryAgeConstant> historyAges;
  std::uint32_t groups[3] = {0, 0, 0};  ///< Work groups; ignored when `indirect` is valid.
  Buffer indirect;                      ///< Arguments of vkCmdDispatchIndirect, where given.
  std::uint64_t indirectOffset = 0;
};

/// What a host's own pass may use while it records itself.
struct RecordContext {
  VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
  std::function<VkImage(Texture)> image;
  std::function<VkImageView(Texture)> view;
  std::function<VkBuffer(Buffer)> buffer;
};

/// Work that a host records itself (raster, ray tracing, copies). Its accesses are declared like any other pass's.
struct HostCallback {
  std::function<void(const RecordContext&)> record;
};

/// One declared access of a pass.
struct AccessDecl {
  std::uint32_t resource = kNone;
  std::uint32_t readVersion = kNone;   ///< Version read, or kNone for a pure write.
  std::uint32_t writeVersion = kNone;  ///< Version made, or kNone for a pure read.
  /// For a pure write: the version it replaces, which all its readers must have finished with.
  std::uint32_t replacesVersion = kNone;
  Access access = Access::SampledRead;
  SubresourceRange range;
  std::string binding;                  ///< Name of the shader variable; empty for callback passes.
  VkFilter filter = VK_FILTER_NEAREST;  ///< For combined image samplers; addressing clamps to the edge.
  bool unread = false;                  ///< Bound only because the layout asks for it; see `PassBuilder::unread`.
  SourceLocation where;
};

struct PassDecl {
  std::string name;
  std::variant<ComputeDispatch, HostCallback> work;
  std::vector<AccessDecl> accesses;
  std::optional<Extent> extent = std::nullopt;  ///< That all its textures must have, where it says so.
  bool sideEffects = false;                     ///< Kept even if it reaches no export and no history.
  SourceLocation where;
};

struct ResourceDecl {
  std::string name;
  std::variant<TextureDesc, BufferDesc> desc;
  Lifetime lifetime = Lifetime::Transient;
  std::optional<ExternalState> acquire = std::nullopt;  ///< Imported resources: their state when the graph starts.
  std::uint32_t history = kNone;                        ///< Index into `GraphDesc::histories`.
  std::uint32_t versions = 0;                           ///< Number of writes declared.
  SourceLocation where;
};

struct HistoryDecl {
  std::string name;
  std::uint32_t previous = kNone;  ///< Resource index.
  std::uint32_t current = kNone;   ///< Resource index.
  SourceLocation where;
};

struct ExportDecl {
  ResourceVersion resource;
  ExternalState release;  ///< State in which the host gets it back.
  SourceLocation where;
};

/// Everything declared, as a plain value.
struct GraphDesc {
  std::vector<ResourceDecl> resources;
  std::vector<PassDecl> passes;
  std::vector<HistoryDecl> histories;
  std::vector<ExportDecl> exports;
};

class Graph;

/// Declares one pass. Obtained from `Graph::compute` or `Graph::callback`; a short-lived reference into the graph.
class PassBuilder {
 public:
  using Where = SourceLocation;

  /// Read through a sampled image (`texture2D`, `utexture2D`) or combined sampler with the given filter.
  PassBuilder& sample(std::string_view binding, Texture texture, VkFilter filter = VK_FILTER_NEAREST,
                      Where where = Where::current());
  /// Bind a sampled image that the shader declares, but, specialized as it is, never reads. Vulkan wants a descriptor
  /// of the right type all the same.
  /// @param texture one that the pass samples under another name, so that it costs neither a barrier nor traffic, and
  ///                whose texels have the type that the shader declares (`texture2D`: float, `utexture2D`: unsigned)
  PassBuilder& unread(std::string_view binding, Texture texture, Where where = Where::current());
  /// `sample` a texture where the shader, as it is specialized, reads it; else leave it `unread` and bind another
  /// instead.
  PassBuilder& sampleIf(bool read, std::string_view binding, Texture texture, Texture standIn,
                        Where where = Where::current());
  /// Read through a `readonly` storage image or buffer.
  PassBuilder& load(std::string_view binding, Texture texture, Where where = Where::current());
  PassBuilder& load(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// Read a uniform block.
  PassBuilder& uniform(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// Overwrite through a `writeonly` storage image or buffer. Returns the new version.
  [[nodiscard]] Texture store(std::string_view binding, Texture texture, Where where = Where::current());
  [[nodiscard]] Buffer store(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// Read and write one storage image or buffer in place. Returns the new version.
  [[nodiscard]] Texture update(std::string_view binding, Texture texture, Where where = Where::current());
  [[nodiscard]] Buffer update(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// Any other access, for callback passes. Writing accesses return the new version, reading ones the same.
  Texture access(Texture texture, Access access, SubresourceRange range = {}, Where where = Where::current());
  Buffer access(Buffer buffer, Access access, Where where = Where::current());

  /// Set the push constants.
  template <typename T>
  PassBuilder& constants(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return constants(std::as_bytes(std::span(&value, 1)));
  }
  PassBuilder& constants(std::span<const std::byte> bytes);
  /// Have the executor write the age of `history` (frames; 0 while `previous` is not valid) at a byte offset of the
  /// push constants.
  PassBuilder& historyAge(const History& history, std::uint32_t offset);
  /// Set a specialization constant by its name in the shader.
  PassBuilder& specialize(std::string_view constant, std::uint32_t value);
  PassBuilder& specialize(std::string_view constant, float value);
  PassBuilder& specialize(std::string_view constant, bool value);
  /// Say that the pass takes all its textures texel by texel, so that the levels that it accesses must have this
  /// extent: `compile` then names those of another size, and the passes that made them.
  PassBuilder& texels(Extent extent);
  /// Work groups enough to cover `threads` with the shader's work group size.
  PassBuilder& dispatch(Extent threads, std::uint32_t layers = 1);
  /// Take the work group counts from a buffer.
  PassBuilder& dispatchIndirect(Buffer arguments, std::uint64_t offset = 0, Where where = Where::current());
  /// Keep the pass even where nothing it writes is used.
  PassBuilder& sideEffects();

 private:
  friend class Graph;
  PassBuilder(Graph& graph, std::uint32_t pass) : graph_(&graph), pass_(pass) {}
  PassBuilder& read(ResourceVersion resource, Access access, std::string_view binding, Where where);
  ResourceVersion write(ResourceVersion resource, Access access, std::string_view binding, Where where);
  ResourceVersion touch(ResourceVersion resource, Access access, Where where);
  ComputeDispatch* computeWork();
  Graph* graph_;
  std::uint32_t pass_;
};

/// The frame graph under construction. Declaring never fails; every error is found, all at once, by `compile`.
class Graph {
 public:
  using Where = SourceLocation;

  /// Declare a transient texture or buffer.
  Texture texture(std::string name, const TextureDesc& desc, Where where = Where::current());
  Buffer buffer(std::string name, const BufferDesc& desc, Where where = Where::current());
  /// Declare bytes that the host writes every frame (see `Executor::upload`).
  Buffer upload(std::string name, std::uint64_t size, Where where = Where::current());
  /// Declare a resource owned by the host, and the state in which it arrives.
  Texture import(std::string name, const TextureDesc& desc, const ExternalState& acquire,
                 Where where = Where::current());
  Buffer import(std::string name, const BufferDesc& desc, const ExternalState& acquire, Where where = Where::current());
  /// Declare a texture that is carried from frame to frame.
  History history(std::string name, const TextureDesc& desc, Where where = Where::current());
  /// Hand a version back to the host in the given state. What no export or history needs is culled.
  void exported(Texture texture, const ExternalState& release, Where where = Where::current());
  void exported(Buffer buffer, const ExternalState& release, Where where = Where::current());

  /// Add a compute pass.
  PassBuilder compute(std::string name, const Shader& shader, Where where = Where::current());
  /// Add a pass that the host records itself.
  PassBuilder callback(std::string name, std::function<void(const RecordContext&)> record,
                       Where where = Where::current());

  [[nodiscard]] const GraphDesc& desc() const { return desc_; }
  /// Description of the texture behind a handle; an empty one where the handle names no texture.
  [[nodiscard]] const TextureDesc& textureDesc(Texture texture) const;

 private:
  friend class PassBuilder;
  std::uint32_t declare(ResourceDecl resource);
  GraphDesc desc_;
};

}  // namespace fg
