#include <algorithm>
#include <cmath>
#include <span>

#include <glm/common.hpp>

#include "samples/render/gltf_accessor.h"
#include "samples/render/gltf_convert.h"
#include "samples/render/gltf_json.h"
#include "samples/render/image_decode.h"
#include "samples/render/scene_error.h"
#include "samples/render/scene_limits.h"

namespace walr::render::gltf {
namespace {

using OptionalIndices = std::vector<std::optional<std::uint32_t>>;

OptionalIndices convertImages(const tinygltf::Model& model, Scene& scene) {
  OptionalIndices indices;
  std::uint64_t budget = kMostTexels.most;
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const tinygltf::Image& source = model.images[i];
    const std::string name = partName("image", i, source.uri.empty() ? source.name : source.uri);
    indices.emplace_back();
    if (source.bufferView < 0 && source.image.empty()) {
      scene.warnings.push_back(name + ": not found; it is not used");
      continue;
    }
    try {
      const std::span<const std::uint8_t> bytes =
          source.bufferView < 0 ? std::span(source.image) : bufferViewBytes(model, source.bufferView, name);
      std::string warning;
      Image image = decodeImage(bytes, budget, warning);
      if (!warning.empty()) scene.warnings.push_back(name + ": may be damaged: " + warning);
      image.name = name;
      indices.back() = static_cast<std::uint32_t>(scene.images.size());
      scene.images.push_back(std::move(image));
    } catch (const SceneError& error) {
      scene.warnings.push_back(name + ": " + error.what() + "; it is not used");
    }
  }
  return indices;
}

Wrap convertWrap(int wrap) {
  switch (wrap) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::ClampToEdge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::MirroredRepeat;
    default:
      return Wrap::Repeat;
  }
}

glm::vec2 pairOf(const tinygltf::Value& object, const std::string& key, const glm::vec2& byDefault) {
  const tinygltf::Value& value = object.Get(key);
  if (!value.IsArray() || value.ArrayLen() != 2) return byDefault;
  return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
}

template <typename TextureInfo>
TextureCoordinates coordinatesOf(const TextureInfo& info) {
  TextureCoordinates coordinates;
  coordinates.set = info.texCoord;
  const auto extension = info.extensions.find("KHR_texture_transform");
  if (extension == info.extensions.end() || !extension->second.IsObject()) return coordinates;
  const tinygltf::Value& transform = extension->second;
  if (transform.Has("texCoord")) coordinates.set = transform.Get("texCoord").GetNumberAsInt();
  const glm::vec2 offset = pairOf(transform, "offset", glm::vec2(0.0F));
  const glm::vec2 scale = pairOf(transform, "scale", glm::vec2(1.0F));
  const auto rotation = static_cast<float>(transform.Get("rotation").GetNumberAsDouble());
  const float c = std::cos(rotation);
  const float s = std::sin(rotation);
  // Scale, then rotation counter-clockwise with v down, then offset.
  coordinates.transform = glm::mat3x2(glm::vec2(c, -s) * scale.x, glm::vec2(s, c) * scale.y, offset);
  return coordinates;
}

// Finds the textures of one material.
class TextureFinder {
 public:
  TextureFinder(const OptionalIndices& textures, std::string name, Material& material, Scene& scene)
      : textures_(textures), name_(std::move(name)), material_(material), scene_(scene) {}

  template <typename TextureInfo>
  std::optional<std::uint32_t> find(const TextureInfo& info, const std::string& use) const {
    if (info.index < 0) {
      return std::nullopt;
    }
    const std::string what = name_ + " " + use;
    if (static_cast<std::size_t>(info.index) >= textures_.size()) {
      throw SceneError(what + ": there is no texture " + std::to_string(info.index));
    }
    const std::optional<std::uint32_t> texture = textures_[static_cast<std::size_t>(info.index)];
    return texture ? std::optional(sampledAt(coordinatesOf(info), *texture)) : std::nullopt;
  }

 private:
  // The texture, or one like it that is sampled at other coordinates.
  std::uint32_t sampledAt(const TextureCoordinates& coordinates, std::uint32_t texture) const {
    std::vector<TextureCoordinates>& all = material_.coordinates;
    const auto found = std::ranges::find(all, coordinates);
    const auto index = static_cast<std::uint32_t>(found - all.begin());
    if (found == all.end()) all.push_back(coordinates);
    if (index == 0) return texture;
    Texture other = scene_.textures[texture];
    other.coordinates = index;
    scene_.textures.push_back(other);
    return static_cast<std::uint32_t>(scene_.textures.size() - 1);
  }

