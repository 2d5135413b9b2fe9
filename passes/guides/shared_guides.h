#pragma once

#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/conventions/scene_description.h"
#include "passes/guides/history_tests.h"
#include "passes/guides/object_ids.h"
#include "passes/guides/prepare_guides.h"

namespace walr {

/// What decides which history taps a stage finds and accepts.
struct TapTests {
  HistoryRejection rejection = HistoryRejection::Plane;
  HistoryThresholds thresholds = {};
  bool dilateMotion = false;

  friend bool operator==(const TapTests&, const TapTests&) = default;
};

/// What the lights of a view have in common: guides, and where the history of surfaces lies. The stages of the first
/// light make it, and those of the other lights in the same graph read it.
class SharedGuides {
 public:
  /// Whether the first light's guides are there.
  [[nodiscard]] bool prepared() const { return prepared_.has_value(); }
  /// What the first light's guides were made for.
  struct Made {
    PrepareGuidesSettings settings;
    GuideNeeds needs;
    SceneDescription scene;
    bool specular = false;

    friend bool operator==(const Made&, const Made&) = default;
  };
  /// The first light's guides.
  /// @throws std::invalid_argument if they were made for something else
  [[nodiscard]] Guides guidesFor(const Made& wanted) const;
  void keep(const Made& made, const Guides& guides) { prepared_ = {made, guides}; }

  /// Kept taps (`AccumulationWithTaps::taps`) that another light found with these tests; not valid if there are none.
  [[nodiscard]] fg::Texture tapsFor(const TapTests& tests) const {
    return found_ && found_->tests == tests ? found_->taps : fg::Texture{};
  }
  void keepTaps(const TapTests& tests, fg::Texture taps) { found_ = {tests, taps}; }

  /// The object of every pixel, if a light has kept it.
  [[nodiscard]] const std::optional<ObjectIds>& objects() const { return objects_; }
  void keepObjects(const ObjectIds& objects) { objects_ = objects; }

 private:
  struct Prepared {
    Made made;
    Guides guides;
  };
  struct Found {
    TapTests tests;
    fg::Texture taps;
  };
  std::optional<Prepared> prepared_;
  std::optional<Found> found_;
  std::optional<ObjectIds> objects_;
};

}  // namespace walr
