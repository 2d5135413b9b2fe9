#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include <vulkan/vulkan_core.h>

namespace fg {

/// One binding of a shader, and how the shader accesses it. Reflected from its SPIR-V at build time.
struct ShaderBinding {
  std::string_view name;                  ///< Variable name in the shader source.
  std::uint32_t set = 0;                  ///< Descriptor set. The frame graph uses set 0 only.
  std::uint32_t binding = 0;              ///< Binding number inside the set.
  VkDescriptorType type{};                ///< Descriptor type.
  bool reads = false;                     ///< False for `writeonly` images and buffers.
  bool writes = false;                    ///< False for `readonly` ones, and for sampled images and uniform blocks.
  VkFormat format = VK_FORMAT_UNDEFINED;  ///< Declared format of a storage image; undefined if there is none.
  std::uint32_t blockSize = 0;            ///< Size in bytes of a uniform block; 0 otherwise.
};

/// A specialization constant of a shader.
struct ShaderConstant {
  std::string_view name;  ///< Variable name in the shader source.
  std::uint32_t id = 0;   ///< `constant_id`.
};

/// A compute shader embedded in the program: its SPIR-V and the results of reflection at build time.
///
/// The CMake function `walr_add_shaders` generates objects of this type. They live until the program ends, so that a
/// `const Shader*` identifies a shader.
struct Shader {
  std::string_view name;                      ///< File name without extension, plus the variant.
  std::span<const std::uint32_t> code;        ///< SPIR-V words.
  std::span<const ShaderBinding> bindings;    ///< Ordered by binding number.
  std::span<const ShaderConstant> constants;  ///< Ordered by id.
  std::uint32_t pushConstantSize = 0;         ///< Bytes; 0 if there is no push constant block.
  std::uint32_t localSize[3] = {1, 1, 1};     ///< Work group size in threads.
  /// The same shader with arithmetic in halves, for devices with the feature shaderFloat16. All but its name and code
  /// are the same. Null: there is none.
  const Shader* inHalves = nullptr;
};

}  // namespace fg
