#include "samples/sequence/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "passes/settings/text.h"
#include "samples/errors.h"
#include "samples/sequence/channel_map.h"

namespace walr {
namespace {

constexpr std::array kCyclesPlanes = {
    Plane{Role::Indirect, "DiffInd", "RGB"}, Plane{Role::Direct, "DiffDir", "RGB"},
    Plane{Role::Albedo, "DiffCol", "RGB"},   Plane{Role::Normal, "Normal", "XYZ"},
    Plane{Role::Depth, "Depth", "Z"},        Plane{Role::Motion, "Vector", "XY"},
    Plane{Role::Emission, "Emit", "RGB"},
};
constexpr std::array kCyclesPlanes5 = {
    Plane{Role::Indirect, "Diffuse Indirect", "RGB"},
    Plane{Role::Direct, "Diffuse Direct", "RGB"},
    Plane{Role::Albedo, "Diffuse Color", "RGB"},
    Plane{Role::Normal, "Normal", "XYZ"},
    Plane{Role::Depth, "Depth", "Z"},
    Plane{Role::Motion, "Vector", "XY"},
    Plane{Role::Emission, "Emission", "RGB"},
};
constexpr std::array kProjectPlanes = {
    Plane{Role::Indirect, "Indirect", "RGB"}, Plane{Role::Direct, "Direct", "RGB"},
    Plane{Role::Albedo, "Albedo", "RGB"},     Plane{Role::Normal, "Normal", "XYZ"},
    Plane{Role::Depth, "Depth", "Z"},         Plane{Role::Motion, "Motion", "XYZ"},
    Plane{Role::Emission, "Emission", "RGB"},
};
constexpr std::array kProjectSpecular = {
    Plane{Role::Specular, "Specular", "RGB"},
    Plane{Role::SpecularDistance, "SpecularDistance", "Z"},
    Plane{Role::Roughness, "Roughness", "Y"},
    Plane{Role::SpecularAlbedo, "SpecularAlbedo", "RGB"},
    Plane{Role::SpecularMotion, "SpecularMotion", "XYZ", true},
};
// Cycles has no pass of the distance, and one of roughness only if the scene's materials write it.
constexpr std::array kCyclesSpecular = {
    Plane{Role::Specular, "GlossDir", "RGB"},
    Plane{Role::Specular, "GlossInd", "RGB"},
    Plane{Role::SpecularAlbedo, "GlossCol", "RGB"},
    Plane{Role::Roughness, "Roughness", "X", true},
};
constexpr std::array kCyclesSpecular5 = {
    Plane{Role::Specular, "Glossy Direct", "RGB"},
    Plane{Role::Specular, "Glossy Indirect", "RGB"},
    Plane{Role::SpecularAlbedo, "Glossy Color", "RGB"},
    Plane{Role::Roughness, "Roughness", "X", true},
};
constexpr std::array kSpecularFile = {
    Plane{Role::SpecularDistance, "GlossDir", "RG"},
    Plane{Role::Roughness, "Emit", "RG"},
};
constexpr std::array kSpecularFile5 = {
    Plane{Role::SpecularDistance, "Glossy Direct", "RG"},
    Plane{Role::Roughness, "Emission", "RG"},
};
constexpr std::array kProjectAdded = {AddedLight{&Frame::nonDiffuse, "Specular", "SpecularAlbedo", false}};
// The emission pass of Blender holds only surfaces; the sky has a pass of its own.
constexpr std::array kCyclesAdded = {
    AddedLight{&Frame::emission, "Env"},
    AddedLight{&Frame::nonDiffuse, "GlossDir", "GlossCol"},
    AddedLight{&Frame::nonDiffuse, "GlossInd", "GlossCol"},
    AddedLight{&Frame::nonDiffuse, "TransDir", "TransCol"},
    AddedLight{&Frame::nonDiffuse, "TransInd", "TransCol"},
    AddedLight{&Frame::nonDiffuse, "VolumeDir"},
    AddedLight{&Frame::nonDiffuse, "VolumeInd"},
};
constexpr std::array kCyclesAdded5 = {
    AddedLight{&Frame::emission, "Environment"},
    AddedLight{&Frame::nonDiffuse, "Glossy Direct", "Glossy Color"},
    AddedLight{&Frame::nonDiffuse, "Glossy Indirect", "Glossy Color"},
    AddedLight{&Frame::nonDiffuse, "Transmission Direct", "Transmission Color"},
    AddedLight{&Frame::nonDiffuse, "Transmission Indirect", "Transmission Color"},
    AddedLight{&Frame::nonDiffuse, "Volume Direct"},
    AddedLight{&Frame::nonDiffuse, "Volume Indirect"},
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
    case Role::Specular:
      return frame.specular;
    case Role::SpecularDistance:
      return frame.specularDistance;
    case Role::Roughness:
      return frame.roughness;
    case Role::SpecularAlbedo:
      return frame.specularAlbedo;
    case Role::SpecularMotion:
      return frame.specularMotion;
    case Role::ObjectId:
      break;
  }
  return frame.objectId;
}

/// Of diffuse light.
Role roleOf(Light light) {
  return light == Light::Indirect ? Role::Indirect : Role::Direct;
}

/// Whether a plane of a layout is needed.
bool isWanted(const Plane& plane, const LightWish& wanted) {
  switch (plane.role) {
    case Role::Indirect:
      return wanted.indirect;
    case Role::Direct:
      return wanted.direct;
    case Role::Emission:
      return wanted.rest;
    default:
      return true;
  }
}

/// A plane of three colours that has no role.
Plane colours(std::string_view name) {
  return {Role::Emission, name, "RGB"};
}

/// Components of the image that a plane is read into. Motion always gets three, even if the file has no z.
int imageComponents(const Plane& plane) {
  return plane.role == Role::Motion ? 3 : static_cast<int>(plane.components.size());
}

/// Add a light, multiplied by its colour, to an image, which may be empty.
void addLight(const AddedLight& light, const std::map<std::string_view, Image>& planes, Image& image) {
  const Image& radiance = planes.at(light.name);
  const Image* const colour = light.colour.empty() ? nullptr : &planes.at(light.colour);
  if (image.empty()) image = Image(radiance.width(), radiance.height(), 3);
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const float added = radiance.values()[i] * (colour != nullptr ? colour->values()[i] : 1.0F);
    // What is not finite must not hide the other lights.
    if (std::isfinite(added)) image.values()[i] += added;
  }
}

