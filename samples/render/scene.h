#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x2.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "samples/render/texture.h"

/// The scene that the path tracer renders: the checked contents of a glTF file in plain structures. World space is that
/// of glTF: right-handed, +Y up, metres.
namespace walr::render {

/// The shape of the diffuse lobe.
enum class DiffuseModel : std::uint8_t {
  Lambert,  ///< The same radiance in all directions.
  /// The diffuse lobe of Disney's principled model (Burley 2015, 5.3), which Blender's Principled BSDF uses. At grazing
  /// angles it is darker, or brighter for rough surfaces.
  Disney,
};

/// Texture coordinates that a mesh holds for its material.
struct TextureCoordinates {
  int set = 0;                  ///< n of the attribute TEXCOORD_n.
  glm::mat3x2 transform{1.0F};  ///< Of (u, v, 1) in the file (KHR_texture_transform).

  bool operator==(const TextureCoordinates&) const = default;
};

/// A material of glTF's metallic-roughness model. At metallic 1 it has no diffuse lobe. The specular lobe is optional,
/// see `Scene::specular`.
struct Material {
  std::string name;
  glm::vec3 baseColor{1.0F};                              ///< Linear, 0..1.
  float baseAlpha = 1.0F;                                 ///< 0..1; used only with an `alphaCutoff`.
  float metallic = 0.0F;                                  ///< 0..1; the diffuse albedo is base colour * (1 - metallic).
  glm::vec3 emission{0.0F};                               ///< Radiance: emissive factor * emissive strength.
  float roughness = 1.0F;                                 ///< 0..1; of `DiffuseModel::Disney` and the specular lobe.
  float normalScale = 1.0F;                               ///< Multiplies x and y of the normal map.
  bool doubleSided = false;                               ///< Emits from both sides; reflection is always two-sided.
  std::optional<float> alphaCutoff;                       ///< Cut-out: alpha below is a hole (glTF alpha mode MASK).
  std::optional<std::uint32_t> baseColorTexture;          ///< Indices into `Scene::textures`.
  std::optional<std::uint32_t> metallicRoughnessTexture;  ///< Metallic in blue, roughness in green.
  std::optional<std::uint32_t> emissiveTexture;
  std::optional<std::uint32_t> normalTexture;
  std::vector<TextureCoordinates> coordinates;  ///< Of all its textures; at most one for each.

  [[nodiscard]] bool emits() const { return emission.x > 0.0F || emission.y > 0.0F || emission.z > 0.0F; }
};

/// Triangles of one material, in object space (one glTF mesh primitive).
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;   ///< Finite.
  std::vector<glm::vec3> normals;     ///< Unit, one per position; empty for flat shading.
  std::vector<glm::vec4> colors;      ///< Multiply base colour and alpha, 0..1, one per position; empty if all are 1.
  std::vector<glm::vec2> uvs;         ///< For each of `Material::coordinates` one per position; empty: all are 0.
  std::vector<glm::vec4> tangents;    ///< xyz unit, w = handedness; empty unless the material has a normal map.
  std::vector<glm::uvec3> triangles;  ///< Indices into `positions`, counter-clockwise seen from the front.
  std::uint32_t material = 0;
};

/// An equirectangular image of the sky; its middle lies along -Z, its top along +Y, its right half along +X.
struct SkyMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::vec3> radiance;  ///< Linear RGB, rows from the top; finite, not negative.
};

/// A light without extent (KHR_lights_punctual) at the origin of its node; it shines along the node's -Z.
struct PunctualLight {
  enum class Kind : std::uint8_t { Directional, Point, Spot };
  Kind kind = Kind::Point;
  /// Linear RGB. Directional: irradiance on a plane facing the light. Point and spot: radiant intensity.
  glm::vec3 intensity{1.0F};
  float cosInnerCone = 1.0F;  ///< Spot: full intensity within this cone.
  float cosOuterCone = 0.0F;  ///< Spot: no light outside this cone.
};

/// A pinhole camera at the origin of its node; it looks along the node's -Z.
struct Camera {
  std::string name;
  float yfov = 0.8F;   ///< Radians, 0..pi.
  float znear = 0.1F;  ///< Scene units; used for the projection matrix only, nothing is clipped.
  float zfar = 1000.0F;
};

/// Translation, rotation and scale of a node, applied in the order scale, rotation, translation.
struct Transform {
  glm::vec3 translation{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 scale{1.0F};
};

/// One node of the hierarchy.
struct Node {
  std::string name;
  std::optional<std::uint32_t> parent;  ///< Index into `Scene::nodes`, smaller than the node's own.
  Transform transform;
  std::optional<glm::mat4> matrix;  ///< Replaces `transform` if the file gives a matrix.
  std::vector<std::uint32_t> meshes;
  std::optional<std::uint32_t> light;
  std::optional<std::uint32_t> camera;
};

/// How one property of one node changes over time.
struct AnimationChannel {
  enum class Path : std::uint8_t { Translation, Rotation, Scale };
  enum class Interpolation : std::uint8_t { Linear, Step };
  std::uint32_t node = 0;
  Path path = Path::Translation;
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> times;       ///< Seconds, strictly increasing, at least one.
  std::vector<glm::vec4> values;  ///< One per time: xyz, or a unit quaternion xyzw.
};

/// The contents of a file that can be rendered.
struct Scene {
  std::vector<Image> images;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<PunctualLight> lights;
  std::vector<Camera> cameras;
  std::vector<Node> nodes;  ///< Parents before children.
  std::vector<AnimationChannel> animation;
  DiffuseModel diffuseModel = DiffuseModel::Lambert;
  /// Materials have the specular lobe of glTF's appendix B, which takes its share of light from the diffuse lobe.
  bool specular = false;
  glm::vec3 skyRadiance{0.0F};  ///< Constant, linear RGB; used without a map.
  std::optional<SkyMap> skyMap;
  std::vector<std::string> warnings;  ///< Features of the file that are not supported, and values that were replaced.
};

}  // namespace walr::render
