// Rays by ray queries. Cut-outs are the geometry that is not opaque: rays pass through their holes.
uint instanceOf(uint customIndex, uint geometry) {
  return customIndex == trace.stillPart ? stillInstances[geometry] : customIndex;
}

// Casts a ray. The shader calls it in one place only, because drivers inline the traversal at each.
bool castRay(Ray ray, out Hit hit) {
  rayQueryEXT query;
  rayQueryInitializeEXT(query, scene, ray.onlyBlocks ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT, 0xff, ray.origin,
                        0.0, ray.direction, ray.reach);
  while (rayQueryProceedEXT(query)) {
    const uint instance = instanceOf(uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false)),
                                     uint(rayQueryGetIntersectionGeometryIndexEXT(query, false)));
    if (!isHole(instances[instance].mesh, uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)),
                rayQueryGetIntersectionBarycentricsEXT(query, false))) {
      rayQueryConfirmIntersectionEXT(query);
    }
  }
  if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionTriangleEXT) return false;
  hit.instance = instanceOf(uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true)),
                            uint(rayQueryGetIntersectionGeometryIndexEXT(query, true)));
  hit.triangle = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
  return true;
}
