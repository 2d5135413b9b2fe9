#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "passes/denoiser.h"
#include "samples/image/exr.h"
#include "samples/sequence/frame.h"

namespace walr {

/// What a picture in a file holds.
enum class Role { Indirect, Direct, Albedo, Normal, Depth, Motion, Emission, ObjectId };

/// One picture of a layout: its name without view layer, and one letter a component.
struct Plane {
  Role role;
  std::string_view name;
  std::string_view components;
  bool compositeOnly = false;  ///< Needed only for a composite.
};

/// Where a layout keeps its cameras.
enum class CameraSource { JsonFile, HeaderAttributes };

/// A convention of channel names, spaces and scales. See samples/README.md.
struct Layout {
  std::string_view name;
  std::span<const Plane> planes;
  CameraSource cameras;
  InputConventions conventions;
  glm::vec2 motionScale;  ///< See `FrameDescription::motionScale`.
  Plane objectId;         ///< Read where the first frame has it.
  /// Plane with the radiance of the sky, which is added to the emission where a file has it; empty: none.
  std::string_view sky = {};
};

const Layout& cyclesLayout();
const Layout& projectLayout();

/// A layout recognised in a file.
struct RecognizedLayout {
  const Layout* layout = nullptr;
  std::string viewLayer;   ///< Empty where the channels carry no view-layer prefix.
  bool objectIds = false;  ///< The file has `Layout::objectId`.

  /// Full name of a channel.
  [[nodiscard]] std::string channel(std::string_view plane, char component) const;
};

/// Tell a layout by its channel names.
/// @param viewLayer  which view layer to take where there are several; empty: the only one
/// @throws InputError naming the channels found when none fits, or when several view layers do
RecognizedLayout recognizeLayout(const ExrReader& file, std::string_view viewLayer);

/// Check that the file has every channel of the planes that are needed.
/// @throws InputError naming file and channels
void requireChannels(const ExrReader& file, const RecognizedLayout& layout, bool composite);

/// The same for a reference, which holds the indirect light and, for a composite, may hold the direct light.
void requireReferenceChannels(const ExrReader& file, const RecognizedLayout& layout);

/// Read the planes needed into the frame's images, and list the channels with values that are not finite.
void readFrame(ExrReader& file, const RecognizedLayout& layout, bool composite, Frame& frame);

/// Read a reference; adds to `nonFinite`. Its half is the indirect light's plane with an A after its name, where the
/// file has it: `DiffIndA.{R,G,B}` or `IndirectA.{R,G,B}`.
Reference readReference(ExrReader& file, const RecognizedLayout& layout, bool composite,
                        std::vector<NonFiniteChannel>& nonFinite);

}  // namespace walr
