#include "samples/sequence/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "samples/errors.h"

namespace walr {
namespace {

constexpr std::array kCyclesPlanes = {
    Plane{Role::Indirect, "DiffInd", "RGB"},    Plane{Role::Direct, "DiffDir", "RGB", true},
    Plane{Role::Albedo, "DiffCol", "RGB"},      Plane{Role::Normal, "Normal", "XYZ"},
    Plane{Role::Depth, "Depth", "Z"},           Plane{Role::Motion, "Vector", "XY"},
    Plane{Role::Emission, "Emit", "RGB", true},
};
constexpr std::array kProjectPlanes = {
    Plane{Role::Indirect, "Indirect", "RGB"},
    Plane{Role::Direct, "Direct", "RGB", true},
    Plane{Role::Albedo, "Albedo", "RGB"},
    Plane{Role::Normal, "Normal", "XYZ"},
    Plane{Role::Depth, "Depth", "Z"},
    Plane{Role::Motion, "Motion", "XYZ"},
    Plane{Role::Emission, "Emission", "RGB", true},
};

const Plane& planeOf(const Layout& layout, Role role) {
  return *std::ranges::find(layout.planes, role, &Plane::role);
}

Image& imageOf(Frame& frame, Role role) {
  switch (role) {
    case Role::Indirect:
      return frame.indirect;
    case Role::Direct:
      return frame.direct;
    case Role::Albedo:
      return frame.albedo;
    case Role::Normal:
      return frame.normal;
    case Role::Depth:
      return frame.depth;
    case Role::Motion:
      return frame.motion;
    case Role::Emission:
      return frame.emission;
    case Role::ObjectId:
      break;
  }
  return frame.objectId;
}

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "none" : text;
}

/// Components of the image that a plane is read into. Motion always gets three, even if the file has no z.
int imageComponents(const Plane& plane) {
  return plane.role == Role::Motion ? 3 : static_cast<int>(plane.components.size());
}

void addTargets(std::vector<ExrReader::Target>& targets, const RecognizedLayout& layout, const Plane& plane,
                Image& image, const ExrReader& file) {
  image = Image(file.width(), file.height(), imageComponents(plane));
  for (std::size_t c = 0; c < plane.components.size(); ++c) {
    targets.push_back({layout.channel(plane.name, plane.components[c]), &image, static_cast<int>(c)});
  }
}

/// Whether a reference has no value at a pixel, which is written as NaN in all components.
bool leftOut(std::span<const ExrReader::Target> targets, std::size_t pixel) {
  return std::ranges::all_of(targets, [&](const ExrReader::Target& target) {
    return std::isnan(target.image->pixel(pixel)[static_cast<std::size_t>(target.component)]);
  });
}

void findNonFinite(const std::filesystem::path& path, std::span<const ExrReader::Target> targets, bool mayLeaveOut,
                   std::vector<NonFiniteChannel>& found) {
  for (const ExrReader::Target& target : targets) {
    const Image& image = *target.image;
    NonFiniteChannel channel{path, target.channel};
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
      if (std::isfinite(image.pixel(i)[static_cast<std::size_t>(target.component)]) ||
          (mayLeaveOut && leftOut(targets, i))) {
        continue;
      }
      if (channel.count++ == 0) {
        channel.firstX = static_cast<int>(i % static_cast<std::size_t>(image.width()));
        channel.firstY = static_cast<int>(i / static_cast<std::size_t>(image.width()));
      }
    }
    if (channel.count > 0) {
      found.push_back(std::move(channel));
    }
  }
}

/// View layers that hold a channel of a plane: the prefixes of the channel names without their dot.
std::set<std::string> viewLayersWith(std::span<const std::string> channels, const Plane& plane) {
  std::set<std::string> layers;
  for (const char component : plane.components) {
    const std::string wanted = std::string(plane.name) + "." + component;
    for (const std::string& channel : channels) {
      if (channel == wanted) {
        layers.emplace();
      } else if (channel.ends_with("." + wanted)) {
        layers.insert(channel.substr(0, channel.size() - wanted.size() - 1));
      }
    }
  }
  return layers;
}

/// Whether a file has a plane, or some components of it.
bool hasPlane(const ExrReader& file, const RecognizedLayout& layout, const Plane& plane) {
  const std::vector<std::string> present = file.channels();
  return std::ranges::any_of(plane.components, [&](char component) {
    return std::ranges::find(present, layout.channel(plane.name, component)) != present.end();
  });
}

void requirePlanes(const ExrReader& file, const RecognizedLayout& layout, std::span<const Plane* const> planes,
                   const std::string& wayOut) {
  const std::vector<std::string> present = file.channels();
  std::vector<std::string> missing;
  for (const Plane* plane : planes) {
    for (const char component : plane->components) {
      const std::string name = layout.channel(plane->name, component);
      if (std::ranges::find(present, name) == present.end()) {
        missing.push_back(name);
      }
    }
  }
  if (!missing.empty()) {
    throw InputError(file.path().string() + ": missing channel" + (missing.size() > 1 ? "s " : " ") + join(missing) +
                     " (layout: " + std::string(layout.layout->name) + "). " + wayOut);
  }
}

}  // namespace

const Layout& cyclesLayout() {
  // Blender's vectors point to the previous position with y up, and its normals are in world space. Its emission pass
  // holds only surfaces; the sky is in the pass "Env".
  static const Layout layout{"Blender Cycles multi-layer",
                             kCyclesPlanes,
                             CameraSource::JsonFile,
                             InputConventions{.normal = InputConventions::Space::World,
                                              .motionDepth = InputConventions::MotionDepth::StaticScene},
                             glm::vec2(1.0F, -1.0F),
                             {Role::ObjectId, "IndexOB", "X"},
                             "Env"};
  return layout;
}

