#include "samples/render/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "samples/render/scene_error.h"

namespace walr::render::gltf {
namespace {

// The elements of an accessor: `count` times `components` values, `stride` bytes apart.
struct Elements {
  std::span<const std::uint8_t> view{};  // Of the file, unless the elements are stored here.
  std::vector<std::uint8_t> stored{};
  std::size_t count = 0;
  std::size_t stride = 0;
  int componentType = 0;
  bool normalized = false;

  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return stored.empty() ? view : stored; }
};

// The bytes of a view from an offset on.
// @throws SceneError if they are too few for the elements
std::span<const std::uint8_t> elementsInView(const tinygltf::Model& model, int view, std::size_t byteOffset,
                                             std::size_t count, std::size_t elementBytes, std::size_t stride,
                                             const std::string& name) {
  const std::span<const std::uint8_t> bytes = bufferViewBytes(model, view, name);
  const bool fits = byteOffset <= bytes.size() && elementBytes <= bytes.size() - byteOffset && count >= 1 &&
                    count - 1 <= (bytes.size() - byteOffset - elementBytes) / stride;
  if (!fits) {
    throw SceneError(name + ": its " + std::to_string(count) + " elements do not fit buffer view " +
                     std::to_string(view) + " of " + std::to_string(bytes.size()) + " bytes");
  }
  return bytes.subspan(byteOffset);
}

std::size_t componentSize(int componentType, const std::string& name) {
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(componentType));
  if (size <= 0) throw SceneError(name + ": has an invalid component type");
  return static_cast<std::size_t>(size);
}

std::uint32_t loadIndex(const Elements& elements, std::size_t element, const std::string& what);

// Replaces the elements that a sparse accessor lists (specification, 3.6.2.3).
void replaceSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, Elements& elements,
                   const std::string& name) {
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<std::size_t>(sparse.count);
  if (sparse.count < 0 || count > elements.count) {
    throw SceneError(name + ": replaces " + std::to_string(sparse.count) + " of " + std::to_string(elements.count) +
                     " elements");
  }
  Elements indices{.count = count,
                   .stride = componentSize(sparse.indices.componentType, name),
                   .componentType = sparse.indices.componentType};
  indices.view = elementsInView(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                                count, indices.stride, indices.stride, name + " sparse indices");
  const std::span<const std::uint8_t> values =
      elementsInView(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                     elements.stride, elements.stride, name + " sparse values");
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = loadIndex(indices, i, name + " sparse indices");
    if (index >= elements.count) {
      throw SceneError(name + " sparse indices: index " + std::to_string(index) + " exceeds its " +
                       std::to_string(elements.count) + " elements");
    }
    std::memcpy(&elements.stored[index * elements.stride], &values[i * elements.stride], elements.stride);
  }
}

Elements findElements(const tinygltf::Model& model, int index, int type, const std::string& what) {
  const std::size_t count = elementCount(model, index, what);
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const std::string name = what + ", accessor " + std::to_string(index);
  if (accessor.type != type) {
    throw SceneError(name + ": has the wrong element type for this use");
  }
  const std::size_t elementBytes =
      componentSize(accessor.componentType, name) *
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
  Elements elements{.count = count,
                    .stride = elementBytes,
                    .componentType = accessor.componentType,
                    .normalized = accessor.normalized};
  if (accessor.bufferView >= 0) {
    bufferViewBytes(model, accessor.bufferView, name);
    const int stride = accessor.ByteStride(model.bufferViews[static_cast<std::size_t>(accessor.bufferView)]);
    if (stride < static_cast<int>(elementBytes)) {
      throw SceneError(name + ": has an invalid stride");
    }
    elements.stride = static_cast<std::size_t>(stride);
    elements.view =
        elementsInView(model, accessor.bufferView, accessor.byteOffset, count, elementBytes, elements.stride, name);
  }
  if (accessor.bufferView < 0 || accessor.sparse.isSparse) {
    std::vector<std::uint8_t> stored(count * elementBytes);  // Zeros, if there is no view.
    for (std::size_t i = 0; !elements.view.empty() && i < count; ++i) {
      std::memcpy(&stored[i * elementBytes], &elements.view[i * elements.stride], elementBytes);
    }
    elements.stored = std::move(stored);
    elements.stride = elementBytes;
  }
  if (accessor.sparse.isSparse) replaceSparse(model, accessor, elements, name);
  return elements;
}

template <typename T>
T load(const Elements& elements, std::size_t element, std::size_t component) {
  T value;
  std::memcpy(&value, &elements.bytes()[element * elements.stride + component * sizeof(T)], sizeof(T));
  return value;
}

