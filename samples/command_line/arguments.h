#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "framegraph/declare/graph.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// Parse "A-B" (first and last frame number) or "A" (one frame).
/// @throws UsageError
FrameRange parseFrameRange(const std::string& text, const std::string& option = "--frames");

/// Parse "WIDTHxHEIGHT" in pixels, 1 to 16384 each.
/// @throws UsageError
/// A check that an option's number lies in a range. Unlike CLI::Range it refuses NaN.
CLI::Validator numberFrom(double least, double most);

fg::Extent parseSize(const std::string& text);

}  // namespace walr
