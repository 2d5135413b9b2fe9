#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

/// Reflection of a compute shader's SPIR-V. The structs own their strings; `fg::Shader` (framegraph/shader.h) is the
/// form in which the result is compiled into the program, and explains the members.
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

/// Find out what a shader binds.
///
/// - A binding counts where the shader uses it; one that is declared and never used is left out.
/// - Its name is the variable's; a uniform or storage block without an instance name goes by its block name.
/// - Access is what the declaration allows: a storage image or buffer that is neither `readonly` nor `writeonly` reads
///   and writes.
///
/// @throws std::runtime_error where the SPIR-V cannot be read, or has something that a compute pass cannot bind:
///         another stage, a descriptor set other than 0, an array of descriptors, two variables at one binding, a
///         work group size that is a specialization constant
Reflection reflect(const std::vector<std::uint32_t>& code);

}  // namespace fg::tools
