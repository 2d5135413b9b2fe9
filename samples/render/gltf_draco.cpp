#include <algorithm>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <draco/compression/decode.h>

#include "samples/render/gltf_accessor.h"
#include "samples/render/gltf_compression.h"
#include "samples/render/gltf_convert.h"
#include "samples/render/scene_error.h"
#include "samples/render/scene_limits.h"

namespace walr::render::gltf {
namespace {

// The numbers of faces and points that the library would allocate without a look at the number of bytes. They stand at
// the beginning of the data (Draco bitstream specification 2.2). Counts the sum in `total`.
void checkSizes(std::span<const std::uint8_t> bytes, std::uint64_t& total, const std::string& name) {
  constexpr std::size_t kHeader = 11;
  constexpr std::size_t kMethodAt = 8;
  if (bytes.size() <= kHeader || std::memcmp(bytes.data(), "DRACO", 5) != 0) {
    throw SceneError(name + ": is no Draco data");
  }
  if (bytes[5] != 2 || bytes[6] != 2 || bytes[7] != 1 || (bytes[kHeader - 1] & 0x80U) != 0) {
    throw SceneError(name + ": is no mesh of Draco's bitstream 2.2 without metadata");
  }
  const bool edgebreaker = bytes[kMethodAt] != 0;  // It begins with the kind of its traversal.
  std::size_t at = kHeader + (edgebreaker ? 1 : 0);
  for (int number = 0; number < 2; ++number) {
    std::uint64_t value = 0;
    for (unsigned shift = 0; at < bytes.size() && shift < 35; shift += 7) {
      const std::uint8_t byte = bytes[at++];
      value |= std::uint64_t{byte & 0x7fU} << shift;
      if ((byte & 0x80U) == 0) break;
    }
    if (value > kMostDracoElementsOfAByte.most * bytes.size()) {
      throw SceneError(name + ": has " + std::to_string(value) + " faces or points in " + std::to_string(bytes.size()) +
                       " bytes; the limit is " + std::to_string(kMostDracoElementsOfAByte.most) + " for each byte");
    }
    total += value;
  }
  if (total > kMostDracoElements.most) {
    throw SceneError(name + ": with it, meshes have more than " + std::to_string(kMostDracoElements.most) +
                     " faces and points");
  }
}

int componentType(const draco::PointAttribute& attribute, const std::string& name) {
  if (attribute.data_type() == draco::DT_FLOAT32) return TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (attribute.data_type() < draco::DT_INT8 || attribute.data_type() > draco::DT_UINT32) {
    throw SceneError(name + ": has a component type that glTF has not");
  }
  // Both enumerations go on in the same order.
  return TINYGLTF_COMPONENT_TYPE_BYTE + (attribute.data_type() - draco::DT_INT8);
}

// Adds an accessor like another one, of decoded elements. @returns its index
int addAccessor(tinygltf::Model& model, int like, int componentType, std::size_t count,
                std::vector<unsigned char> bytes, const std::string& name) {
  elementCount(model, like, name);
  tinygltf::Accessor accessor = model.accessors[static_cast<std::size_t>(like)];
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.byteOffset = 0;
  accessor.componentType = componentType;
  accessor.count = count;
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteLength = bytes.size();
  tinygltf::Buffer buffer;
  buffer.data = std::move(bytes);
  model.buffers.push_back(std::move(buffer));
  model.bufferViews.push_back(std::move(view));
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size() - 1);
}

void decodePrimitive(tinygltf::Model& model, tinygltf::Primitive& primitive, const tinygltf::Value& source,
                     std::uint64_t& total, const std::string& name) {
  const std::span<const std::uint8_t> bytes =
      bufferViewBytes(model, static_cast<int>(readCount(source, "bufferView", name)), name);
  checkSizes(bytes, total, name);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto result = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) throw SceneError(name + ": " + result.status().error_msg_string());
  const draco::Mesh& mesh = *result.value();

  std::vector<unsigned char> indices;
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
    for (const draco::PointIndex& point : mesh.face(face)) {
      const std::uint32_t index = point.value();
      const auto* const first = reinterpret_cast<const unsigned char*>(&index);
      indices.insert(indices.end(), first, first + sizeof index);
    }
  }
  primitive.indices = addAccessor(model, primitive.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                  std::size_t{3} * mesh.num_faces(), std::move(indices), name + " indices");
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  for (auto& [semantic, accessor] : primitive.attributes) {
    const tinygltf::Value& ids = source.Get("attributes");
    if (!ids.Has(semantic)) continue;
    const std::string what = name + " " + semantic;
    const draco::PointAttribute* const attribute =
        mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(readCount(ids, semantic.c_str(), what)));
    elementCount(model, accessor, what);
    const int components = tinygltf::GetNumComponentsInType(
        static_cast<std::uint32_t>(model.accessors[static_cast<std::size_t>(accessor)].type));
    if (attribute == nullptr || attribute->num_components() != components) {
      throw SceneError(what + ": the compressed data have no such attribute");
    }
    const int type = componentType(*attribute, what);
    const auto elementBytes = static_cast<std::size_t>(draco::DataTypeLength(attribute->data_type()) * components);
    std::vector<unsigned char> values(elementBytes * mesh.num_points());
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
      attribute->GetMappedValue(point, &values[point.value() * elementBytes]);
    }
    accessor = addAccessor(model, accessor, type, mesh.num_points(), std::move(values), what);
  }
}

}  // namespace

void decodeDraco(tinygltf::Model& model) {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    for (std::size_t p = 0; p < model.meshes[i].primitives.size(); ++p) {
      tinygltf::Primitive& primitive = model.meshes[i].primitives[p];
      const auto extension = primitive.extensions.find(kDracoExtension);
      if (extension == primitive.extensions.end()) continue;
      decodePrimitive(
          model, primitive, extension->second, total,
          partName("mesh", i, model.meshes[i].name) + " primitive " + std::to_string(p) + " " + kDracoExtension);
    }
  }
}

}  // namespace walr::render::gltf
