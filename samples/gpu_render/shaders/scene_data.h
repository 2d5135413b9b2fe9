// What the path tracer on the GPU reads: the scene of samples/render/ in buffers, and the constants of a frame.
#ifndef WALR_GPU_RENDER_SCENE_DATA_H
#define WALR_GPU_RENDER_SCENE_DATA_H
#include "shaders/common/types.h"
#ifdef __cplusplus
#define WALR_CONSTANT inline constexpr
namespace walr::gpu_render {
#else
#define WALR_CONSTANT const
#endif

WALR_CONSTANT uint kAbsent = 0xffffffffu;  // An index or offset of something that is not there.

// `MeshData`: positions, normals and so on of a mesh, as offsets into the buffer of floats, and its material.
struct MeshData {
  uint positions;  // 3 floats each.
  uint normals;    // 3 floats each; `kAbsent` for flat shading.
  uint uvs;        // 2 floats each, `vertices` for each set of coordinates; `kAbsent` if no texture needs them.
  uint tangents;   // 4 floats each; `kAbsent` without a normal map.
  uint triangles;  // Offset into the buffer of indices, 3 for a triangle.
  uint material;
  uint colors;    // 4 floats each; `kAbsent` if all are 1.
  uint vertices;  // Their number.
};

// `MaterialData::flags`
WALR_CONSTANT uint kDoubleSided = 1u;
WALR_CONSTANT uint kCutOut = 2u;
WALR_CONSTANT uint kEmits = 4u;

// See `render::Material`.
struct MaterialData {
  vec4 baseColor;  // w: `baseAlpha`.
  vec4 emission;   // w: `alphaCutoff`, for cut-outs.
  float metallic;
  float roughness;
  float normalScale;
  uint flags;
  uint baseColorTexture;  // Indices of textures, or `kAbsent`.
  uint metallicRoughnessTexture;
  uint emissiveTexture;
  uint normalTexture;
};

// `TextureData::sampling`: wrapU in bits 0 and 1, wrapV in bits 2 and 3, each a value of `render::Wrap`; in the bits
// from `kCoordinatesShift` on, `render::Texture::coordinates`.
WALR_CONSTANT uint kWrapBits = 3u;
WALR_CONSTANT uint kNearest = 16u;
WALR_CONSTANT uint kCoordinatesShift = 5u;

// See `render::Texture`.
struct TextureData {
  uint texels;  // Offset of the image into the buffer of texels, each RGBA8 with red in the lowest byte.
  uint width;
  uint height;
  uint sampling;
};

// `InstanceData::flags`
WALR_CONSTANT uint kDisplaced = 1u;  // See `render::isDisplaced`.
WALR_CONSTANT uint kMirrored = 2u;

// See `render::Instance`.
struct InstanceData {
  mat4 worldFromObject;
  mat4 previousWorldFromObject;
  mat4 normalFromObject;  // Its upper left 3 x 3 elements.
  uint mesh;
  uint firstEmitter;  // Index of the emitter of the mesh's first triangle; `kAbsent` if the mesh does not emit.
  uint flags;
  uint padding;
};

// Values of `PunctualLightData::position.w`
WALR_CONSTANT float kDirectionalLight = 0.0f;
WALR_CONSTANT float kPointLight = 1.0f;
WALR_CONSTANT float kSpotLight = 2.0f;

// See `render::PlacedLight`.
struct PunctualLightData {
  vec4 position;   // w: kind.
  vec4 axis;       // w: `cosInnerCone`.
  vec4 intensity;  // w: `cosOuterCone`.
};

// An emissive triangle; see `render::Emitter`.
struct EmitterData {
  vec4 corner0;  // World space; w: area.
  vec4 corner1;  // w: probability.
  vec4 corner2;
  uint instance;
  uint triangle;
  uint cumulative;  // Sum of the probabilities of this emitter and all before it, times 2^24, rounded up.
  uint padding;
};

// Values of `TraceConstants::sequence`, in the order of `render::Sampler::Kind`.
WALR_CONSTANT uint kSobol = 0u;
WALR_CONSTANT uint kBlueNoise = 1u;
WALR_CONSTANT uint kIndependent = 2u;

// `TraceConstants::flags`
WALR_CONSTANT uint kDisneyDiffuse = 1u;     // Diffuse lobe of Disney's model instead of Lambert's.
WALR_CONSTANT uint kSkySampled = 2u;        // The sky map is not black, see `render::Sky::isSampled`.
WALR_CONSTANT uint kWholePixel = 4u;        // See `render::ReferenceCoverage::wholePixel`.
WALR_CONSTANT uint kDirectInIndirect = 8u;  // Add the direct light to the indirect light, and leave none.
WALR_CONSTANT uint kBehindMirrors = 16u;    // See `render::GBufferMode::BehindMirrors`; only with specular light.

// The uniform block of a frame.
struct TraceConstants {
  mat4 viewFromWorld;
  mat4 worldFromView;
  mat4 previousViewFromWorld;
  mat4 projection;   // OpenGL clip space, without jitter.
  vec4 skyRadiance;  // Constant; used without a map.
  vec2 jitter;
  vec2 previousJitter;
  uvec2 size;        // Pixels.
  uvec2 lightGroup;  // `LightPattern::columns` and `rows`.
  ivec2 lightOffset;
  uvec2 skySize;  // Texels of the sky map; 0 without one.
  uint sequence;  // Kind of random numbers.
  uint seed;
  uint firstSample;
  uint samples;
  uint bounces;
  uint punctualLights;  // Their number.
  uint emitters;        // Their number.
  uint
      stillPart;  // Custom index of the instance with all still objects; its geometries are listed in `stillInstances`.
  uint oneSquareIn;  // See `render::ReferenceCoverage::oneSquareIn`.
  uint squareShift;
  uint flags;
  uint padding;
};

#ifdef __cplusplus
static_assert(sizeof(MeshData) == 32 && sizeof(MaterialData) == 64 && sizeof(TextureData) == 16);
static_assert(sizeof(InstanceData) == 208 && sizeof(PunctualLightData) == 48 && sizeof(EmitterData) == 64);
static_assert(sizeof(TraceConstants) == 4 * 64 + 16 + 6 * 8 + 12 * 4);
}  // namespace walr::gpu_render
#endif
#undef WALR_CONSTANT
#endif