  const OptionalIndices& textures_;
  std::string name_;
  Material& material_;
  Scene& scene_;
};

float unitInterval(double value, const std::string& what, Scene& scene) {
  if (!(value >= 0.0 && value <= 1.0)) {
    scene.warnings.push_back(what + ": clamped to 0..1");
  }
  return static_cast<float>(glm::clamp(value, 0.0, 1.0));
}

float emissiveStrength(const tinygltf::Material& source, const std::string& name) {
  const auto extension = source.extensions.find("KHR_materials_emissive_strength");
  if (extension == source.extensions.end() || !extension->second.Has("emissiveStrength")) {
    return 1.0F;
  }
  const double strength = extension->second.Get("emissiveStrength").GetNumberAsDouble();
  constexpr double kLargest = 1e9;
  if (!(strength >= 0.0 && strength <= kLargest)) {
    throw SceneError(name + " emissiveStrength: must lie in 0..1e9");
  }
  return static_cast<float>(strength);
}

tinygltf::TextureInfo textureOf(const tinygltf::Value& object, const char* key) {
  tinygltf::TextureInfo info;
  const tinygltf::Value& value = object.Get(key);
  if (!value.IsObject()) return info;
  info.index = value.Has("index") ? value.Get("index").GetNumberAsInt() : -1;
  info.texCoord = value.Has("texCoord") ? value.Get("texCoord").GetNumberAsInt() : 0;
  const tinygltf::Value& extensions = value.Get("extensions");
  for (const std::string& name : extensions.Keys()) info.extensions[name] = extensions.Get(name);
  return info;
}

std::vector<double> numbersOf(const tinygltf::Value& object, const char* key, std::vector<double> byDefault) {
  const tinygltf::Value& value = object.Get(key);
  if (!value.IsArray() || value.ArrayLen() != byDefault.size()) return byDefault;
  for (std::size_t i = 0; i < byDefault.size(); ++i) {
    byDefault[i] = value.Get(static_cast<int>(i)).GetNumberAsDouble();
  }
  return byDefault;
}

// A material of KHR_materials_pbrSpecularGlossiness as far as metallic and roughness can say it: its diffuse lobe and
// its roughness, and the specular lobe of a metal, which has no diffuse one, or of a dielectric. Textures of specular
// colours and glossiness are left out.
// @param specularLost  becomes true if the specular lobe is another one
tinygltf::PbrMetallicRoughness metallicRoughnessOf(const tinygltf::Value& source, bool& specularLost) {
  tinygltf::PbrMetallicRoughness pbr;
  pbr.metallicFactor = 0.0;
  pbr.baseColorTexture = textureOf(source, "diffuseTexture");
  pbr.baseColorFactor = numbersOf(source, "diffuseFactor", {1.0, 1.0, 1.0, 1.0});
  const std::vector<double> specular = numbersOf(source, "specularFactor", {1.0, 1.0, 1.0});
  if (source.Has("specularGlossinessTexture")) {
    specularLost = true;
    return pbr;
  }
  const double glossiness = source.Has("glossinessFactor") ? source.Get("glossinessFactor").GetNumberAsDouble() : 1.0;
  pbr.roughnessFactor = 1.0 - glossiness;
  for (std::size_t c = 0; c < 3; ++c) pbr.baseColorFactor[c] *= 1.0 - *std::ranges::max_element(specular);
  const std::span<const double> diffuse = std::span(pbr.baseColorFactor).first(3);
  const bool black = std::ranges::all_of(diffuse, [](double c) { return c == 0.0; });
  if (black && pbr.baseColorTexture.index < 0) {
    pbr.metallicFactor = 1.0;
    std::ranges::copy(specular, pbr.baseColorFactor.begin());
    return pbr;
  }
  constexpr double kDielectric = 0.04;
  constexpr double kAlike = 0.01;  // Files hold 0.04 as sRGB bytes or with two digits.
  specularLost = std::ranges::any_of(specular, [](double c) { return std::abs(c - kDielectric) > kAlike; });
  return pbr;
}

