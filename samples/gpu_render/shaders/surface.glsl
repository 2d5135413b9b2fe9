// Surfaces as in samples/render/surface.cpp.
struct Hit {
  uint instance;
  uint triangle;
  vec2 barycentric;  // Weights of the triangle's second and third vertex.
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
  return float3At(first, corners.x) * (1.0 - weights.x - weights.y) + float3At(first, corners.y) * weights.x +
         float3At(first, corners.z) * weights.y;
}

vec2 textureCoordinate(MeshData mesh, uvec3 corners, vec2 weights) {
  if (mesh.uvs == kAbsent) return vec2(0.0);
  return float2At(mesh.uvs, corners.x) * (1.0 - weights.x - weights.y) + float2At(mesh.uvs, corners.y) * weights.x +
         float2At(mesh.uvs, corners.z) * weights.y;
}

vec3 unitOr(vec3 v, vec3 fallback) {
  const float size = length(v);
  return size > 0.0 && size <= 3.4e38 ? v / size : fallback;
}

bool isHole(uint meshIndex, uint triangle, vec2 weights) {
  const MeshData mesh = meshes[meshIndex];
  const MaterialData material = materials[mesh.material];
  if ((material.flags & kCutOut) == 0u) return false;
  float alpha = material.baseColor.a;
  if (material.baseColorTexture != kAbsent) {
    const vec2 uv = textureCoordinate(mesh, cornersOf(mesh, triangle), weights);
    alpha *= sampleTexture(material.baseColorTexture, uv, kLinearTable).a;
  }
  return alpha < material.emission.w;
}

vec3 emittedRadiance(MaterialData material, vec2 uv) {
  if (material.emissiveTexture == kAbsent) return material.emission.rgb;
  return material.emission.rgb * sampleTexture(material.emissiveTexture, uv, kSrgbTable).rgb;
}

// Interpolated normal with the normal map applied, on the front side of the triangle.
vec3 mappedNormal(InstanceData instance, MeshData mesh, MaterialData material, uvec3 corners, vec2 weights, vec2 uv,
                  vec3 frontNormal) {
  if (mesh.normals == kAbsent) return frontNormal;
  const float side = (instance.flags & kMirrored) != 0u ? -1.0 : 1.0;
  const mat3 normalFromObject = mat3(instance.normalFromObject);
  const vec3 normal = unitOr(side * (normalFromObject * interpolate3(mesh.normals, corners, weights)), frontNormal);
  if (mesh.tangents == kAbsent) return normal;
  const vec4 tangent = float4At(mesh.tangents, corners.x) * (1.0 - weights.x - weights.y) +
                       float4At(mesh.tangents, corners.y) * weights.x + float4At(mesh.tangents, corners.z) * weights.y;
  const vec3 worldTangent = unitOr(mat3(instance.worldFromObject) * tangent.xyz, vec3(0.0));
  const vec3 bitangent = cross(normal, worldTangent) * (tangent.w < 0.0 ? -side : side);
  const vec3 encoded = sampleTexture(material.normalTexture, uv, kLinearTable).xyz;
  const vec3 local = (encoded * 2.0 - 1.0) * vec3(material.normalScale, material.normalScale, 1.0);
  return unitOr(worldTangent * local.x + bitangent * local.y + normal * local.z, normal);
}

// Bends a normal that points away from the viewer until it is perpendicular to the view direction.
vec3 facing(vec3 normal, vec3 viewDirection, vec3 geometricNormal) {
  const float away = dot(normal, viewDirection);
  return away <= 0.0 ? normal : unitOr(normal - viewDirection * away, geometricNormal);
}

Surface evaluateSurface(Hit hit, vec3 viewDirection) {
  const InstanceData instance = instances[hit.instance];
  const MeshData mesh = meshes[instance.mesh];
  const MaterialData material = materials[mesh.material];
  const uvec3 corners = cornersOf(mesh, hit.triangle);
  const vec2 weights = hit.barycentric;
  vec3 world[3];
  float extent = 0.0;
  for (int i = 0; i < 3; ++i) {
    world[i] = vec3(instance.worldFromObject * vec4(float3At(mesh.positions, corners[i]), 1.0));
    const vec3 size = abs(world[i]);
    extent = max(extent, max(size.x, max(size.y, size.z)));
  }

  Surface surface;
  surface.position = world[0] * (1.0 - weights.x - weights.y) + world[1] * weights.x + world[2] * weights.y;
  surface.previousPosition = surface.position;
  if ((instance.flags & kMoves) != 0u) {
    const vec3 inObject = interpolate3(mesh.positions, corners, weights);
    surface.previousPosition = vec3(instance.previousWorldFromObject * vec4(inObject, 1.0));
  }
  surface.rayOffset = extent / 262144.0;  // See `render::evaluateSurface`.

  const float winding = (instance.flags & kMirrored) != 0u ? -1.0 : 1.0;
  const vec3 frontNormal = winding * unitOr(cross(world[1] - world[0], world[2] - world[0]), -viewDirection);
  const bool front = dot(frontNormal, viewDirection) <= 0.0;
  const vec2 uv = textureCoordinate(mesh, corners, weights);
  const vec3 shading = mappedNormal(instance, mesh, material, corners, weights, uv, frontNormal);
  surface.geometricNormal = front ? frontNormal : -frontNormal;
  surface.shadingNormal = facing(front ? shading : -shading, viewDirection, surface.geometricNormal);
  surface.towardsViewer = -viewDirection;

  vec3 color = material.baseColor.rgb;
  if (material.baseColorTexture != kAbsent) {
    color *= sampleTexture(material.baseColorTexture, uv, kSrgbTable).rgb;
  }
  float metallic = material.metallic;
  surface.roughness = material.roughness;
  if (material.metallicRoughnessTexture != kAbsent) {
    const vec4 texel = sampleTexture(material.metallicRoughnessTexture, uv, kLinearTable);
    surface.roughness *= texel.y;
    metallic *= texel.z;
  }
  surface.albedo = color * (1.0 - metallic);
  const bool emits = (material.flags & kEmits) != 0u && (front || (material.flags & kDoubleSided) != 0u);
  surface.emission = emits ? emittedRadiance(material, uv) : vec3(0.0);
  return surface;
}

// The origin of a ray that leaves a surface on the side of its viewer, offset so that it does not hit the surface itself.
vec3 rayOrigin(Surface surface) { return surface.position + surface.geometricNormal * surface.rayOffset; }
