#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <meshoptimizer.h>

#include "samples/render/gltf_accessor.h"
#include "samples/render/gltf_compression.h"
#include "samples/render/gltf_convert.h"
#include "samples/render/scene_error.h"
#include "samples/render/scene_limits.h"

namespace walr::render::gltf {
namespace {

struct Compressed {
  std::span<const std::uint8_t> bytes;
  std::size_t count = 0;
  std::size_t stride = 0;
  std::string mode;
  std::string filter;
};

using Decoder = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
const std::map<std::string, Decoder> kDecoders = {{"ATTRIBUTES", &meshopt_decodeVertexBuffer},
                                                  {"TRIANGLES", &meshopt_decodeIndexBuffer},
                                                  {"INDICES", &meshopt_decodeIndexSequence}};

using Filter = void (*)(void*, std::size_t, std::size_t);
const std::map<std::string, Filter> kFilters = {{"OCTAHEDRAL", &meshopt_decodeFilterOct},
                                                {"QUATERNION", &meshopt_decodeFilterQuat},
                                                {"EXPONENTIAL", &meshopt_decodeFilterExp}};

std::string textOf(const tinygltf::Value& object, const char* key, const std::string& byDefault) {
  return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : byDefault;
}

// The rules of the extension; the library relies on them.
bool isValid(const Compressed& c) {
  if (c.count == 0 || !kDecoders.contains(c.mode)) return false;
  if (c.mode != "ATTRIBUTES") {
    return (c.stride == 2 || c.stride == 4) && c.filter == "NONE" && (c.mode != "TRIANGLES" || c.count % 3 == 0);
  }
  return c.stride > 0 && c.stride % 4 == 0 && c.stride <= 256 &&
         (c.filter == "NONE" || c.filter == "EXPONENTIAL" || (c.filter == "OCTAHEDRAL" && c.stride <= 8) ||
          (c.filter == "QUATERNION" && c.stride == 8));
}

std::vector<unsigned char> decode(const Compressed& c, const std::string& name) {
  std::vector<unsigned char> decoded(c.count * c.stride);
  if (kDecoders.at(c.mode)(decoded.data(), c.count, c.stride, c.bytes.data(), c.bytes.size()) != 0) {
    throw SceneError(name + ": its compressed data are damaged");
  }
  if (const auto filter = kFilters.find(c.filter); filter != kFilters.end()) {
    filter->second(decoded.data(), c.count, c.stride);
  }
  return decoded;
}

}  // namespace

void decodeMeshopt(tinygltf::Model& model) {
  std::size_t budget = 0;
  for (const tinygltf::Buffer& buffer : model.buffers) budget += buffer.data.size();
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    tinygltf::BufferView& view = model.bufferViews[i];
    const auto extension = view.extensions.find(kMeshoptExtension);
    if (extension == view.extensions.end()) continue;
    const tinygltf::Value& source = extension->second;
    const std::string name = partName("buffer view", i, view.name) + " " + kMeshoptExtension;
    Compressed c{.bytes = bufferBytes(model, static_cast<int>(readCount(source, "buffer", name)),
                                      source.Has("byteOffset") ? readCount(source, "byteOffset", name) : 0,
                                      readCount(source, "byteLength", name), name),
                 .count = readCount(source, "count", name),
                 .stride = readCount(source, "byteStride", name),
                 .mode = textOf(source, "mode", ""),
                 .filter = textOf(source, "filter", "NONE")};
    if (!isValid(c)) throw SceneError(name + ": has an invalid mode, filter, stride or count");
    // The codec stores at least two bits for each byte of 16 elements. Views do not share bytes.
    if (c.bytes.size() > budget || c.count > kMostMeshoptBytesOfAByte.most * c.bytes.size() / c.stride) {
      throw SceneError(name + ": its " + std::to_string(c.count) + " elements exceed what its bytes can hold");
    }
    budget -= c.bytes.size();
    tinygltf::Buffer decoded;
    decoded.data = decode(c, name);
    view.buffer = static_cast<int>(model.buffers.size());
    view.byteOffset = 0;
    view.byteLength = decoded.data.size();
    model.buffers.push_back(std::move(decoded));
  }
}

}  // namespace walr::render::gltf
