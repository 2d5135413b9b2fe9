#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

/// Reflection of a compute shader's SPIR-V. The structs own their strings. `fg::Shader` (framegraph/declare/shader.h)
/// has the same members and documents them; it is what is compiled into the program.
namespace fg::tools {

struct ReflectedBinding {
  std::string name;
  std::uint32_t binding = 0;
  VkDescriptorType type{};
  bool reads = false;
  bool writes = false;
  VkFormat format = VK_FORMAT_UNDEFINED;
  std::uint32_t blockSize = 0;
};

struct ReflectedConstant {
  std::string name;
  std::uint32_t id = 0;
};

struct Reflection {
  std::vector<ReflectedBinding> bindings;    ///< Ordered by binding number.
  std::vector<ReflectedConstant> constants;  ///< Ordered by id.
  std::uint32_t pushConstantSize = 0;
  std::array<std::uint32_t, 3> localSize{1, 1, 1};
};

/// Reflect a compute shader.
///
/// - Bindings that the shader declares but does not use are left out.
/// - A binding has the name of its variable. A uniform or storage block without an instance name has its block name.
/// - Accesses are those that the declaration allows: a storage image or buffer that is neither `readonly` nor
///   `writeonly` counts as read and written.
///
/// @throws std::runtime_error if the SPIR-V cannot be parsed, or is not supported: another stage, a descriptor set
///         other than 0, an array of descriptors, a sampler without a texture, two variables
///         at one binding, a work group size that is a specialization constant
Reflection reflect(const std::vector<std::uint32_t>& code);

}  // namespace fg::tools
