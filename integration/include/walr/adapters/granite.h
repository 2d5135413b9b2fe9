/* walr's passes in Granite's render graph. Header-only; C++17. */
#ifndef WALR_ADAPTERS_GRANITE_H
#define WALR_ADAPTERS_GRANITE_H

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// Granite's headers come before any of Vulkan's.
#include <render_graph.hpp>

#include <walr/walr_passes.h>

namespace walr::adapters {

/// Adds the passes of a method to a Granite::RenderGraph, each as one compute pass. The graph creates all images and
/// buffers, keeps the histories and places the barriers. The host's passes write the inputs and read the result by
/// name.
///
/// In each frame call begin(), RenderGraph::setup_attachments and RenderGraph::enqueue_render_passes. Call
/// RenderGraph::reset before this object is destroyed.
class GranitePasses {
 public:
  /// Functions of walr, linked or from a plug-in's table.
  struct Functions {
    decltype(&walr_begin_frame) beginFrame;
    decltype(&walr_record_pass) recordPass;
    decltype(&walr_last_error) lastError;
  };

  /// @param passes remains owned by the caller; created with as many frames in flight as the device has frame contexts
  /// @param list   list of the passes; must outlive this object
  GranitePasses(WalrPasses passes, const WalrPassList& list, const Functions& walr)
      : passes_(passes), list_(&list), walr_(walr) {}
  GranitePasses(const GranitePasses&) = delete;
  GranitePasses& operator=(const GranitePasses&) = delete;

  /// Add the passes to a graph that is not baked yet.
  /// @param names the graph's names of textures that differ from walr's, by walr's names ("lighting", ..., "denoised",
  ///        and those of optional images like "confidence")
  /// @throws std::invalid_argument for a pass or resource that Granite cannot express
  void add(Granite::RenderGraph& graph, const std::map<std::string, std::string>& names = {}) {
    graph_ = &graph;
    added_.clear();
    kept_.clear();
    keepers_.clear();
    states_.assign(list_->resource_count, {});
    for (std::uint32_t i = 0; i < list_->resource_count; ++i) {
      const WalrResource& resource = *list_->resources[i];
      const auto given = names.find(resource.name);
      states_[i].name = resource.kind != WALR_RESOURCE_HOST ? std::string("walr/") + resource.name
                        : given == names.end()              ? resource.name
                                                            : given->second;
    }
    for (std::uint32_t i = 0; i < list_->pass_count; ++i) addPass(i);
  }

  /// Let a pass of the host read an image that walr writes. Granite culls passes that the back buffer does not depend
  /// on in this frame. This call also keeps those that only write histories for the next frame.
  /// @param output walr's name of the image: "denoised" or "history_length"
  /// @throws std::invalid_argument if no pass writes it
  Granite::RenderTextureResource& readBy(Granite::RenderPass& pass, const std::string& output = "denoised") {
    if (keepers_.insert(&pass).second) {  // Granite takes a resource once for each pass.
      for (const std::string& name : kept_) pass.add_proxy_input(name, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, 0);
    }
    for (std::uint32_t i = 0; i < list_->resource_count; ++i) {
      const WalrResource& resource = *list_->resources[i];
      const bool written = resource.kind == WALR_RESOURCE_HOST && states_[i].versions > 0;
      if (written && output == resource.name) return pass.add_texture_input(current(i));
    }
    throw std::invalid_argument("no pass writes " + output + ": add() comes first");
  }

