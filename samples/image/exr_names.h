#pragma once

#include <span>
#include <string>
#include <string_view>

namespace walr {

/// A text that is safe to print: control characters, which a terminal would obey, and bytes that are no UTF-8 are
/// written as `\\xNN`.
std::string printable(std::string_view text);

/// Where a channel is stored.
struct ExrChannelPlace {
  std::string_view channel;                 ///< Its name in its part.
  std::string_view part = {};               ///< Name of the part, of files with several parts.
  std::string_view view = {};               ///< View of the part, if it states one.
  std::span<const std::string> views = {};  ///< All views of the file, the default one first.
};

/// A channel's name as files of one part and one view have it, "Layer.Pass.C", and its view of a stereo picture.
struct ExrChannelName {
  std::string name;
  std::string view;  ///< Empty if the channel belongs to no view.
};

/// In files of several parts, a name without a dot lacks its layer, which the name of its part tells. In files of one
/// part, the view is the last but one element of the name (OpenEXR: "Storing Multi-View Images").
ExrChannelName exrChannelName(const ExrChannelPlace& place);

/// The name of a channel with its view as the last but one element.
std::string withView(const ExrChannelName& channel);

}  // namespace walr
