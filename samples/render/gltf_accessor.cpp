#include "samples/render/gltf_accessor.h"

#include <cmath>
#include <cstring>

#include "samples/render/scene_error.h"

namespace walr::render::gltf {
namespace {

// The elements of an accessor: `count` times `components` values, `stride` bytes apart.
struct Elements {
  std::span<const std::uint8_t> bytes;
  std::size_t count = 0;
  std::size_t stride = 0;
  int componentType = 0;
  bool normalized = false;
};

Elements findElements(const tinygltf::Model& model, int index, int type, const std::string& what) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
    throw SceneError(what + ": there is no accessor " + std::to_string(index));
  }
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const std::string name = what + ", accessor " + std::to_string(index);
  if (accessor.sparse.isSparse || accessor.bufferView < 0) {
    throw SceneError(name + ": sparse accessors and accessors without a buffer view are not supported");
  }
  if (accessor.type != type) {
    throw SceneError(name + ": has the wrong element type for this use");
  }
  const std::span<const std::uint8_t> view = bufferViewBytes(model, accessor.bufferView, name);
  const int stride = accessor.ByteStride(model.bufferViews[static_cast<std::size_t>(accessor.bufferView)]);
  const int componentBytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
  if (stride <= 0 || componentBytes <= 0 || stride < componentBytes * components) {
    throw SceneError(name + ": has an invalid component type or stride");
  }
  const auto elementBytes = static_cast<std::size_t>(componentBytes * components);
  const auto step = static_cast<std::size_t>(stride);
  const bool fits = accessor.byteOffset <= view.size() && elementBytes <= view.size() - accessor.byteOffset &&
                    accessor.count >= 1 &&
                    accessor.count - 1 <= (view.size() - accessor.byteOffset - elementBytes) / step;
  if (!fits) {
    throw SceneError(name + ": its " + std::to_string(accessor.count) + " elements do not fit buffer view " +
                     std::to_string(accessor.bufferView) + " of " + std::to_string(view.size()) + " bytes");
  }
  return {view.subspan(accessor.byteOffset), accessor.count, step, accessor.componentType, accessor.normalized};
}

template <typename T>
T load(const Elements& elements, std::size_t element, std::size_t component) {
  T value;
  std::memcpy(&value, &elements.bytes[element * elements.stride + component * sizeof(T)], sizeof(T));
  return value;
}

float loadFloat(const Elements& elements, std::size_t element, std::size_t component, const std::string& what) {
  switch (elements.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT: {
      const auto value = load<float>(elements, element, component);
      if (!std::isfinite(value)) {
        throw SceneError(what + ": element " + std::to_string(element) + " is not finite");
      }
      return value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return static_cast<float>(load<std::uint8_t>(elements, element, component)) / 255.0F;
    default:
      return static_cast<float>(load<std::uint16_t>(elements, element, component)) / 65535.0F;
  }
}

template <typename Vector>
std::vector<Vector> readVectors(const Elements& elements, const std::string& what) {
  std::vector<Vector> values(elements.count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (glm::length_t c = 0; c < Vector::length(); ++c) {
      values[i][c] = loadFloat(elements, i, static_cast<std::size_t>(c), what);
    }
  }
  return values;
}

Elements findFloats(const tinygltf::Model& model, int accessor, int type, const std::string& what) {
  const Elements elements = findElements(model, accessor, type, what);
  if (elements.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
    throw SceneError(what + ": only 32-bit floats are supported");
  }
  return elements;
}

}  // namespace

std::span<const std::uint8_t> bufferViewBytes(const tinygltf::Model& model, int view, const std::string& what) {
  if (view < 0 || static_cast<std::size_t>(view) >= model.bufferViews.size()) {
    throw SceneError(what + ": there is no buffer view " + std::to_string(view));
  }
  const tinygltf::BufferView& bufferView = model.bufferViews[static_cast<std::size_t>(view)];
  if (bufferView.buffer < 0 || static_cast<std::size_t>(bufferView.buffer) >= model.buffers.size()) {
    throw SceneError(what + ": there is no buffer " + std::to_string(bufferView.buffer));
  }
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(bufferView.buffer)].data;
  if (bufferView.byteOffset > data.size() || bufferView.byteLength > data.size() - bufferView.byteOffset) {
    throw SceneError(what + ": buffer view " + std::to_string(view) + " exceeds buffer " +
                     std::to_string(bufferView.buffer) + " of " + std::to_string(data.size()) + " bytes");
  }
  return std::span(data).subspan(bufferView.byteOffset, bufferView.byteLength);
}

std::vector<float> readScalars(const tinygltf::Model& model, int accessor, const std::string& what) {
  const Elements elements = findFloats(model, accessor, TINYGLTF_TYPE_SCALAR, what);
  std::vector<float> values(elements.count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = loadFloat(elements, i, 0, what);
  }
  return values;
}

std::vector<glm::vec3> readVec3s(const tinygltf::Model& model, int accessor, const std::string& what) {
  return readVectors<glm::vec3>(findFloats(model, accessor, TINYGLTF_TYPE_VEC3, what), what);
}

std::vector<glm::vec4> readVec4s(const tinygltf::Model& model, int accessor, const std::string& what) {
  return readVectors<glm::vec4>(findFloats(model, accessor, TINYGLTF_TYPE_VEC4, what), what);
}

std::vector<glm::vec2> readVec2s(const tinygltf::Model& model, int accessor, const std::string& what) {
  const Elements elements = findElements(model, accessor, TINYGLTF_TYPE_VEC2, what);
  const bool integer = elements.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       elements.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  if (elements.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !(integer && elements.normalized)) {
    throw SceneError(what + ": only floats and normalised unsigned integers are supported");
  }
  return readVectors<glm::vec2>(elements, what);
}

std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, const std::string& what) {
  const Elements elements = findElements(model, accessor, TINYGLTF_TYPE_SCALAR, what);
  std::vector<std::uint32_t> values(elements.count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    switch (elements.componentType) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        values[i] = load<std::uint8_t>(elements, i, 0);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        values[i] = load<std::uint16_t>(elements, i, 0);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        values[i] = load<std::uint32_t>(elements, i, 0);
        break;
      default:
        throw SceneError(what + ": indices must be unsigned integers");
    }
  }
  return values;
}

}  // namespace walr::render::gltf
