/* walr's passes in skaarj1989's FrameGraph, a graph of callbacks like Frostbite's. Header-only; C++20. */
#ifndef WALR_ADAPTERS_FRAMEGRAPH_H
#define WALR_ADAPTERS_FRAMEGRAPH_H

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <walr/walr_passes.h>
#include <fg/FrameGraph.hpp>

namespace walr::adapters {

/// Adds the passes of a method to a FrameGraph, each as one callback pass.
///
/// `Host` names the resource types of the graph's owner:
///
///     struct Host {
///       using Texture = ...;  // A type for FrameGraph's resources.
///       using Buffer = ...;   // The same for buffers.
///       static Texture::Desc textureDesc(const WalrResource&);
///       static Buffer::Desc bufferDesc(const WalrResource&);
///       static std::uint32_t flags(const WalrBinding&);  // For preRead and preWrite, which place barriers.
///       static WalrPassResource bind(Texture&);          // Image, identity and layout.
///       static WalrPassResource bind(Buffer&);
///       static VkCommandBuffer commands(void* context);  // Of FrameGraph::execute's context.
///     };
template <typename Host>
class FrameGraphPasses {
 public:
  /// No resource, for instance a previous history in the first frame.
  static constexpr FrameGraphResource kNone = -1;

  /// @param list   list of the passes; must outlive this object
  /// @param record walr_record_pass, linked or from a plug-in's table
  /// @param error  walr_last_error, likewise
  FrameGraphPasses(WalrPasses passes, const WalrPassList& list, decltype(&walr_record_pass) record,
                   decltype(&walr_last_error) error)
      : passes_(passes), list_(&list), record_(record), error_(error) {}

  /// Add the passes of one frame, after walr_begin_frame.
  /// @param resources one for each resource of the list: imports for WALR_RESOURCE_HOST and histories, kNone for those
  ///        that the graph creates and for previous histories that do not exist
  /// @returns the same; what the passes wrote is at its new version
  std::vector<FrameGraphResource> add(FrameGraph& graph, std::vector<FrameGraphResource> resources) const {
    if (resources.size() != list_->resource_count) throw std::invalid_argument("a handle for each resource is needed");
    for (std::uint32_t i = 0; i < list_->pass_count; ++i) addPass(graph, i, resources);
    return resources;
  }

 private:
  struct Data {
    std::vector<FrameGraphResource> bindings;
  };

  static bool writes(const WalrBinding& binding) {
    return (binding.access & (VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT)) != 0;
  }

  FrameGraphResource declare(FrameGraph::Builder& builder, const WalrBinding& binding,
                             FrameGraphResource& current) const {
    const WalrResource& resource = *list_->resources[binding.resource];
    if (resource.kind == WALR_RESOURCE_LIBRARY) {
      builder.setSideEffect();  // The library reads it after the frame.
      return kNone;
    }
    if (!writes(binding)) return current == kNone ? kNone : builder.read(current, Host::flags(binding));
    if (current == kNone) {
      current = resource.buffer == VK_TRUE
                    ? builder.template create<typename Host::Buffer>(resource.name, Host::bufferDesc(resource))
                    : builder.template create<typename Host::Texture>(resource.name, Host::textureDesc(resource));
    }
    current = builder.write(current, Host::flags(binding));
    return current;
  }

  void addPass(FrameGraph& graph, std::uint32_t index, std::vector<FrameGraphResource>& resources) const {
    const WalrDispatch& pass = *list_->passes[index];
    graph.addCallbackPass<Data>(
        pass.name,
        [&](FrameGraph::Builder& builder, Data& data) {
          for (std::uint32_t b = 0; b < pass.binding_count; ++b) {
            const WalrBinding& binding = *pass.bindings[b];
            data.bindings.push_back(declare(builder, binding, resources[binding.resource]));
          }
        },
        [self = *this, index](const Data& data, FrameGraphPassResources& made, void* context) {
          self.execute(index, data, made, context);
        });
  }

  void execute(std::uint32_t index, const Data& data, FrameGraphPassResources& made, void* context) const {
    const WalrDispatch& pass = *list_->passes[index];
    std::vector<WalrPassResource> bound(pass.binding_count, WalrPassResource{});
    for (std::uint32_t b = 0; b < pass.binding_count; ++b) {
      if (data.bindings[b] == kNone) continue;
      const bool buffer = list_->resources[pass.bindings[b]->resource]->buffer == VK_TRUE;
      bound[b] = buffer ? Host::bind(made.get<typename Host::Buffer>(data.bindings[b]))
                        : Host::bind(made.get<typename Host::Texture>(data.bindings[b]));
    }
    const WalrResult result = record_(passes_, index, Host::commands(context), bound.data(), pass.binding_count);
    if (result != WALR_SUCCESS) throw std::runtime_error(std::string(pass.name) + ": " + error_());
  }

  WalrPasses passes_;
  const WalrPassList* list_;
  decltype(&walr_record_pass) record_;
  decltype(&walr_last_error) error_;
};

}  // namespace walr::adapters

#endif