/// The lights that a composite adds as they are.
std::vector<AddedLight> addedBeside(const RecognizedLayout& layout, SpecularWish specular) {
  std::vector<AddedLight> added;
  std::ranges::copy_if(layout.added, std::back_inserter(added), [&](const AddedLight& light) {
    return specular != SpecularWish::Denoised ||
           std::ranges::find(layout.specular, light.name, &Plane::name) == layout.specular.end();
  });
  return added;
}

/// Add a part of a sum, which may be empty.
void addPart(const Image& part, Image& sum) {
  if (sum.empty()) {
    sum = part;
  } else {
    std::ranges::transform(sum.values(), part.values(), sum.values().begin(), std::plus<>());
  }
}

/// What a plane holds at pixels outside of the data window, where nothing is visible.
float valueOutside(Role role) {
  if (role == Role::Depth) return kBackgroundDepth;
  return role == Role::ObjectId ? -1.0F : 0.0F;
}

/// @param outside  value of pixels that the file lacks
void addTargets(std::vector<ExrReader::Target>& targets, const RecognizedLayout& layout, const Plane& plane,
                Image& image, const PixelRect& place, float outside) {
  image = Image(place.size.x, place.size.y, imageComponents(plane));
  if (outside != 0.0F) std::ranges::fill(image.values(), outside);
  for (std::size_t c = 0; c < plane.components.size(); ++c) {
    targets.push_back({layout.channel(plane.name, plane.components[c]), &image, static_cast<int>(c)});
  }
}

/// Whether an image of a reference has no value at a pixel, which is written as NaN in all components.
bool leftOut(const Image& image, std::size_t pixel) {
  return std::ranges::all_of(image.pixel(pixel), [](float value) { return std::isnan(value); });
}

