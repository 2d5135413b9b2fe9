#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "framegraph/declare/graph.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// Parse "A-B" (first and last frame number) or "A" (one frame).
/// @throws UsageError
FrameRange parseFrameRange(const std::string& text, const std::string& option = "--frames");

/// A check that an option's number lies in a range. Unlike CLI::Range it refuses NaN.
CLI::Validator numberFrom(double least, double most);

/// Parse "WIDTHxHEIGHT" in pixels, 1 to 16384 each.
/// @throws UsageError
fg::Extent parseSize(const std::string& text, const std::string& option = "--size");

/// Parse the value of `--exposure`: "auto" or a finite number of stops.
/// @returns exposure in stops; nullopt: automatic
/// @throws UsageError
std::optional<float> parseExposure(const std::string& text);

}  // namespace walr