Material convertMaterial(const tinygltf::Material& source, const std::string& name, const OptionalIndices& textures,
                         Scene& scene, bool& specularLost) {
  const auto specular = source.extensions.find(kSpecularGlossinessExtension);
  const bool metallic = specular == source.extensions.end() || !specular->second.IsObject();
  const tinygltf::PbrMetallicRoughness pbr =
      metallic ? source.pbrMetallicRoughness : metallicRoughnessOf(specular->second, specularLost);
  if (pbr.baseColorFactor.size() != 4) {
    throw SceneError(name + " baseColorFactor: must have four numbers");
  }
  Material material;
  material.name = source.name;
  for (glm::length_t c = 0; c < 3; ++c) {
    material.baseColor[c] =
        unitInterval(pbr.baseColorFactor[static_cast<std::size_t>(c)], name + " baseColorFactor", scene);
  }
  material.baseAlpha = unitInterval(pbr.baseColorFactor[3], name + " baseColorFactor alpha", scene);
  material.metallic = unitInterval(pbr.metallicFactor, name + " metallicFactor", scene);
  material.roughness = unitInterval(pbr.roughnessFactor, name + " roughnessFactor", scene);
  material.doubleSided = source.doubleSided;
  material.normalScale = static_cast<float>(source.normalTexture.scale);
  if (!source.emissiveFactor.empty()) {
    material.emission =
        readColor(source.emissiveFactor, name + " emissiveFactor", scene) * emissiveStrength(source, name);
  }
  const TextureFinder finder(textures, name, material, scene);
  material.baseColorTexture = finder.find(pbr.baseColorTexture, metallic ? "baseColorTexture" : "diffuseTexture");
  material.metallicRoughnessTexture = finder.find(pbr.metallicRoughnessTexture, "metallicRoughnessTexture");
  material.emissiveTexture = finder.find(source.emissiveTexture, "emissiveTexture");
  if (source.emissiveTexture.index >= 0 && !material.emissiveTexture && material.emits()) {
    // The factor alone would make all of the object a lamp.
    scene.warnings.push_back(name + ": its emissive texture is missing; the material does not emit");
    material.emission = glm::vec3(0.0F);
  }
  material.normalTexture = finder.find(source.normalTexture, "normalTexture");
  if (source.alphaMode == "MASK") {
    material.alphaCutoff = static_cast<float>(source.alphaCutoff);
  } else if (source.alphaMode != "OPAQUE") {
    scene.warnings.push_back(name + ": alpha mode " + source.alphaMode + " is not supported; rendered as opaque");
  }
  return material;
}

}  // namespace

OptionalIndices convertTextures(const tinygltf::Model& model, Scene& scene) {
  const OptionalIndices images = convertImages(model, scene);
  OptionalIndices indices;
  for (std::size_t i = 0; i < model.textures.size(); ++i) {
    const tinygltf::Texture& source = model.textures[i];
    indices.emplace_back();
    if (source.source < 0 || static_cast<std::size_t>(source.source) >= images.size()) {
      const std::string name = partName("texture", i, source.name);
      scene.warnings.push_back(source.extensions.empty()
                                   ? name + ": names no image of the file; it is not used"
                                   : name + ": its image needs the extension " + source.extensions.begin()->first +
                                         ", which is not supported; it is not used");
      continue;
    }
    if (!images[static_cast<std::size_t>(source.source)]) {
      continue;
    }
    Texture texture;
    texture.image = *images[static_cast<std::size_t>(source.source)];
    if (source.sampler >= 0 && static_cast<std::size_t>(source.sampler) < model.samplers.size()) {
      const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(source.sampler)];
      texture.wrapU = convertWrap(sampler.wrapS);
      texture.wrapV = convertWrap(sampler.wrapT);
      texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    indices.back() = static_cast<std::uint32_t>(scene.textures.size());
    scene.textures.push_back(texture);
  }
  return indices;
}

void convertMaterials(const tinygltf::Model& model, const OptionalIndices& textures, Scene& scene) {
  std::size_t specularLost = 0;  // Materials whose specular lobe is another one.
  std::string first;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const tinygltf::Material& source = model.materials[i];
    bool lost = false;
    const std::string name = partName("material", i, source.name);
    scene.materials.push_back(convertMaterial(source, name, textures, scene, lost));
    if (!lost) continue;
    ++specularLost;
    if (first.empty()) first = name;
  }
  if (specularLost > 0) {
    scene.warnings.push_back(
        first + (specularLost > 1 ? " and " + std::to_string(specularLost - 1) + " more" : "") +
        ": specular colours and glossiness textures are not read; with --specular they reflect as dielectrics");
  }
  Material byDefault;  // White, rough, and no metal, see `prepareJson`.
  byDefault.name = "default";
  scene.materials.push_back(byDefault);
}

}  // namespace walr::render::gltf