  /// Begin a frame, after the device has begun its frame context.
  /// @param reset drop the histories: see WALR_FRAME_RESET_HISTORY
  /// @throws std::runtime_error with walr's error text, also for an error on Granite's threads in the frame before
  void begin(const WalrPassFrame& frame, bool reset = false) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!error_.empty()) throw std::runtime_error(std::exchange(error_, {}));
    if (walr_.beginFrame(passes_, &frame) != WALR_SUCCESS) throw std::runtime_error(walr_.lastError());
    reset_ = reset;
  }

  /// @returns the first error on Granite's threads that `begin` has not thrown; empty if there is none
  std::string error() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return error_;
  }

 private:
  /// A resource that several passes write has a new name in Granite after each write.
  struct State {
    std::string name;
    std::uint32_t versions = 0;                 ///< Writes so far.
    std::vector<Granite::RenderPass*> readers;  ///< Of the current version; of a library's buffer, the last user.
  };
  /// The resource behind a binding; both pointers are null for walr's own upload buffers.
  struct Bound {
    Granite::RenderTextureResource* texture = nullptr;
    Granite::RenderBufferResource* buffer = nullptr;
    bool history = false;
  };
  struct Added {
    Granite::RenderPass* pass = nullptr;
    std::vector<Bound> bindings;
  };

  static bool writes(const WalrBinding& binding) {
    return (binding.access & (VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_SHADER_WRITE_BIT)) != 0;
  }

  std::string version(std::uint32_t resource, std::uint32_t number) const {
    const State& state = states_[resource];
    return number < 2 ? state.name : state.name + "@" + std::to_string(number);
  }
  std::string current(std::uint32_t resource) const { return version(resource, states_[resource].versions); }

  Granite::AttachmentInfo attachment(const WalrResource& resource) const {
    Granite::AttachmentInfo info;
    info.size_class = Granite::SizeClass::Absolute;
    info.size_x = static_cast<float>(resource.width);
    info.size_y = static_cast<float>(resource.height);
    info.format = resource.format;
    info.aux_usage = resource.image_usage;
    return info;
  }

  void addPass(std::uint32_t index) {
    const WalrDispatch& dispatch = *list_->passes[index];
    if (dispatch.indirect != WALR_NONE) {
      throw std::invalid_argument(std::string(dispatch.name) +
                                  ": dispatched indirectly, which this adapter does not tell Granite of");
    }
    Granite::RenderPass& pass =
        graph_->add_pass(std::string("walr/") + dispatch.name, Granite::RenderGraph::get_default_compute_queue());
    Added added{&pass, {}};
    bool keeps = false;  // What it writes is read after the frame, or in the next one.
    for (std::uint32_t b = 0; b < dispatch.binding_count; ++b) {
      const WalrBinding& binding = *dispatch.bindings[b];
      const WalrResource& resource = *list_->resources[binding.resource];
      const bool readLater = resource.kind == WALR_RESOURCE_HISTORY_CURRENT || resource.kind == WALR_RESOURCE_LIBRARY;
      keeps = keeps || (readLater && writes(binding));
      added.bindings.push_back(resource.buffer == VK_TRUE ? declareBuffer(pass, binding) : declareImage(pass, binding));
    }
    if (keeps) {
      kept_.push_back(std::string("walr/kept by ") + dispatch.name);
      pass.add_proxy_output(kept_.back(), VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, 0);
    }
    pass.set_build_render_pass([this, index](Vulkan::CommandBuffer& commands) { record(index, commands); });
    added_.push_back(std::move(added));
  }

  Bound declareImage(Granite::RenderPass& pass, const WalrBinding& binding) {
    const WalrResource& resource = *list_->resources[binding.resource];
    Bound bound;
    if (resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS) {
      bound.history = true;
      bound.texture = &pass.add_history_input(states_[resource.partner].name);
    } else if (binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) {
      const auto [input, output] = nextVersion(pass, binding.resource);
      bound.texture = &pass.add_storage_texture_output(output, attachment(resource), input);
    } else {
      bound.texture = &pass.add_texture_input(current(binding.resource));
      states_[binding.resource].readers.push_back(&pass);
    }
    return bound;
  }

  Bound declareBuffer(Granite::RenderPass& pass, const WalrBinding& binding) {
    const WalrResource& resource = *list_->resources[binding.resource];
    Bound bound;
    if (resource.kind == WALR_RESOURCE_UPLOAD) return bound;
    if (resource.kind == WALR_RESOURCE_LIBRARY) {
      orderAfterLast(pass, binding.resource);
      return bound;
    }
    if (resource.kind != WALR_RESOURCE_TRANSIENT) {
      throw std::invalid_argument(std::string(resource.name) + ": Granite has no history of buffers");
    }
    if (writes(binding)) {
      Granite::BufferInfo info;
      info.size = resource.buffer_size;
      info.usage = resource.buffer_usage;
      const auto [input, output] = nextVersion(pass, binding.resource);
      bound.buffer = &pass.add_storage_output(output, info, input);
    } else {
      bound.buffer = &pass.add_storage_read_only_input(current(binding.resource));
      states_[binding.resource].readers.push_back(&pass);
    }
    return bound;
  }

  /// The library places the barriers of its own buffers, and Granite only needs the order of the passes.
  void orderAfterLast(Granite::RenderPass& pass, std::uint32_t resource) {
    std::vector<Granite::RenderPass*>& last = states_[resource].readers;
    for (Granite::RenderPass* before : last) {
      const std::string order = states_[resource].name + " after " + before->get_name();
      before->add_proxy_output(order, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, 0);
      pass.add_proxy_input(order, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, 0);
    }
    last = {&pass};
  }

  /// Names of a resource before and after a pass that writes to it. Granite does not order the pass after the readers
  /// of the old contents, so proxy resources do.
  std::pair<std::string, std::string> nextVersion(Granite::RenderPass& pass, std::uint32_t resource) {
    State& state = states_[resource];
    const std::string input = state.versions == 0 ? std::string() : current(resource);
    ++state.versions;
    const std::string output = current(resource);
    for (Granite::RenderPass* reader : state.readers) {
      const std::string order = output + " after " + reader->get_name();
      reader->add_proxy_output(order, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, 0);
      pass.add_proxy_input(order, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, 0);
    }
    state.readers.clear();
    return {input, output};
  }

  WalrPassResource resolve(const Bound& bound) const {
    if (bound.buffer != nullptr) {
      return {VK_NULL_HANDLE, graph_->get_physical_buffer_resource(*bound.buffer).get_buffer(), 0,
              VK_IMAGE_LAYOUT_UNDEFINED, 0};
    }
    if (bound.texture == nullptr || (bound.history && reset_)) return {};
    const Vulkan::ImageView* view = bound.history ? graph_->get_physical_history_texture_resource(*bound.texture)
                                                  : &graph_->get_physical_texture_resource(*bound.texture);
    if (view == nullptr) return {};
    const Vulkan::Image& image = view->get_image();
    return {image.get_image(), VK_NULL_HANDLE, image.get_cookie(), image.get_layout(VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL),
            0};
  }

  /// Runs on one of Granite's threads, where it must not throw.
  void record(std::uint32_t index, Vulkan::CommandBuffer& commands) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<WalrPassResource> resources;
    for (const Bound& bound : added_[index].bindings) resources.push_back(resolve(bound));
    const WalrResult result = walr_.recordPass(passes_, index, commands.get_command_buffer(), resources.data(),
                                               static_cast<std::uint32_t>(resources.size()));
    if (result != WALR_SUCCESS && error_.empty()) error_ = walr_.lastError();
  }

  WalrPasses passes_;
  const WalrPassList* list_;
  Functions walr_;
  Granite::RenderGraph* graph_ = nullptr;
  std::vector<State> states_;                     ///< By resource.
  std::vector<Added> added_;                      ///< By pass.
  std::vector<std::string> kept_;                 ///< Names of the passes' proxies that must be read.
  std::set<const Granite::RenderPass*> keepers_;  ///< The host's passes that read them.
  mutable std::mutex mutex_;  ///< Granite records passes in parallel; walr allows one thread at a time.
  std::string error_;
  bool reset_ = false;
};

}  // namespace walr::adapters

#endif
