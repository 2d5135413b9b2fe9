// The C API with owning types and exceptions, for hosts in C++17. It needs nothing but the C headers.
#ifndef WALR_WALR_HPP
#define WALR_WALR_HPP

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <walr/walr_passes.h>

namespace walr::cpp {

/// A call of the C API failed. The message is that of walr_last_error.
class Error : public std::runtime_error {
 public:
  Error(WalrResult result, const std::string& message) : std::runtime_error(message), result_(result) {}
  WalrResult result() const noexcept { return result_; }

 private:
  WalrResult result_;
};

/// @throws Error unless the result is a success
inline void check(WalrResult result) {
  if (result != WALR_SUCCESS) throw Error(result, std::string(walr_result_name(result)) + ": " + walr_last_error());
}

/// A structure with `struct_size` set and all other fields zero.
template <typename Struct>
Struct make() {
  static_assert(std::is_aggregate_v<Struct> && offsetof(Struct, struct_size) == 0, "a structure with struct_size");
  Struct made{};
  made.struct_size = sizeof(Struct);
  return made;
}

namespace detail {

/// The elements that a function of the C API lists.
template <typename Element, typename Handle>
std::vector<Element> list(WalrResult (*function)(Handle, std::uint32_t*, Element*), Handle handle) {
  std::uint32_t count = 0;
  check(function(handle, &count, nullptr));
  std::vector<Element> elements(count);
  check(function(handle, &count, elements.data()));
  return elements;
}

/// A handle that is destroyed in the destructor, where an error is ignored.
template <typename Handle, WalrResult (*destroy)(Handle)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(Handle handle) noexcept : handle_(handle) {}
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    Owned taken(std::move(other));
    std::swap(handle_, taken.handle_);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (handle_ != nullptr) destroy(handle_);
  }
  Handle get() const noexcept { return handle_; }

 private:
  Handle handle_ = nullptr;
};

}  // namespace detail

/// All pass types. They are valid while the library is loaded.
inline std::vector<const WalrPassType*> passTypes() {
  std::vector<const WalrPassType*> types(walr_pass_type_count());
  for (std::size_t i = 0; i < types.size(); ++i) types[i] = walr_pass_type(static_cast<std::uint32_t>(i));
  return types;
}

/// The memory that a denoiser will allocate: walr_query_memory.
/// @throws Error
inline WalrMemory queryMemory(const WalrDenoiserInfo& info) {
  auto memory = make<WalrMemory>();
  check(walr_query_memory(&info, &memory));
  return memory;
}

/// An image that the host has created as required. Set `acquire` of inputs, and `identity` or call `forgetImage`.
inline WalrImage describe(VkImage image, const WalrImageRequirements& needs) {
  auto described = make<WalrImage>();
  described.queue_family = VK_QUEUE_FAMILY_IGNORED;
  described.image = image;
  described.format = needs.format;
  described.usage = needs.usage;
  described.width = needs.width;
  described.height = needs.height;
  return described;
}

/// A WalrDenoiser. Every member function is the C function of that name; all but `get` throw Error. A denoiser that was
/// moved from holds no handle. The GPU must have finished everything recorded when it is destroyed.
class Denoiser {
 public:
  Denoiser() = default;
  explicit Denoiser(const WalrDenoiserInfo& info) {
    WalrDenoiser made = nullptr;
    check(walr_create_denoiser(&info, &made));
    handle_ = detail::Owned<WalrDenoiser, walr_destroy_denoiser>(made);
  }

  WalrDenoiser get() const noexcept { return handle_.get(); }

