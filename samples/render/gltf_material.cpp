#include <glm/common.hpp>

#include "samples/render/gltf_accessor.h"
#include "samples/render/gltf_convert.h"
#include "samples/render/image_decode.h"
#include "samples/render/scene_error.h"

namespace walr::render::gltf {
namespace {

constexpr std::uint64_t kTexelBudget = std::uint64_t{1} << 28U;  // 1 GiB of RGBA bytes.

using OptionalIndices = std::vector<std::optional<std::uint32_t>>;

OptionalIndices convertImages(const tinygltf::Model& model, Scene& scene) {
  OptionalIndices indices;
  std::uint64_t budget = kTexelBudget;
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
      Image image = decodeImage(bytes, budget);
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

// Finds the textures of one material, and warns of those that cannot be used.
class TextureFinder {
 public:
  TextureFinder(const OptionalIndices& textures, std::string material, Scene& scene)
      : textures_(textures), material_(std::move(material)), scene_(scene) {}

  template <typename TextureInfo>
  std::optional<std::uint32_t> find(const TextureInfo& info, const std::string& use) const {
    if (info.index < 0) {
      return std::nullopt;
    }
    const std::string what = material_ + " " + use;
    if (static_cast<std::size_t>(info.index) >= textures_.size()) {
      throw SceneError(what + ": there is no texture " + std::to_string(info.index));
    }
    if (info.texCoord != 0) {
      scene_.warnings.push_back(what + ": only TEXCOORD_0 is supported; the texture is not used");
      return std::nullopt;
    }
    if (info.extensions.count("KHR_texture_transform") != 0) {
      scene_.warnings.push_back(what + ": KHR_texture_transform is ignored");
    }
    return textures_[static_cast<std::size_t>(info.index)];
  }

 private:
  const OptionalIndices& textures_;
  std::string material_;
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

Material convertMaterial(const tinygltf::Material& source, const std::string& name, const OptionalIndices& textures,
                         Scene& scene) {
  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
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
  const TextureFinder finder(textures, name, scene);
  material.baseColorTexture = finder.find(pbr.baseColorTexture, "baseColorTexture");
  material.metallicRoughnessTexture = finder.find(pbr.metallicRoughnessTexture, "metallicRoughnessTexture");
  material.emissiveTexture = finder.find(source.emissiveTexture, "emissiveTexture");
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
      scene.warnings.push_back(partName("texture", i, source.name) + ": names no image of the file; it is not used");
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
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const tinygltf::Material& source = model.materials[i];
    scene.materials.push_back(convertMaterial(source, partName("material", i, source.name), textures, scene));
  }
  Material byDefault;
  byDefault.name = "default";
  scene.materials.push_back(byDefault);
}

}  // namespace walr::render::gltf
