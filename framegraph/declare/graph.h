#pragma once

#include <concepts>
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

/// A frame graph is declared, compiled and recorded. This header is for declaring: it builds a plain value that lists
/// what every pass reads and writes. It needs neither a Vulkan device nor the Vulkan loader.
namespace fg {

inline constexpr std::uint32_t kNone = ~0u;

/// Handle of one version of a resource. Every write creates a new version. `Texture` and `Buffer` are distinct types so
/// that they cannot be confused.
struct ResourceVersion {
  std::uint32_t resource = kNone;  ///< Index into `GraphDesc::resources`.
  std::uint32_t version = 0;       ///< 0: as declared, imported or kept from the last frame; n: after the n-th write.
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

/// Description of a two-dimensional texture.
struct TextureDesc {
  VkFormat format = VK_FORMAT_UNDEFINED;
  Extent extent;
  std::uint32_t mipLevels = 1;
  std::uint32_t arrayLayers = 1;
  friend bool operator==(const TextureDesc&, const TextureDesc&) = default;
};

/// Description of a buffer.
struct BufferDesc {
  std::uint64_t size = 0;  ///< Bytes.
  friend bool operator==(const BufferDesc&, const BufferDesc&) = default;
};

/// Part of a texture. The default is the whole texture.
struct SubresourceRange {
  std::uint32_t baseMip = 0;
  std::uint32_t mipCount = VK_REMAINING_MIP_LEVELS;
  std::uint32_t baseLayer = 0;
  std::uint32_t layerCount = VK_REMAINING_ARRAY_LAYERS;
  friend bool operator==(const SubresourceRange&, const SubresourceRange&) = default;
};

/// How a pass accesses a resource. Stage, access mask, layout and usage flags follow from it (see access.h).
enum class Access : std::uint8_t {
  SampledRead,          ///< Compute: sampled image, read only.
  StorageRead,          ///< Compute: storage image or buffer, read only.
  StorageWrite,         ///< Compute: storage image or buffer, written; earlier contents are not needed.
  StorageReadWrite,     ///< Compute: storage image or buffer, read and written in place.
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

/// How long a resource and its contents live.
enum class Lifetime : std::uint8_t {
  Transient,        ///< Lives from its first to its last use in the frame; its memory is aliased.
  Imported,         ///< Owned by the host; bound to the executor before recording.
  HistoryPrevious,  ///< What the last frame wrote into the matching HistoryCurrent; zero while there is none.
  HistoryCurrent,   ///< Kept for the next frame.
  Upload,           ///< Host-visible bytes written by the host every frame, one copy per frame in flight.
};

/// A texture that is kept for the next frame. In the first frame and after a reset, `previous` reads as zeros. A pass
/// can also read the age of the history (see `PassBuilder::historyAge`).
struct History {
  Texture previous;             ///< Contents from the last frame, read-only.
  Texture current;              ///< To be written exactly once this frame.
  std::uint32_t index = kNone;  ///< Index into `GraphDesc::histories`.
};

/// The age of a history, which the executor writes into a pass's push constants when it records a frame.
struct HistoryAgeConstant {
  std::uint32_t history = kNone;  ///< Index into `GraphDesc::histories`.
  std::uint32_t offset = 0;       ///< Byte offset of a uint: number of frames, 0 if there is no history.
};

/// Compute work as plain data, which can be inspected without a device.
struct ComputeDispatch {
  const Shader* shader = nullptr;
  std::vector<std::uint32_t> specialization;  ///< One word per entry of `shader->constants`, in that order.
  std::vector<bool> specialized;              ///< Which of them were set; `compile` reports those that were not.
  std::vector<std::string> unknownConstants;  ///< Names that the shader does not have; `compile` reports them.
  std::vector<std::byte> constants;           ///< Push constants; size must be the shader's.
  std::vector<HistoryAgeConstant> historyAges;
  std::uint32_t groups[3] = {0, 0, 0};  ///< Work groups; ignored when `indirect` is valid.
  Buffer indirect;                      ///< Arguments of vkCmdDispatchIndirect; optional.
  std::uint64_t indirectOffset = 0;
};

/// Vulkan objects that a host's callback may use while it records its pass.
struct RecordContext {
  VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
  std::function<VkImage(Texture)> image;
  std::function<VkImageView(Texture)> view;
  std::function<VkBuffer(Buffer)> buffer;
};

/// Work that the host records (raster, ray tracing, copies). Its accesses are declared like those of other passes.
struct HostCallback {
  std::function<void(const RecordContext&)> record;
};

/// One declared access of a pass.
struct AccessDecl {
  std::uint32_t resource = kNone;
  std::uint32_t readVersion = kNone;   ///< Version read, or kNone for a pure write.
  std::uint32_t writeVersion = kNone;  ///< Version written, or kNone for a pure read.
  /// For a pure write: the version that it overwrites. The pass runs after all readers of that version.
  std::uint32_t replacesVersion = kNone;
  Access access = Access::SampledRead;
  SubresourceRange range;
  std::string binding;                  ///< Name of the shader variable; empty for callback passes.
  VkFilter filter = VK_FILTER_NEAREST;  ///< For combined image samplers; addressing clamps to the edge.
  bool unread = false;                  ///< Bound only because the layout requires it; see `PassBuilder::unread`.
  SourceLocation where;
};

struct PassDecl {
  std::string name;
  std::variant<ComputeDispatch, HostCallback> work;
  std::vector<AccessDecl> accesses;
  std::optional<Extent> extent = std::nullopt;  ///< Required of all its textures; see `PassBuilder::texels`.
  bool sideEffects = false;                     ///< Never culled.
  SourceLocation where;
};

struct ResourceDecl {
  std::string name;
  std::variant<TextureDesc, BufferDesc> desc;
  Lifetime lifetime = Lifetime::Transient;
  std::optional<ExternalState> acquire = std::nullopt;  ///< Imported resources: their state when the graph starts.
  std::uint32_t history = kNone;                        ///< Index into `GraphDesc::histories`.
  std::uint32_t versions = 0;                           ///< Number of writes declared.
  /// Upload: what the buffer holds until the host uploads something else; empty if the host always does.
  std::span<const std::byte> contents = {};
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
  ExternalState release;  ///< State for the host after the graph.
  SourceLocation where;
};

/// A declared graph as a plain value.
struct GraphDesc {
  std::vector<ResourceDecl> resources;
  std::vector<PassDecl> passes;
  std::vector<HistoryDecl> histories;
  std::vector<ExportDecl> exports;
};

class Graph;

/// Declares one pass. Returned by `Graph::compute` and `Graph::callback`; a short-lived reference into the graph.
class PassBuilder {
 public:
  using Where = SourceLocation;