  void resize(std::uint32_t width, std::uint32_t height) { check(walr_resize(get(), width, height)); }
  void setSetting(const std::string& name, const std::string& value) {
    check(walr_set_setting(get(), name.c_str(), value.c_str()));
  }
  void usePreset(const std::string& name) { check(walr_use_preset(get(), name.c_str())); }
  std::string setting(const std::string& name) const {
    std::size_t size = 0;
    check(walr_get_setting(get(), name.c_str(), nullptr, &size));
    std::string value(size, '\0');
    check(walr_get_setting(get(), name.c_str(), value.data(), &size));
    value.pop_back();  // Its terminating zero.
    return value;
  }
  void prepare() { check(walr_prepare(get())); }

  WalrImageRequirements imageRequirements(const std::string& port) const {
    auto requirements = make<WalrImageRequirements>();
    check(walr_get_image_requirements(get(), port.c_str(), &requirements));
    return requirements;
  }
  WalrImageState releaseState(const std::string& port) const {
    WalrImageState state{};
    check(walr_get_release_state(get(), port.c_str(), &state));
    return state;
  }
  void forgetImage(VkImage image, std::uint64_t identity = 0) { check(walr_forget_image(get(), image, identity)); }

  void record(VkCommandBuffer commands, const WalrFrame& frame) { check(walr_record(get(), commands, &frame)); }
  void resetHistory() { check(walr_reset_history(get())); }

  WalrMemory memory() const {
    auto memory = make<WalrMemory>();
    check(walr_get_memory(get(), &memory));
    return memory;
  }
  std::vector<WalrPassTime> timings() const { return detail::list(walr_get_timings, get()); }
  std::vector<WalrFinding> findings() const { return detail::list(walr_get_findings, get()); }
  std::vector<WalrCounter> counters() const { return detail::list(walr_get_counters, get()); }
  std::vector<WalrView> views() const { return detail::list(walr_get_views, get()); }
  void setView(const std::string& name) { check(walr_set_view(get(), name.c_str())); }
  void clearView() { check(walr_set_view(get(), nullptr)); }

 private:
  detail::Owned<WalrDenoiser, walr_destroy_denoiser> handle_;
};

/// A WalrPasses. Every member function is the C function of that name; all but `get` throw Error. Passes that were
/// moved from hold no handle. The GPU must have finished everything recorded when they are destroyed.
class Passes {
 public:
  Passes() = default;
  explicit Passes(const WalrPassesInfo& info) {
    WalrPasses made = nullptr;
    check(walr_create_passes(&info, &made));
    handle_ = detail::Owned<WalrPasses, walr_destroy_passes>(made);
  }

  WalrPasses get() const noexcept { return handle_.get(); }

  /// Valid as long as the passes.
  const WalrPassList& list() const {
    const WalrPassList* list = nullptr;
    check(walr_get_pass_list(get(), &list));
    return *list;
  }
  void continueFrom(const Passes& last) { check(walr_continue_passes(get(), last.get())); }
  void beginFrame(const WalrPassFrame& frame) { check(walr_begin_frame(get(), &frame)); }
  std::vector<std::byte> frameConstants(std::uint32_t resource) const {
    std::size_t size = 0;
    check(walr_get_frame_constants(get(), resource, nullptr, &size));
    std::vector<std::byte> bytes(size);
    check(walr_get_frame_constants(get(), resource, bytes.data(), &size));
    return bytes;
  }
  void record(std::uint32_t pass, VkCommandBuffer commands, const std::vector<WalrPassResource>& resources) {
    check(walr_record_pass(get(), pass, commands, resources.data(), static_cast<std::uint32_t>(resources.size())));
  }
  void forgetImage(VkImage image, std::uint64_t identity = 0) { check(walr_forget_pass_image(get(), image, identity)); }

  std::vector<WalrPassTime> timings() const { return detail::list(walr_get_pass_timings, get()); }
  std::vector<WalrFinding> findings() const { return detail::list(walr_get_pass_findings, get()); }
  std::vector<WalrCounter> counters() const { return detail::list(walr_get_pass_counters, get()); }

 private:
  detail::Owned<WalrPasses, walr_destroy_passes> handle_;
};

}  // namespace walr::cpp

#endif
