#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "passes/methods/denoiser.h"
#include "samples/image/exr.h"
#include "samples/sequence/frame.h"

namespace walr {

/// The quantity that an image in a file holds.
enum class Role {
  Indirect,
  Direct,
  Albedo,
  Normal,
  Depth,
  Motion,
  Emission,
  ObjectId,
  Specular,
  SpecularDistance,
  Roughness,
  SpecularAlbedo,
  SpecularMotion,
};

/// One image of a layout: its name without the view layer, and one letter per component.
struct Plane {
  Role role;
  std::string_view name;
  std::string_view components;
  bool optional = false;  ///< Of `Layout::specular`: read in all frames if the first frame has it.
};

/// Light that a composite adds as it is, if the files hold it.
struct AddedLight {
  Image Frame::*image;           ///< To which the light is added.
  std::string_view name;         ///< Of the plane with the light, RGB.
  std::string_view colour = {};  ///< Plane by which the light is multiplied, RGB; empty: none.
  bool usual = true;             ///< Users are told if the files do not hold it.
};

/// What is wanted of specular light and of what belongs to it.
enum class SpecularWish {
  Nothing,
  IfHeld,  ///< Read it if the files hold it, as linters do.
  /// The files must hold it, with roughness. Without distances, all that is reflected is taken to be far away. A
  /// composite gets it from the denoiser, and does not add it as it is.
  Denoised,
};

/// The light to read beside the guides.
struct LightWish {
  bool indirect = true;
  bool direct = false;
  bool rest = false;  ///< Emission, and the lights that a composite adds.
  SpecularWish specular = SpecularWish::Nothing;

  /// Whether specular light is denoised, and nothing else.
  [[nodiscard]] bool onlySpecular() const { return specular == SpecularWish::Denoised && !indirect && !direct; }
};
/// Everything that a composite consists of.
inline constexpr LightWish kWholePicture{.indirect = true, .direct = true, .rest = true};

/// Where a layout stores its cameras.
enum class CameraSource { JsonFile, HeaderAttributes };

/// A convention of channel names, spaces and scales. See samples/docs/sequences.md.
struct Layout {
  std::string_view name;
  std::span<const Plane> planes;
  CameraSource cameras;
  InputConventions conventions;
  glm::vec2 motionScale;  ///< See `FrameDescription::motionScale`.
  Plane objectId;         ///< Optional: read in all frames if the first frame has it.
  /// Optional: read in all frames if the first frame has the light.
  std::span<const AddedLight> added = {};
  /// Optional: specular light, the sum of all planes of its role, and what belongs to it. Read in all frames if the
  /// first frame has the light.
  std::span<const Plane> specular = {};
  /// What files of their own tell of specular light, if there are such files (`readSpecularFile`).
  std::span<const Plane> specularFile = {};
  bool ownSpecularAlbedo = true;  ///< The specular albedo is the one of walr/specular_albedo.h.
};

/// Blender up to version 4.
const Layout& cyclesLayout();
/// Blender from version 5 on, which gave most passes other names.
const Layout& cyclesLayout5();
const Layout& projectLayout();

/// The same layout with another source of the change of depth.
/// @param file  a file with the layout, for the error
/// @throws InputError if the source is `Given` and the layout's motion has no third component
Layout withMotionDepth(const Layout& layout, InputConventions::MotionDepth source, const std::filesystem::path& file);

struct ChannelMap;

/// The layout of a file, with the file's view layer.
struct RecognizedLayout {
  const Layout* layout = nullptr;
  std::string viewLayer;                       ///< Empty if the channels have no view-layer prefix.
  bool objectIds = false;                      ///< The file has `Layout::objectId`.
  std::vector<Plane> specular = {};            ///< Those of `Layout::specular` to be read; none without the light.
  bool specularFiles = false;                  ///< There are files with `Layout::specularFile`.
  std::vector<AddedLight> added = {};          ///< Those of `Layout::added` that the file has.
  std::shared_ptr<const ChannelMap> map = {};  ///< Where channels are found, if a user says so; `layout` is its.

  /// Full name of a plane, and of one of its channels in the file.
  [[nodiscard]] std::string plane(std::string_view name) const;
  [[nodiscard]] std::string channel(std::string_view plane, char component) const;
  /// Full name of the plane that holds a light.
  [[nodiscard]] std::string plane(Light light) const;
  /// Whether `specular` has a plane of this role, or other files have it.
  [[nodiscard]] bool hasSpecular(Role role) const;
};

/// Recognise the layout of a file by its channel names.
/// @param viewLayer  the view layer to use; may be empty if the file has one view layer
/// @throws InputError naming the channels if no layout fits, or the view layers if one must be chosen
RecognizedLayout recognizeLayout(const ExrReader& file, std::string_view viewLayer);

/// The layout of a file whose channels a user has described.
RecognizedLayout mappedLayout(const ExrReader& file, std::shared_ptr<const ChannelMap> map);

/// Check that the file has every channel of the planes that are needed.
/// @throws InputError naming file and channels
void requireChannels(const ExrReader& file, const RecognizedLayout& layout, const LightWish& wanted);

/// The same for a reference. It must hold the indirect light, or, where direct light is wanted, one of both.
void requireReferenceChannels(const ExrReader& file, const RecognizedLayout& layout, const LightWish& wanted);

/// Read the required planes into the frame's images; add channels with non-finite values to `Frame::nonFinite`.
/// @param place  of the images
void readFrame(ExrReader& file, const RecognizedLayout& layout, const LightWish& wanted, const PixelRect& place,
               Frame& frame);

/// Check that a file has `Layout::specularFile`.
/// @throws InputError naming file and channels
void requireSpecularFile(const ExrReader& file, const RecognizedLayout& layout);

/// Read `Frame::specularDistance` and `Frame::roughness` from a file that `blender/export_frames.py` has written. Red
/// over green is the mean of one over the distance in one plane, and the roughness of the glossy lobes in the other.
void readSpecularFile(ExrReader& file, const RecognizedLayout& layout, const PixelRect& place, Frame& frame);

/// Read the wanted lights that a reference holds, and add its channels with non-finite values to `nonFinite`. The mean
/// of one half of the samples is optional: the plane of the light with an A after its name (`IndirectA`).
/// @param place  of the images; pixels that the file lacks have no reference
Reference readReference(ExrReader& file, const RecognizedLayout& layout, const LightWish& wanted,
                        const PixelRect& place, std::vector<NonFiniteChannel>& nonFinite);

/// The passes that a composite adds as they are, in words: "Emit, GlossDir x GlossCol".
/// @param denoised  the lights that are not among them
std::string describeUndenoised(const RecognizedLayout& layout, std::span<const Light> denoised);
/// Names of the optional passes of a composite that the files do not hold; empty if they hold all.
std::string describeMissing(const RecognizedLayout& layout);

}  // namespace walr