  /// Read a sampled image (`texture2D`, `utexture2D`), or a combined image sampler with the given filter.
  PassBuilder& sample(std::string_view binding, Texture texture, VkFilter filter = VK_FILTER_NEAREST,
                      Where where = Where::current());
  /// Bind a texture to a sampled image that the shader declares but does not read with these specialization constants.
  /// Vulkan requires a valid descriptor anyway.
  /// @param texture a texture that the pass samples under another name, so that no barrier and no traffic is added. Its
  ///                texels have the type that the shader declares (`texture2D`: float, `utexture2D`: unsigned).
  PassBuilder& unread(std::string_view binding, Texture texture, Where where = Where::current());
  /// The same for a `readonly` storage buffer.
  /// @param buffer a buffer that the pass loads under another name
  PassBuilder& unread(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// `sample` the texture if the shader reads it with these specialization constants; otherwise bind `standIn` as
  /// `unread`.
  PassBuilder& sampleIf(bool read, std::string_view binding, Texture texture, Texture standIn,
                        Where where = Where::current());
  /// Read a `readonly` storage image or buffer.
  PassBuilder& load(std::string_view binding, Texture texture, Where where = Where::current());
  PassBuilder& load(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// Read a uniform block.
  PassBuilder& uniform(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// Write a `writeonly` storage image or buffer; earlier contents are lost. Returns the new version.
  [[nodiscard]] Texture store(std::string_view binding, Texture texture, Where where = Where::current());
  [[nodiscard]] Buffer store(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// Read and write one storage image or buffer in place. Returns the new version.
  [[nodiscard]] Texture update(std::string_view binding, Texture texture, Where where = Where::current());
  [[nodiscard]] Buffer update(std::string_view binding, Buffer buffer, Where where = Where::current());
  /// Any access of a callback pass. Returns the new version for a write, the same version for a read.
  Texture access(Texture texture, Access access, SubresourceRange range = {}, Where where = Where::current());
  Buffer access(Buffer buffer, Access access, Where where = Where::current());

  /// Set the push constants.
  template <typename T>
  requires(!std::convertible_to<const T&, std::span<const std::byte>>) PassBuilder& constants(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return constants(std::as_bytes(std::span(&value, 1)));
  }
  PassBuilder& constants(std::span<const std::byte> bytes);
  /// Append a number to the push constants.
  PassBuilder& appendConstant(std::uint32_t value);
  /// Let the executor write the age of `history` at a byte offset of the push constants: the number of frames, 0 if
  /// there is no history.
  PassBuilder& historyAge(const History& history, std::uint32_t offset);
  /// Set a specialization constant by its name in the shader.
  PassBuilder& specialize(std::string_view constant, std::uint32_t value);
  PassBuilder& specialize(std::string_view constant, float value);
  PassBuilder& specialize(std::string_view constant, bool value);
  /// Require this extent of the first mip level of each access, for passes that process all textures texel by texel.
  /// `compile` reports levels of another size and the passes that wrote them.
  PassBuilder& texels(Extent extent);
  /// Dispatch enough work groups of the shader's size to cover `threads`.
  PassBuilder& dispatch(Extent threads, std::uint32_t layers = 1);
  /// Take the work group counts from a buffer.
  PassBuilder& dispatchIndirect(Buffer arguments, std::uint64_t offset = 0, Where where = Where::current());
  /// Never cull the pass, even if nothing that it writes is used.
  PassBuilder& sideEffects();

 private:
  friend class Graph;
  PassBuilder(Graph& graph, std::uint32_t pass) : graph_(&graph), pass_(pass) {}
  PassBuilder& read(ResourceVersion resource, Access access, std::string_view binding, Where where);
  PassBuilder& bindUnread(ResourceVersion resource, Access access, std::string_view binding, Where where);
  ResourceVersion write(ResourceVersion resource, Access access, std::string_view binding, Where where);
  ResourceVersion touch(ResourceVersion resource, Access access, Where where);
  ComputeDispatch* computeWork();
  Graph* graph_;
  std::uint32_t pass_;
};

/// A frame graph under construction. Declaring never fails; `compile` reports all errors at once.
class Graph {
 public:
  using Where = SourceLocation;

  /// Declare a transient texture or buffer.
  Texture texture(std::string name, const TextureDesc& desc, Where where = Where::current());
  Buffer buffer(std::string name, const BufferDesc& desc, Where where = Where::current());
  /// Declare a buffer that the host writes every frame (see `Executor::upload`).
  Buffer upload(std::string name, std::uint64_t size, Where where = Where::current());
  /// Declare an upload that holds these bytes from the start, such as the weights of a network, so that the host need
  /// not write it. The graph refers to them: they must live as long as it and its executors.
  Buffer upload(std::string name, std::span<const std::byte> contents, Where where = Where::current());
  /// Declare a resource that the host owns.
  /// @param acquire its state before the graph
  Texture import(std::string name, const TextureDesc& desc, const ExternalState& acquire,
                 Where where = Where::current());
  Buffer import(std::string name, const BufferDesc& desc, const ExternalState& acquire, Where where = Where::current());
  /// Declare a texture that is kept from frame to frame.
  History history(std::string name, const TextureDesc& desc, Where where = Where::current());
  /// Declare a version as a result of the graph. Passes that no export and no history needs are culled.
  /// @param release its state for the host after the graph
  void exported(Texture texture, const ExternalState& release, Where where = Where::current());
  void exported(Buffer buffer, const ExternalState& release, Where where = Where::current());

  /// Add a compute pass.
  PassBuilder compute(std::string name, const Shader& shader, Where where = Where::current());
  /// Add a pass that the host records itself.
  PassBuilder callback(std::string name, std::function<void(const RecordContext&)> record,
                       Where where = Where::current());

  [[nodiscard]] const GraphDesc& desc() const { return desc_; }
  /// Description of the texture behind a handle; an empty one if the handle is not of a texture.
  [[nodiscard]] const TextureDesc& textureDesc(Texture texture) const;

 private:
  friend class PassBuilder;
  std::uint32_t declare(ResourceDecl resource);
  GraphDesc desc_;
};

}  // namespace fg
