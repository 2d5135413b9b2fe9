#pragma once

#include <memory>
#include <type_traits>

namespace fg::vk {

/// Destroys an instance or a device by its function, such as vkDestroyDevice.
template <typename Function>
struct DestroyBy {
  Function function = nullptr;

  template <typename Handle>
  void operator()(Handle handle) const {
    function(handle, nullptr);
  }
};

/// An instance or a device, destroyed in the destructor. What a device creates is `Owned`.
template <typename Handle, typename Function>
using UniqueHandle = std::unique_ptr<std::remove_pointer_t<Handle>, DestroyBy<Function>>;

}  // namespace fg::vk
