#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/declare/topology.h"

namespace fg {

enum class DependencyKind : std::uint8_t { ReadAfterWrite, WriteAfterRead, WriteAfterWrite };

/// `before` must be executed before `after`.
struct Dependency {
  std::uint32_t before = kNone;  ///< Index into `GraphDesc::passes`.
  std::uint32_t after = kNone;
  std::uint32_t resource = kNone;  ///< The resource that causes the dependency,
  std::uint32_t version = kNone;   ///< and its version.
  DependencyKind kind = DependencyKind::ReadAfterWrite;
};

/// All dependencies between the passes that are marked live, in an order that does not depend on registration.
std::vector<Dependency> dependencies(const Topology& topology, const std::vector<bool>& live);

}  // namespace fg