const Layout& projectLayout() {
  static const Layout layout{"walr",
                             kProjectPlanes,
                             CameraSource::HeaderAttributes,
                             InputConventions{},
                             glm::vec2(1.0F, 1.0F),
                             {Role::ObjectId, "ObjectId", "Y"}};
  return layout;
}

Layout withMotionDepth(const Layout& layout, InputConventions::MotionDepth source, const std::filesystem::path& file) {
  if (source == InputConventions::MotionDepth::Given && planeOf(layout, Role::Motion).components.size() < 3) {
    throw InputError(file.string() + ": the change of depth is not given: the motion of layout '" +
                     std::string(layout.name) +
                     "' has no third component; it can be found, or computed for a still scene");
  }
  Layout changed = layout;
  changed.conventions.motionDepth = source;
  return changed;
}

std::string RecognizedLayout::channel(std::string_view plane, char component) const {
  return (viewLayer.empty() ? "" : viewLayer + ".") + std::string(plane) + "." + component;
}

RecognizedLayout recognizeLayout(const ExrReader& file, std::string_view viewLayer) {
  const std::vector<std::string> channels = file.channels();
  for (const Layout* layout : {&cyclesLayout(), &projectLayout()}) {
    std::set<std::string> layers = viewLayersWith(channels, planeOf(*layout, Role::Indirect));
    if (layers.empty()) {
      // A file without light channels is recognised by its albedo, so that the error can name the missing channels.
      layers = viewLayersWith(channels, planeOf(*layout, Role::Albedo));
    }
    if (layers.empty()) {
      continue;
    }
    if (!viewLayer.empty() && !layers.contains(std::string(viewLayer))) {
      throw InputError(file.path().string() + ": no view layer '" + std::string(viewLayer) +
                       "'; the file has: " + join({layers.begin(), layers.end()}));
    }
    if (viewLayer.empty() && layers.size() > 1) {
      throw InputError(file.path().string() + ": several view layers (" + join({layers.begin(), layers.end()}) +
                       "); choose one with --view-layer NAME");
    }
    RecognizedLayout recognized{layout, viewLayer.empty() ? *layers.begin() : std::string(viewLayer)};
    recognized.objectIds = hasPlane(file, recognized, layout->objectId);
    return recognized;
  }
  throw InputError(file.path().string() +
                   ": neither a Blender Cycles frame (channels DiffInd.R, ...) nor a frame in walr's own layout "
                   "(Indirect.R, ...). Channels found: " +
                   join(channels));
}

void requireChannels(const ExrReader& file, const RecognizedLayout& layout, bool composite) {
  std::vector<const Plane*> planes;
  for (const Plane& plane : layout.layout->planes) {
    if (composite || !plane.compositeOnly) {
      planes.push_back(&plane);
    }
  }
  if (layout.objectIds) {
    planes.push_back(&layout.layout->objectId);
  }
  requirePlanes(file, layout, planes,
                composite ? "Render with these passes, or leave out --composite if only direct light or emission is "
                            "missing."
                          : "Render with these passes.");
}

void requireReferenceChannels(const ExrReader& file, const RecognizedLayout& layout) {
  const Plane* const plane = &planeOf(*layout.layout, Role::Indirect);
  requirePlanes(file, layout, std::span(&plane, 1),
                "A file whose name starts with 'ref' is a reference; rename it if it is not.");
}

void readFrame(ExrReader& file, const RecognizedLayout& layout, bool composite, Frame& frame) {
  file.requireBlocks();
  std::vector<ExrReader::Target> targets;
  for (const Plane& plane : layout.layout->planes) {
    if (composite || !plane.compositeOnly) {
      addTargets(targets, layout, plane, imageOf(frame, plane.role), file);
    }
  }
  if (layout.objectIds) {
    addTargets(targets, layout, layout.layout->objectId, frame.objectId, file);
  }
  Image sky;
  const Plane skyPlane{Role::Emission, layout.layout->sky, "RGB", true};
  if (composite && hasPlane(file, layout, skyPlane)) {
    addTargets(targets, layout, skyPlane, sky, file);
  }
  file.read(targets);
  findNonFinite(file.path(), targets, false, frame.nonFinite);
  for (std::size_t i = 0; i < sky.values().size(); ++i) {
    frame.emission.values()[i] += sky.values()[i];
  }
}

Reference readReference(ExrReader& file, const RecognizedLayout& layout, bool composite,
                        std::vector<NonFiniteChannel>& nonFinite) {
  file.requireBlocks();
  Reference reference;
  std::vector<ExrReader::Target> targets;
  addTargets(targets, layout, planeOf(*layout.layout, Role::Indirect), reference.indirect, file);
  const Plane& direct = planeOf(*layout.layout, Role::Direct);
  if (composite && hasPlane(file, layout, direct)) {
    addTargets(targets, layout, direct, reference.direct, file);
  }
  const std::size_t checked = targets.size();
  Plane half = planeOf(*layout.layout, Role::Indirect);
  const std::string halfName = std::string(half.name) + "A";
  half.name = halfName;
  if (hasPlane(file, layout, half)) addTargets(targets, layout, half, reference.indirectHalf, file);
  file.read(targets);
  findNonFinite(file.path(), std::span(targets).first(checked), true, nonFinite);
  return reference;
}

}  // namespace walr