// Normalised integers: specification, 3.11.
template <typename T>
float loadInteger(const Elements& elements, std::size_t element, std::size_t component) {
  const auto value = static_cast<float>(load<T>(elements, element, component));
  return elements.normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F) : value;
}

float loadFloat(const Elements& elements, std::size_t element, std::size_t component, const std::string& what,
                bool finite = true) {
  switch (elements.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT: {
      const auto value = load<float>(elements, element, component);
      if (finite && !std::isfinite(value)) {
        throw SceneError(what + ": element " + std::to_string(element) + " is not finite");
      }
      return value;
    }
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return loadInteger<std::int8_t>(elements, element, component);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return loadInteger<std::uint8_t>(elements, element, component);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return loadInteger<std::int16_t>(elements, element, component);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return loadInteger<std::uint16_t>(elements, element, component);
    default:
      throw SceneError(what + ": only 32-bit floats and integers of 8 and 16 bits are supported");
  }
}

std::uint32_t loadIndex(const Elements& elements, std::size_t element, const std::string& what) {
  switch (elements.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(elements, element, 0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(elements, element, 0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(elements, element, 0);
    default:
      throw SceneError(what + ": indices must be unsigned integers");
  }
}

template <typename Vector>
std::vector<Vector> readVectors(const Elements& elements, const std::string& what, std::size_t* flawed) {
  std::vector<Vector> values(elements.count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    bool finite = true;
    for (glm::length_t c = 0; c < Vector::length(); ++c) {
      values[i][c] = loadFloat(elements, i, static_cast<std::size_t>(c), what, flawed == nullptr);
      finite = finite && std::isfinite(values[i][c]);
    }
    if (finite) continue;
    values[i] = Vector(0.0F);
    ++*flawed;
  }
  return values;
}

}  // namespace

std::span<const std::uint8_t> bufferViewBytes(const tinygltf::Model& model, int view, const std::string& what) {
  if (view < 0 || static_cast<std::size_t>(view) >= model.bufferViews.size()) {
    throw SceneError(what + ": there is no buffer view " + std::to_string(view));
  }
  const tinygltf::BufferView& bufferView = model.bufferViews[static_cast<std::size_t>(view)];
  return bufferBytes(model, bufferView.buffer, bufferView.byteOffset, bufferView.byteLength,
                     what + ": buffer view " + std::to_string(view));
}

std::span<const std::uint8_t> bufferBytes(const tinygltf::Model& model, int buffer, std::size_t offset,
                                          std::size_t length, const std::string& what) {
  if (buffer < 0 || static_cast<std::size_t>(buffer) >= model.buffers.size()) {
    throw SceneError(what + ": there is no buffer " + std::to_string(buffer));
  }
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(buffer)].data;
  if (offset > data.size() || length > data.size() - offset) {
    throw SceneError(what + " exceeds buffer " + std::to_string(buffer) + " of " + std::to_string(data.size()) +
                     " bytes");
  }
  return std::span(data).subspan(offset, length);
}

std::size_t elementCount(const tinygltf::Model& model, int accessor, const std::string& what) {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) {
    throw SceneError(what + ": there is no accessor " + std::to_string(accessor));
  }
  const std::size_t count = model.accessors[static_cast<std::size_t>(accessor)].count;
  if (count == 0) throw SceneError(what + ", accessor " + std::to_string(accessor) + ": has no elements");
  return count;
}

std::vector<float> readScalars(const tinygltf::Model& model, int accessor, const std::string& what) {
  const Elements elements = findElements(model, accessor, TINYGLTF_TYPE_SCALAR, what);
  std::vector<float> values(elements.count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = loadFloat(elements, i, 0, what);
  }
  return values;
}

std::vector<glm::vec2> readVec2s(const tinygltf::Model& model, int accessor, const std::string& what,
                                 std::size_t* flawed) {
  return readVectors<glm::vec2>(findElements(model, accessor, TINYGLTF_TYPE_VEC2, what), what, flawed);
}

std::vector<glm::vec3> readVec3s(const tinygltf::Model& model, int accessor, const std::string& what,
                                 std::size_t* flawed) {
  return readVectors<glm::vec3>(findElements(model, accessor, TINYGLTF_TYPE_VEC3, what), what, flawed);
}

std::vector<glm::vec4> readVec4s(const tinygltf::Model& model, int accessor, const std::string& what,
                                 std::size_t* flawed) {
  return readVectors<glm::vec4>(findElements(model, accessor, TINYGLTF_TYPE_VEC4, what), what, flawed);
}

std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, const std::string& what) {
  const Elements elements = findElements(model, accessor, TINYGLTF_TYPE_SCALAR, what);
  std::vector<std::uint32_t> values(elements.count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = loadIndex(elements, i, what);
  }
  return values;
}

}  // namespace walr::render::gltf
