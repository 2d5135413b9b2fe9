#pragma once

#include <string>

#include "framegraph/declare/graph.h"
#include "samples/host/tracer.h"
#include "samples/image/half.h"
#include "samples/image/image.h"

namespace walr::host {

inline constexpr fg::Extent kExtent{72, 40};

/// A small picture of one of the project's scenes.
inline Tracer::Options tracing(const std::string& scene = "box.gltf") {
  Tracer::Options options;
  options.scene = std::string(WALR_SCENES "/") + scene;
  options.extent = kExtent;
  options.denoiseDirect = false;  // So that the composite has both lights.
  return options;
}

/// As textures of halves hold it.
inline Image inHalves(Image image) {
  for (float& value : image.values()) value = toHalf(value);
  return image;
}

}  // namespace walr::host