void findNonFinite(const std::filesystem::path& path, std::span<const ExrReader::Target> targets, bool mayLeaveOut,
                   std::vector<NonFiniteChannel>& found) {
  for (const ExrReader::Target& target : targets) {
    const Image& image = *target.image;
    NonFiniteChannel channel{path, target.channel};
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
      if (std::isfinite(image.pixel(i)[static_cast<std::size_t>(target.component)]) ||
          (mayLeaveOut && leftOut(image, i))) {
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

void requirePlanes(const ExrReader& file, const RecognizedLayout& layout, std::span<const Plane> planes,
                   const std::string& wayOut) {
  const std::vector<std::string> present = file.channels();
  std::vector<std::string> missing;
  for (const Plane& plane : planes) {
    for (const char component : plane.components) {
      const std::string name = layout.channel(plane.name, component);
      // Several lights may have one colour.
      if (std::ranges::find(present, name) == present.end() && std::ranges::find(missing, name) == missing.end()) {
        missing.push_back(name);
      }
    }
  }
  if (!missing.empty()) {
    throw InputError(file.path().string() + ": missing channel" + (missing.size() > 1 ? "s " : " ") + join(missing) +
                     " (layout: " + std::string(layout.layout->name) + "). " +
                     (layout.map != nullptr ? "Correct the map." : wayOut) + " Channels found: " + join(present));
  }
}

}  // namespace

const Layout& cyclesLayout() {
  // Blender's vectors point to the previous position with y up, and its normals are in world space.
  static const Layout layout{"Blender Cycles multi-layer",
                             kCyclesPlanes,
                             CameraSource::JsonFile,
                             InputConventions{.normal = InputConventions::Space::World,
                                              .motionDepth = InputConventions::MotionDepth::StaticScene},
                             glm::vec2(1.0F, -1.0F),
                             {Role::ObjectId, "IndexOB", "X"},
                             kCyclesAdded,
                             kCyclesSpecular,
                             kSpecularFile,
                             false};
  return layout;
}

const Layout& cyclesLayout5() {
  static const Layout layout = [] {
    Layout renamed = cyclesLayout();
    renamed.planes = kCyclesPlanes5;
    renamed.objectId.name = "Object Index";
    renamed.added = kCyclesAdded5;
    renamed.specular = kCyclesSpecular5;
    renamed.specularFile = kSpecularFile5;
    return renamed;
  }();
  return layout;
}

const Layout& projectLayout() {
  static const Layout layout{"walr",
                             kProjectPlanes,
                             CameraSource::HeaderAttributes,
                             InputConventions{},
                             glm::vec2(1.0F, 1.0F),
                             {Role::ObjectId, "ObjectId", "Y"},
                             kProjectAdded,
                             kProjectSpecular};
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

std::string RecognizedLayout::plane(std::string_view name) const {
  return (viewLayer.empty() ? "" : viewLayer + ".") + std::string(name);
}

std::string RecognizedLayout::plane(Light light) const {
  return plane(planeOf(*layout, roleOf(light)).name);
}

bool RecognizedLayout::hasSpecular(Role role) const {
  const std::span<const Plane> apart = layout->specularFile;
  if (specularFiles && std::ranges::find(apart, role, &Plane::role) != apart.end()) return true;
  return std::ranges::find(specular, role, &Plane::role) != specular.end();
}

std::string RecognizedLayout::channel(std::string_view plane, char component) const {
  const std::string name = this->plane(plane) + "." + component;
  if (map == nullptr) return name;
  const auto found = map->channels.find(name);
  return found == map->channels.end() ? name : found->second;
}

RecognizedLayout recognizeLayout(const ExrReader& file, std::string_view viewLayer) {
  const std::vector<std::string> channels = file.channels();
  for (const Layout* layout : {&cyclesLayout(), &cyclesLayout5(), &projectLayout()}) {
    std::set<std::string> layers = viewLayersWith(channels, planeOf(*layout, Role::Indirect));
    if (layers.empty()) {
      // A file without light channels is recognised by its albedo, so that the error can name the missing channels.
      layers = viewLayersWith(channels, planeOf(*layout, Role::Albedo));
    }
    if (layers.empty()) {
      continue;
    }
    if (!viewLayer.empty() && !layers.contains(std::string(viewLayer))) {
      const bool none = layers == std::set<std::string>{""};
      throw InputError(file.path().string() + ": no view layer '" + std::string(viewLayer) + "'; " +
                       (none ? "its channels have none: leave out --view-layer" : "the file has: " + join(layers)));
    }
    if (viewLayer.empty() && layers.size() > 1) {
      throw InputError(file.path().string() + ": several view layers (" + join(layers) +
                       "); choose one with --view-layer NAME");
    }
    RecognizedLayout recognized{layout, viewLayer.empty() ? *layers.begin() : std::string(viewLayer)};
    recognized.objectIds = hasPlane(file, recognized, layout->objectId);
    const auto has = [&](const Plane& plane) { return hasPlane(file, recognized, plane); };
    if (std::ranges::all_of(layout->specular, [&](const Plane& p) { return p.role != Role::Specular || has(p); })) {
      std::ranges::copy_if(layout->specular, std::back_inserter(recognized.specular),
                           [&](const Plane& plane) { return !plane.optional || has(plane); });
    }
    std::ranges::copy_if(layout->added, std::back_inserter(recognized.added),
                         [&](const AddedLight& light) { return hasPlane(file, recognized, colours(light.name)); });
    return recognized;
  }
  if (file.views().size() > 1) {
    throw InputError(file.path().string() + ": the picture has several views (" + join(file.views()) +
                     "); choose one with --stereo-view NAME. Channels found: " + join(channels));
  }
  throw InputError(
      file.path().string() +
      ": neither a Blender Cycles frame (channels DiffInd.R, ..., or Diffuse Indirect.R, ... since Blender "
      "5) nor a frame in walr's own layout (Indirect.R, ...). If another renderer wrote it, say with --channels FILE "
      "which "
      "channels hold what. Channels found: " +
      (channels.empty() ? "none" : join(channels)));
}

RecognizedLayout mappedLayout(const ExrReader& file, std::shared_ptr<const ChannelMap> map) {
  RecognizedLayout mapped{&map->layout, {}};
  mapped.map = std::move(map);
  mapped.objectIds = mapped.map->channels.contains(std::string(mapped.layout->objectId.name) + ".Y") ||
                     hasPlane(file, mapped, mapped.layout->objectId);
  mapped.specular = mapped.map->specular;
  mapped.added = mapped.map->added;
  return mapped;
}

void requireChannels(const ExrReader& file, const RecognizedLayout& layout, const LightWish& wanted) {
  if (wanted.specular == SpecularWish::Denoised &&
      !(layout.hasSpecular(Role::Specular) && layout.hasSpecular(Role::Roughness))) {
    throw InputError(
        file.path().string() +
        ": no specular light with roughness (Specular.R, SpecularDistance.Z, Roughness.Y and others of walr's own "
        "layout; layout: " +
        std::string(layout.layout->name) +
        "). Render with 'walr render --specular' or, in Blender, with samples/blender/export_frames.py, name them in a "
        "map of channels, or denoise diffuse light. Channels found: " +
        join(file.channels()));
  }
  std::vector<Plane> planes;
  std::ranges::copy_if(layout.layout->planes, std::back_inserter(planes),
                       [&](const Plane& plane) { return isWanted(plane, wanted); });
  if (layout.objectIds) {
    planes.push_back(layout.layout->objectId);
  }
  if (wanted.specular != SpecularWish::Nothing) {
    planes.insert(planes.end(), layout.specular.begin(), layout.specular.end());
  }
  if (wanted.rest) {
    for (const AddedLight& light : layout.added) {
      planes.push_back(colours(light.name));
      if (!light.colour.empty()) planes.push_back(colours(light.colour));
    }
  }
  requirePlanes(file, layout, planes,
                wanted.rest ? "Render with these passes, or leave out --composite: only composites need direct light, "
                              "emission and light that is not diffuse."
                            : "Render with these passes, or say with --channels FILE which channels hold what.");
}

void requireReferenceChannels(const ExrReader& file, const RecognizedLayout& layout, const LightWish& wanted) {
  std::vector<Plane> planes;
  const bool divides = layout.map != nullptr && layout.map->lightTimesAlbedo;
  if (wanted.onlySpecular()) {
    std::ranges::copy_if(layout.specular, std::back_inserter(planes), [&](const Plane& plane) {
      return plane.role == Role::Specular || (divides && plane.role == Role::SpecularAlbedo);
    });
    requirePlanes(file, layout, planes, "Render references with specular light, too, or remove them.");
    return;
  }
  const Plane& indirect = planeOf(*layout.layout, Role::Indirect);
  const Plane& direct = planeOf(*layout.layout, Role::Direct);
  const bool mayHoldDirect = wanted.direct && hasPlane(file, layout, direct);
  if (mayHoldDirect) planes.push_back(direct);
  if (!mayHoldDirect || hasPlane(file, layout, indirect)) planes.push_back(indirect);
  if (divides) planes.push_back(planeOf(*layout.layout, Role::Albedo));
  requirePlanes(file, layout, planes, "A file whose name starts with 'ref' is a reference; rename it if it is not.");
}

void readFrame(ExrReader& file, const RecognizedLayout& layout, const LightWish& wanted, const PixelRect& place,
               Frame& frame) {
  file.requireBlocks();
  std::vector<ExrReader::Target> targets;
  const auto addPlane = [&](const Plane& plane) {
    addTargets(targets, layout, plane, imageOf(frame, plane.role), place, valueOutside(plane.role));
  };
  for (const Plane& plane : layout.layout->planes) {
    if (isWanted(plane, wanted)) addPlane(plane);
  }
  if (layout.objectIds) addPlane(layout.layout->objectId);
  // A channel can be read once, but specular light and composites may use the same planes.
  std::map<std::string_view, Image> parts;
  const auto readPart = [&](const Plane& plane) {
    if (plane.name.empty() || parts.contains(plane.name)) return;
    addTargets(targets, layout, plane, parts[plane.name], place, valueOutside(plane.role));
  };
  const std::vector<AddedLight> added = wanted.rest ? addedBeside(layout, wanted.specular) : std::vector<AddedLight>{};
  for (const AddedLight& light : added) {
    for (const std::string_view name : {light.name, light.colour}) readPart(colours(name));
  }
  if (wanted.specular != SpecularWish::Nothing) std::ranges::for_each(layout.specular, readPart);
  file.read(targets, place);
  findNonFinite(file.path(), targets, false, frame.nonFinite);
  if (wanted.specular != SpecularWish::Nothing) {
    for (const Plane& plane : layout.specular) addPart(parts.at(plane.name), imageOf(frame, plane.role));
  }
  for (const AddedLight& light : added) addLight(light, parts, frame.*light.image);
}

void requireSpecularFile(const ExrReader& file, const RecognizedLayout& layout) {
  requirePlanes(file, layout, layout.layout->specularFile,
                "A file whose name starts with 'specular' tells distances and roughness; rename it if it does not.");
}

void readSpecularFile(ExrReader& file, const RecognizedLayout& layout, const PixelRect& place, Frame& frame) {
  file.requireBlocks();
  std::map<Role, Image> sums;
  std::vector<ExrReader::Target> targets;
  for (const Plane& plane : layout.layout->specularFile) {
    addTargets(targets, layout, plane, sums[plane.role], place, 0.0F);
  }
  file.read(targets, place);
  findNonFinite(file.path(), targets, false, frame.nonFinite);
  frame.specularDistance = frame.roughness = Image(place.size.x, place.size.y, 1);
  for (std::size_t i = 0; i < frame.roughness.pixelCount(); ++i) {
    const std::span<const float> nearness = sums[Role::SpecularDistance].pixel(i);
    const std::span<const float> roughness = sums[Role::Roughness].pixel(i);
    frame.specularDistance.values()[i] = nearness[0] > 0.0F ? nearness[1] / nearness[0] : kBackgroundDepth;
    frame.roughness.values()[i] = roughness[1] > 0.0F ? roughness[0] / roughness[1] : 1.0F;
  }
}

Reference readReference(ExrReader& file, const RecognizedLayout& layout, const LightWish& wanted,
                        const PixelRect& place, std::vector<NonFiniteChannel>& nonFinite) {
  file.requireBlocks();
  Reference reference;
  std::vector<ExrReader::Target> targets;
  const auto addPlane = [&](const Plane& plane, Image& image) {
    addTargets(targets, layout, plane, image, place, std::numeric_limits<float>::quiet_NaN());
  };
  const Plane& indirect = planeOf(*layout.layout, Role::Indirect);
  const Plane& direct = planeOf(*layout.layout, Role::Direct);
  const bool readsIndirect = wanted.indirect && hasPlane(file, layout, indirect);
  if (readsIndirect) addPlane(indirect, reference.indirect);
  if (wanted.direct && hasPlane(file, layout, direct)) addPlane(direct, reference.direct);
  Image albedo;
  const bool divides = layout.map != nullptr && layout.map->lightTimesAlbedo;
  if (divides && !targets.empty()) addPlane(planeOf(*layout.layout, Role::Albedo), albedo);
  Plane half = indirect;
  const std::string halfName = std::string(half.name) + "A";
  half.name = halfName;
  if (readsIndirect && hasPlane(file, layout, half)) addPlane(half, reference.indirectHalf);
  const std::array sums{&reference.specular, &reference.specularHalf};
  std::array<std::vector<Image>, sums.size()> parts;  // Of each, if the file has all of them.
  for (std::size_t i = 0; wanted.specular != SpecularWish::Nothing && i < sums.size(); ++i) {
    std::vector<std::string> names;
    for (const Plane& plane : layout.specular) {
      if (plane.role == Role::Specular) names.push_back(std::string(plane.name) + (i == 0 ? "" : "A"));
    }
    if (!std::ranges::all_of(names, [&](const auto& name) { return hasPlane(file, layout, colours(name)); })) break;
    parts.at(i).resize(names.size());
    for (std::size_t p = 0; p < names.size(); ++p) addPlane(colours(names[p]), parts.at(i)[p]);
  }
  Image specularAlbedo;
  const auto specularAlbedoPlane = std::ranges::find(layout.specular, Role::SpecularAlbedo, &Plane::role);
  if (divides && !parts.front().empty() && specularAlbedoPlane != layout.specular.end()) {
    addPlane(*specularAlbedoPlane, specularAlbedo);
  }
  if (!targets.empty()) file.read(targets, place);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (const Image& part : parts.at(i)) addPart(part, *sums.at(i));
  }
  findNonFinite(file.path(), targets, true, nonFinite);
  if (divides) {
    for (Image* const light : {&reference.indirect, &reference.direct, &reference.indirectHalf}) {
      divideByAlbedo(*light, albedo);
    }
    for (Image* const light : {&reference.specular, &reference.specularHalf}) divideByAlbedo(*light, specularAlbedo);
  }
  return reference;
}

std::string describeUndenoised(const RecognizedLayout& layout, std::span<const Light> denoised) {
  std::vector<std::string> names;
  const std::string albedo = std::string(planeOf(*layout.layout, Role::Albedo).name);
  for (const Light light : {Light::Indirect, Light::Direct}) {
    if (std::ranges::find(denoised, light) != denoised.end()) continue;
    names.push_back(std::string(planeOf(*layout.layout, roleOf(light)).name) + " x " + albedo);
  }
  names.emplace_back(planeOf(*layout.layout, Role::Emission).name);
  const bool specular = std::ranges::find(denoised, Light::Specular) != denoised.end();
  for (const AddedLight& light : addedBeside(layout, specular ? SpecularWish::Denoised : SpecularWish::Nothing)) {
    names.push_back(std::string(light.name) + (light.colour.empty() ? "" : " x " + std::string(light.colour)));
  }
  return join(names);
}

std::string describeMissing(const RecognizedLayout& layout) {
  std::vector<std::string> names;
  for (const AddedLight& light : layout.layout->added) {
    if (light.usual && std::ranges::find(layout.added, light.name, &AddedLight::name) == layout.added.end()) {
      names.emplace_back(light.name);
    }
  }
  return join(names);
}

}  // namespace walr
