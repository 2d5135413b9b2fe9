#include "passes/temporal_antialiasing.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "passes/reprojection.h"
#include "shaders/constants/temporal_antialiasing.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// A shader and the one of its views.
struct StageShaders {
  const fg::Shader* stage;
  const fg::Shader* view;
};
using ByStorage = std::array<StageShaders, 2>;

#define WALR_BY_STORAGE(shader)              \
  {                                          \
    {                                        \
      {&shader, &shader##View}, {            \
        &shader##Packed, &shader##ViewPacked \
      }                                      \
    }                                        \
  }
#define WALR_BY_OBJECTS(shader)                                  \
  {                                                              \
    { WALR_BY_STORAGE(shader), WALR_BY_STORAGE(shader##Object) } \
  }
#define WALR_BY_REJECTION(shader)                                                               \
  {                                                                                             \
    { WALR_BY_OBJECTS(shader##Plane), WALR_BY_OBJECTS(shader##Depth), WALR_BY_OBJECTS(shader) } \
  }

constexpr ByStorage kStill WALR_BY_STORAGE(shaders::temporalAntialiasingStill);
constexpr ByStorage kKept WALR_BY_STORAGE(shaders::temporalAntialiasingKept);

/// @param objects whether objects are told apart, too
const ByStorage& shadersFor(MotionSource motion, HistoryRejection rejection, bool objects) {
  using namespace shaders;
  using ByObjects = std::array<ByStorage, 2>;
  using ByRejection = std::array<ByObjects, 3>;
  static constexpr std::array<ByRejection, 2> kShaders{
      {WALR_BY_REJECTION(temporalAntialiasing), WALR_BY_REJECTION(temporalAntialiasingCamera)}};
  return kShaders.at(static_cast<std::size_t>(motion)).at(static_cast<std::size_t>(rejection)).at(objects ? 1 : 0);
}

#undef WALR_BY_REJECTION
#undef WALR_BY_OBJECTS
#undef WALR_BY_STORAGE

/// In the order of `kView` of temporal_antialiasing.comp.
const std::vector<ViewInfo>& antialiasingViews() {
  static const std::vector<ViewInfo> kViews{
      {"clip",
       "How far variance clipping moves the history in YCoCg, share of its way to the mean that this is, 1 where it "
       "does",
       {{"clipped-history", "Z"}}},
      {"resolved-history",
       "History length of anti-aliasing with this frame, history pixels rejected (of four), 1 where none is left",
       {{"no-resolved-history", "Z"}}},
  };
  return kViews;
}

/// Reads what a pass looks for its history with, and what passes through where the filter leaves no light.
using ReadHistory = std::function<void(fg::PassBuilder& pass, bool view)>;

/// The stage, whose reprojection comes from wherever `read` says.
fg::Texture addStage(StageGraph graph, const ByStorage& byStorage, const ReadHistory& read, fg::Texture filtered,
                     fg::Texture output, const TemporalAntialiasingSettings& settings) {
  const fg::Extent extent = graph->textureDesc(filtered).extent;
  const fg::History resolved = graph->history("resolved", {formatOf(settings.storage), extent});
  const StageShaders& shaders = byStorage.at(static_cast<std::size_t>(settings.storage));
  const auto declare = [&](const std::string& name, bool view) {
    fg::PassBuilder pass = graph->compute(name, view ? *shaders.view : *shaders.stage);
    read(pass, view);
    pass.sample("filtered", filtered)
        .sample("previousResolved", resolved.previous)
        .specialize("kClipRadius", settings.clipRadius)
        .constants(TemporalAntialiasingConstants{settings.maxHistory, settings.clipGamma, settings.planeTolerance,
                                                 settings.normalThreshold})
        .dispatch(extent);
    return pass;
  };
  graph.offer(antialiasingViews(), extent, [&](const std::string& name) { return declare(name, true); });
  fg::PassBuilder pass = declare("temporal anti-aliasing", false);
  (void)pass.store("outResolved", resolved.current);
  return pass.store("outImage", output);
}

}  // namespace

fg::Texture addTemporalAntialiasing(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture filtered, fg::Texture output,
                                    const TemporalAntialiasingSettings& settings) {
  const bool packed = settings.storage == LightStorage::Packed;
  if (inputs.scene.still()) {
    const auto read = [&](fg::PassBuilder& pass, bool view) {
      if (!packed) pass.sample("depth", guides.depth);
      if (packed && !view) pass.uniform("frameConstants", inputs.frame).sample("passed", inputs.lighting);
    };
    return addStage(graph, kStill, read, filtered, output, settings);
  }
  const MotionSource motion = motionSource(inputs.scene);
  const bool objects = settings.objectIds && inputs.objectId.valid();
  const ObjectIds ids = objects ? addObjectIds(graph, inputs, guides) : ObjectIds{};
  const auto read = [&](fg::PassBuilder& pass, bool view) {
    readReprojection(pass, inputs, guides, settings.rejection, motion, settings.dilateMotion);
    if (objects) readObjectIds(pass, ids);
    if (view) pass.specialize("kKeepableMotion", false);
    if (packed && !view) pass.sample("passed", inputs.lighting);
  };
  return addStage(graph, shadersFor(motion, settings.rejection, objects), read, filtered, output, settings);
}

bool sharesReprojection(const TemporalAntialiasingSettings& antialiasing,
                        const TemporalAccumulationSettings& accumulation) {
  if (antialiasing.objectIds || antialiasing.dilateMotion != accumulation.dilateMotion) return false;
  if (antialiasing.rejection == HistoryRejection::None) return true;
  return antialiasing.rejection == accumulation.rejection &&
         antialiasing.planeTolerance == accumulation.planeTolerance &&
         antialiasing.normalThreshold == accumulation.normalThreshold;
}

fg::Texture addTemporalAntialiasingWithTaps(StageGraph graph, fg::Buffer frame, fg::Texture taps, fg::Texture filtered,
                                            fg::Texture output, const TemporalAntialiasingSettings& settings) {
  const auto read = [&](fg::PassBuilder& pass, bool /*view*/) {
    pass.uniform("frameConstants", frame)
        .sample("keptTaps", taps)
        .specialize("kRejectHistory", settings.rejection != HistoryRejection::None);
  };
  return addStage(graph, kKept, read, filtered, output, settings);
}

}  // namespace walr
