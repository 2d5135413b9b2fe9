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

/// The quantity that an image in a file holds.
enum class Role { Indirect, Direct, Albedo, Normal, Depth, Motion, Emission, ObjectId };

/// One image of a layout: its name without the view layer, and one letter per component.
struct Plane {
  Role role;
  std::string_view name;
  std::string_view components;
  bool compositeOnly = false;  ///< Needed only for a composite.
};

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
  /// Name of the plane with the radiance of the sky, which is added to the emission if a file has it; empty: none.
  std::string_view sky = {};
};

const Layout& cyclesLayout();
const Layout& projectLayout();

/// A layout whose change of depth has another source than the layout says.
/// @param file  a file with the layout, for the error
/// @throws InputError if it is to be given, and the layout's motion has no third component
Layout withMotionDepth(const Layout& layout, InputConventions::MotionDepth source, const std::filesystem::path& file);

/// The layout of a file, with the file's view layer.
struct RecognizedLayout {
  const Layout* layout = nullptr;
  std::string viewLayer;   ///< Empty if the channels have no view-layer prefix.
  bool objectIds = false;  ///< The file has `Layout::objectId`.

  /// Full name of a channel.
  [[nodiscard]] std::string channel(std::string_view plane, char component) const;
};

/// Recognise the layout of a file by its channel names.
/// @param viewLayer  the view layer to use; may be empty if the file has one view layer
/// @throws InputError naming the channels if no layout fits, or the view layers if one must be chosen
RecognizedLayout recognizeLayout(const ExrReader& file, std::string_view viewLayer);

/// Check that the file has every channel of the planes that are needed.
/// @throws InputError naming file and channels
void requireChannels(const ExrReader& file, const RecognizedLayout& layout, bool composite);

/// The same for a reference, which must hold the indirect light only.
void requireReferenceChannels(const ExrReader& file, const RecognizedLayout& layout);

/// Read the required planes into the frame's images; add channels with non-finite values to `Frame::nonFinite`.
void readFrame(ExrReader& file, const RecognizedLayout& layout, bool composite, Frame& frame);

/// Read a reference, and add its channels with non-finite values to `nonFinite`. The mean of one half of the samples is
/// optional: `DiffIndA.{R,G,B}` or `IndirectA.{R,G,B}`.
Reference readReference(ExrReader& file, const RecognizedLayout& layout, bool composite,
                        std::vector<NonFiniteChannel>& nonFinite);

}  // namespace walr
