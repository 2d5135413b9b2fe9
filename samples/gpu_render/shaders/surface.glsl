// Surfaces as in samples/render/surface.cpp.
#include "samples/render/exact/specular.h"

const float kEndless = 3.4e38;

struct Ray {
  vec3 origin;
  vec3 direction;
  float reach;      // In units of the length of `direction`.
  bool onlyBlocks;  // Any hit ends the ray; which one it is does not matter.
};

struct Hit {
  uint instance;
  uint triangle;
};

struct Surface {
  vec3 position;
  vec3 previousPosition;
  vec3 geometricNormal;  // Of the triangle, unit, towards the viewer.
  vec3 shadingNormal;
  vec3 albedo;
  float roughness;
  vec3 towardsViewer;
  vec3 emission;
  float rayOffset;
#ifdef SPECULAR
  float metallic;
  vec3 reflectance;  // Of the specular lobe at normal incidence.
  // How the surface reflects as a path's vertex, see `Reflector` in samples/render/path_tracer.cpp.
  vec3 diffuse;
  float share;
#endif
};

vec3 float3At(uint first, uint index) {
  const uint at = first + 3u * index;
  return vec3(floats[at], floats[at + 1u], floats[at + 2u]);
}
vec2 float2At(uint first, uint index) {
  const uint at = first + 2u * index;
  return vec2(floats[at], floats[at + 1u]);
}
vec4 float4At(uint first, uint index) {
  const uint at = first + 4u * index;
  return vec4(floats[at], floats[at + 1u], floats[at + 2u], floats[at + 3u]);
}

uvec3 cornersOf(MeshData mesh, uint triangle) {
  const uint at = mesh.triangles + 3u * triangle;
  return uvec3(indices[at], indices[at + 1u], indices[at + 2u]);
}

vec3 interpolate3(uint first, uvec3 corners, vec2 weights) {
  return interpolate(float3At(first, corners.x), float3At(first, corners.y), float3At(first, corners.z), weights);
}

vec4 interpolate4(uint first, uvec3 corners, vec2 weights) {
  return interpolate(float4At(first, corners.x), float4At(first, corners.y), float4At(first, corners.z), weights);
}

vec4 vertexColor(MeshData mesh, uvec3 corners, vec2 weights) {
  return mesh.colors == kAbsent ? vec4(1.0) : interpolate4(mesh.colors, corners, weights);
}

vec4 sampleOnMesh(uint index, uint color, MeshData mesh, uvec3 corners, vec2 weights) {
  vec2 uv = vec2(0.0);
  if (mesh.uvs != kAbsent) {
    const uvec3 at = corners + (textures[index].sampling >> kCoordinatesShift) * mesh.vertices;
    uv = interpolate(float2At(mesh.uvs, at.x), float2At(mesh.uvs, at.y), float2At(mesh.uvs, at.z), weights);
  }
  return sampleTexture(index, uv, color);
}

bool isHole(uint meshIndex, uint triangle, vec2 weights) {
  const MeshData mesh = meshes[meshIndex];
  const MaterialData material = materials[mesh.material];
  if ((material.flags & kCutOut) == 0u) return false;
  const uvec3 corners = cornersOf(mesh, triangle);
  float alpha = material.baseColor.a * vertexColor(mesh, corners, weights).a;
  if (material.baseColorTexture != kAbsent) {
    alpha *= sampleOnMesh(material.baseColorTexture, kLinearTable, mesh, corners, weights).a;
  }
  return alpha < material.emission.w;
}

vec3 emittedRadiance(MaterialData material, MeshData mesh, uvec3 corners, vec2 weights) {
  if (material.emissiveTexture == kAbsent) return material.emission.rgb;
  return material.emission.rgb * sampleOnMesh(material.emissiveTexture, kSrgbTable, mesh, corners, weights).rgb;
}

