#pragma once

#include <string>

#include "framegraph/declare/graph.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// "A-B" or "A": frame numbers, both ends included.
/// @throws UsageError
FrameRange parseFrameRange(const std::string& text, const std::string& option = "--frames");

/// "WIDTHxHEIGHT" in pixels, 1 to 16384 each.
/// @throws UsageError
fg::Extent parseSize(const std::string& text);

}  // namespace walr
