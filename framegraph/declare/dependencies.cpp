#include "framegraph/declare/dependencies.h"

namespace fg {
namespace {

class Finder {
 public:
  Finder(const Topology& topology, const std::vector<bool>& live) : topology_(topology), live_(live) {}

  std::vector<Dependency> run() {
    for (const std::uint32_t resource : topology_.resourcesByName()) {
      for (std::uint32_t version = 0; version < topology_.versionCount(resource); ++version) {
        const VersionUses& uses = topology_.uses(resource, version);
        if (uses.writer == kNone || !live_[uses.writer]) continue;
        for (const std::uint32_t reader : uses.readers) {
          add({uses.writer, reader, resource, version, DependencyKind::ReadAfterWrite});
        }
        followReplaced(resource, version);
      }
    }
    return std::move(found_);
  }

 private:
  /// The writer of a version waits for all passes that still need the version that it replaces. If the writer of
  /// the replaced version is culled, that version has no readers left, and the one before it is replaced instead.
  void followReplaced(std::uint32_t resource, std::uint32_t version) {
    const std::uint32_t writer = topology_.uses(resource, version).writer;
    std::uint32_t replaced = topology_.uses(resource, version).predecessor;
    for (std::uint32_t steps = 0; replaced != kNone && steps < topology_.versionCount(resource); ++steps) {
      const VersionUses& uses = topology_.uses(resource, replaced);
      for (const std::uint32_t reader : uses.readers) {
        add({reader, writer, resource, replaced, DependencyKind::WriteAfterRead});
      }
      if (uses.writer != kNone && live_[uses.writer]) {
        add({uses.writer, writer, resource, replaced, DependencyKind::WriteAfterWrite});
        return;
      }
      replaced = uses.predecessor;
    }
  }

  void add(const Dependency& dependency) {
    if (dependency.before == dependency.after || !live_[dependency.before] || !live_[dependency.after]) return;
    found_.push_back(dependency);
  }

  const Topology& topology_;
  const std::vector<bool>& live_;
  std::vector<Dependency> found_;
};

}  // namespace

std::vector<Dependency> dependencies(const Topology& topology, const std::vector<bool>& live) {
  return Finder(topology, live).run();
}

}  // namespace fg