// Interpolated normal with the normal map applied, on the front side of the triangle.
vec3 mappedNormal(InstanceData instance, MeshData mesh, MaterialData material, uvec3 corners, vec2 weights, vec3 front) {
  if (mesh.normals == kAbsent) return front;
  const float side = (instance.flags & kMirrored) != 0u ? -1.0 : 1.0;
  const vec3 inObject = interpolate3(mesh.normals, corners, weights);
  const vec3 normal = unitOr(side * transformDirection(mat3(instance.normalFromObject), inObject), front);
  if (mesh.tangents == kAbsent) return normal;
  const vec4 tangent = interpolate4(mesh.tangents, corners, weights);
  const vec3 worldTangent = unitOr(transformDirection(mat3(instance.worldFromObject), tangent.xyz), vec3(0.0));
  const vec3 encoded = sampleOnMesh(material.normalTexture, kLinearTable, mesh, corners, weights).xyz;
  return mapNormal(normal, worldTangent, tangent.w < 0.0 ? -side : side, encoded, material.normalScale);
}

Surface evaluateSurface(Hit hit, Ray ray) {
  const InstanceData instance = instances[hit.instance];
  const MeshData mesh = meshes[instance.mesh];
  const MaterialData material = materials[mesh.material];
  const uvec3 corners = cornersOf(mesh, hit.triangle);
  vec3 world[3];
  float extent = 0.0;
  for (int i = 0; i < 3; ++i) {
    world[i] = transformPoint(instance.worldFromObject, float3At(mesh.positions, corners[i]));
    const vec3 size = abs(world[i]);
    extent = max(extent, max(size.x, max(size.y, size.z)));
  }

  Surface surface;
  const vec2 weights = weightsOfHit(ray.origin, ray.direction, world[0], world[1], world[2]);
  surface.position = interpolate(world[0], world[1], world[2], weights);
  surface.previousPosition = surface.position;
  if ((instance.flags & kDisplaced) != 0u) {
    const vec3 inObject = interpolate3(mesh.positions, corners, weights);
    surface.previousPosition = vec3(instance.previousWorldFromObject * vec4(inObject, 1.0));
  }
  surface.rayOffset = extent / 262144.0;  // See `render::evaluateSurface`.

  const float winding = (instance.flags & kMirrored) != 0u ? -1.0 : 1.0;
  const vec3 ofFront = frontNormal(world[0], world[1], world[2], winding, -ray.direction);
  const bool front = exactDot(ofFront, ray.direction) <= 0.0;
  const vec3 shading = mappedNormal(instance, mesh, material, corners, weights, ofFront);
  surface.geometricNormal = front ? ofFront : -ofFront;
  surface.shadingNormal = facing(front ? shading : -shading, ray.direction, surface.geometricNormal);
  surface.towardsViewer = -ray.direction;

  vec3 color = material.baseColor.rgb * vertexColor(mesh, corners, weights).rgb;
  if (material.baseColorTexture != kAbsent) {
    color *= sampleOnMesh(material.baseColorTexture, kSrgbTable, mesh, corners, weights).rgb;
  }
  float metallic = material.metallic;
  surface.roughness = material.roughness;
  if (material.metallicRoughnessTexture != kAbsent) {
    const vec4 texel = sampleOnMesh(material.metallicRoughnessTexture, kLinearTable, mesh, corners, weights);
    surface.roughness *= texel.y;
    metallic *= texel.z;
  }
  surface.albedo = color * (1.0 - metallic);
#ifdef SPECULAR
  surface.metallic = metallic;
  surface.reflectance = reflectanceOf(color, metallic);
#endif
  const bool emits = (material.flags & kEmits) != 0u && (front || (material.flags & kDoubleSided) != 0u);
  surface.emission = emits ? emittedRadiance(material, mesh, corners, weights) : vec3(0.0);
  return surface;
}

// The origin of a ray that leaves a surface on the side of its viewer, offset so that it does not hit the surface itself.
vec3 rayOrigin(Surface surface) { return offsetAlong(surface.position, surface.geometricNormal, surface.rayOffset); }
