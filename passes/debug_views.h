#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framegraph/graph.h"

namespace walr {

/// A picture of what happens inside a method, for whoever tunes or debugs it.
struct ViewInfo {
  std::string name;
  std::string description;  ///< One line: what X, Y and Z hold.
};

/// A view that a caller wants of a method.
struct DebugView {
  std::string name;
  fg::Texture texture;  ///< RGBA32F, of the inputs' extent. The passes write it and leave its new version here.
};

/// The views wanted; whatever is not among them has no pass, no texture and no branch in any shader.
using DebugViews = std::vector<DebugView>;

/// Format of their textures.
inline constexpr VkFormat kViewFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

}  // namespace walr
