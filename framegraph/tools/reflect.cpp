#include "framegraph/tools/reflect.h"

#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>

#include <spirv_cross/spirv.h>
#include <spirv_cross/spirv_cross_c.h>

namespace fg::tools {
namespace {

struct DestroyContext {
  void operator()(spvc_context context) const { spvc_context_destroy(context); }
};
using Context = std::unique_ptr<spvc_context_s, DestroyContext>;

class Reflector {
 public:
  explicit Reflector(const std::vector<std::uint32_t>& code) {
    spvc_context context = nullptr;
    if (spvc_context_create(&context) != SPVC_SUCCESS) throw std::runtime_error("SPIRV-Cross cannot create a context");
    context_.reset(context);
    spvc_parsed_ir ir = nullptr;
    check(spvc_context_parse_spirv(context, code.data(), code.size(), &ir));
    check(spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
    if (spvc_compiler_get_execution_model(compiler_) != SpvExecutionModelGLCompute) {
      throw std::runtime_error("it is not a compute shader");
    }
  }

  Reflection run() {
    Reflection reflection;
    reflection.bindings = bindings();
    reflection.constants = constants();
    reflection.pushConstantSize = pushConstantSize();
    reflection.localSize = localSize();
    return reflection;
  }

 private:
  void check(spvc_result result) const {
    if (result != SPVC_SUCCESS) throw std::runtime_error(spvc_context_get_last_error_string(context_.get()));
  }

  std::span<const spvc_reflected_resource> list(spvc_resources resources, spvc_resource_type type) const {
    const spvc_reflected_resource* first = nullptr;
    std::size_t count = 0;
    check(spvc_resources_get_resource_list_for_type(resources, type, &first, &count));
    return {first, count};
  }

  std::uint32_t structSize(spvc_type_id type) const {
    std::size_t size = 0;
    check(spvc_compiler_get_declared_struct_size(compiler_, spvc_compiler_get_type_handle(compiler_, type), &size));
    return static_cast<std::uint32_t>(size);
  }

  std::string name(const spvc_reflected_resource& resource) const {
    const std::string variable = spvc_compiler_get_name(compiler_, resource.id);
    return variable.empty() ? spvc_compiler_get_name(compiler_, resource.base_type_id) : variable;
  }

  bool hasDecoration(const spvc_reflected_resource& resource, VkDescriptorType type, SpvDecoration decoration) const {
    if (type != VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
      return spvc_compiler_has_decoration(compiler_, resource.id, decoration) == SPVC_TRUE;
    }
    const SpvDecoration* first = nullptr;
    std::size_t count = 0;
    check(spvc_compiler_get_buffer_block_decorations(compiler_, resource.id, &first, &count));
    return std::find(first, first + count, decoration) != first + count;
  }

  ReflectedBinding binding(const spvc_reflected_resource& resource, VkDescriptorType type) const;
  std::vector<ReflectedBinding> bindings() const;
  std::vector<ReflectedConstant> constants() const;
  std::uint32_t pushConstantSize() const;
  std::array<std::uint32_t, 3> localSize() const;

  Context context_;
  spvc_compiler compiler_ = nullptr;
};

VkFormat vulkanFormat(SpvImageFormat format) {
  switch (format) {
    case SpvImageFormatUnknown:
      return VK_FORMAT_UNDEFINED;
    case SpvImageFormatRgba32f:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case SpvImageFormatRgba16f:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
    case SpvImageFormatR32f:
      return VK_FORMAT_R32_SFLOAT;
    case SpvImageFormatRgba8:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case SpvImageFormatRgba8Snorm:
      return VK_FORMAT_R8G8B8A8_SNORM;
    case SpvImageFormatRg32f:
      return VK_FORMAT_R32G32_SFLOAT;
    case SpvImageFormatRg16f:
      return VK_FORMAT_R16G16_SFLOAT;
    case SpvImageFormatR11fG11fB10f:
      return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
    case SpvImageFormatR16f:
      return VK_FORMAT_R16_SFLOAT;
    case SpvImageFormatRgba16:
      return VK_FORMAT_R16G16B16A16_UNORM;
    case SpvImageFormatRgb10A2:
      return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    case SpvImageFormatRg16:
      return VK_FORMAT_R16G16_UNORM;
    case SpvImageFormatRg8:
      return VK_FORMAT_R8G8_UNORM;
    case SpvImageFormatR16:
      return VK_FORMAT_R16_UNORM;
    case SpvImageFormatR8:
      return VK_FORMAT_R8_UNORM;
    case SpvImageFormatRgba16Snorm:
      return VK_FORMAT_R16G16B16A16_SNORM;
    case SpvImageFormatRg16Snorm:
      return VK_FORMAT_R16G16_SNORM;
    case SpvImageFormatRg8Snorm:
      return VK_FORMAT_R8G8_SNORM;
    case SpvImageFormatR16Snorm:
      return VK_FORMAT_R16_SNORM;
    case SpvImageFormatR8Snorm:
      return VK_FORMAT_R8_SNORM;
    case SpvImageFormatRgba32i:
      return VK_FORMAT_R32G32B32A32_SINT;
    case SpvImageFormatRgba16i:
      return VK_FORMAT_R16G16B16A16_SINT;
    case SpvImageFormatRgba8i:
      return VK_FORMAT_R8G8B8A8_SINT;
    case SpvImageFormatR32i:
      return VK_FORMAT_R32_SINT;
    case SpvImageFormatRg32i:
      return VK_FORMAT_R32G32_SINT;
    case SpvImageFormatRg16i:
      return VK_FORMAT_R16G16_SINT;
    case SpvImageFormatRg8i:
      return VK_FORMAT_R8G8_SINT;
    case SpvImageFormatR16i:
      return VK_FORMAT_R16_SINT;
    case SpvImageFormatR8i:
      return VK_FORMAT_R8_SINT;
    case SpvImageFormatRgba32ui:
      return VK_FORMAT_R32G32B32A32_UINT;
    case SpvImageFormatRgba16ui:
      return VK_FORMAT_R16G16B16A16_UINT;
    case SpvImageFormatRgba8ui:
      return VK_FORMAT_R8G8B8A8_UINT;
    case SpvImageFormatR32ui:
      return VK_FORMAT_R32_UINT;
    case SpvImageFormatRgb10a2ui:
      return VK_FORMAT_A2B10G10R10_UINT_PACK32;
    case SpvImageFormatRg32ui:
      return VK_FORMAT_R32G32_UINT;
    case SpvImageFormatRg16ui:
      return VK_FORMAT_R16G16_UINT;
    case SpvImageFormatRg8ui:
      return VK_FORMAT_R8G8_UINT;
    case SpvImageFormatR16ui:
      return VK_FORMAT_R16_UINT;
    case SpvImageFormatR8ui:
      return VK_FORMAT_R8_UINT;
    case SpvImageFormatR64ui:
      return VK_FORMAT_R64_UINT;
    case SpvImageFormatR64i:
      return VK_FORMAT_R64_SINT;
    case SpvImageFormatMax:
      break;
  }
  throw std::runtime_error("unknown storage image format " + std::to_string(format));
}

ReflectedBinding Reflector::binding(const spvc_reflected_resource& resource, VkDescriptorType type) const {
  ReflectedBinding result;
  result.name = name(resource);
  result.binding = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationBinding);
  result.type = type;
  if (spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationDescriptorSet) != 0) {
    throw std::runtime_error("binding '" + result.name + "' is not in descriptor set 0");
  }
  const spvc_type handle = spvc_compiler_get_type_handle(compiler_, resource.type_id);
  if (spvc_type_get_num_array_dimensions(handle) != 0) {
    throw std::runtime_error("binding '" + result.name + "' is an array of descriptors");
  }
  const bool storage = type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE || type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  result.reads = !storage || !hasDecoration(resource, type, SpvDecorationNonReadable);
  result.writes = storage && !hasDecoration(resource, type, SpvDecorationNonWritable);
  if (type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) {
    result.format = vulkanFormat(spvc_type_get_image_storage_format(handle));
  }
  if (type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) result.blockSize = structSize(resource.base_type_id);
  return result;
}

std::vector<ReflectedBinding> Reflector::bindings() const {
  struct Kind {
    spvc_resource_type resource;
    VkDescriptorType descriptor;
  };
  static constexpr Kind kKinds[] = {
      {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
      {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
      {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
      {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
      {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
      {SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR},
  };
  spvc_set active = nullptr;
  check(spvc_compiler_get_active_interface_variables(compiler_, &active));
  spvc_resources resources = nullptr;
  check(spvc_compiler_create_shader_resources_for_active_variables(compiler_, &resources, active));
  for (const spvc_reflected_resource& resource : list(resources, SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS)) {
    throw std::runtime_error("binding '" + name(resource) + "' is a sampler without a texture: declare a sampler2D");
  }
  std::vector<ReflectedBinding> result;
  for (const Kind& kind : kKinds) {
    for (const spvc_reflected_resource& resource : list(resources, kind.resource)) {
      result.push_back(binding(resource, kind.descriptor));
    }
  }
  std::ranges::sort(result, {}, &ReflectedBinding::binding);
  const auto twin = std::ranges::adjacent_find(result, {}, &ReflectedBinding::binding);
  if (twin != result.end()) {
    throw std::runtime_error("'" + twin->name + "' and '" + std::next(twin)->name + "' are both at binding " +
                             std::to_string(twin->binding));
  }
  return result;
}

std::vector<ReflectedConstant> Reflector::constants() const {
  const spvc_specialization_constant* first = nullptr;
  std::size_t count = 0;
  check(spvc_compiler_get_specialization_constants(compiler_, &first, &count));
  std::vector<ReflectedConstant> result;
  for (const spvc_specialization_constant& constant : std::span(first, count)) {
    result.push_back({spvc_compiler_get_name(compiler_, constant.id), constant.constant_id});
  }
  std::ranges::sort(result, {}, &ReflectedConstant::id);
  return result;
}

std::uint32_t Reflector::pushConstantSize() const {
  spvc_resources resources = nullptr;
  check(spvc_compiler_create_shader_resources(compiler_, &resources));
  const auto blocks = list(resources, SPVC_RESOURCE_TYPE_PUSH_CONSTANT);
  return blocks.empty() ? 0 : structSize(blocks.front().base_type_id);
}

std::array<std::uint32_t, 3> Reflector::localSize() const {
  spvc_specialization_constant sizes[3] = {};
  spvc_compiler_get_work_group_size_specialization_constants(compiler_, &sizes[0], &sizes[1], &sizes[2]);
  if (std::ranges::any_of(sizes, [](const auto& size) { return size.id != 0; })) {
    throw std::runtime_error("the work group size is a specialization constant; write it as numbers");
  }
  std::array<std::uint32_t, 3> result{};
  for (unsigned i = 0; i < 3; ++i) {
    result[i] = spvc_compiler_get_execution_mode_argument_by_index(compiler_, SpvExecutionModeLocalSize, i);
  }
  return result;
}

}  // namespace

Reflection reflect(const std::vector<std::uint32_t>& code) {
  return Reflector(code).run();
}

}  // namespace fg::tools
