#pragma once

#include <string>
#include <vector>

#include "tests/passes/reference/frame.h"

namespace walr::test {

/// Frames that are hard on the arithmetic.
struct HardCase {
  std::string name;
  std::vector<reference::HostFrame> frames;
};

/// Small but nonzero feature variance, collinear features, isolated pixels, fireflies, extremes of radiance and depth,
/// grazing planes, normals on the octahedral fold, degenerate normals.
std::vector<HardCase> hardCases();

}  // namespace walr::test
