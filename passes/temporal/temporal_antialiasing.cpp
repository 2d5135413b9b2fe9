#include "passes/temporal/temporal_antialiasing.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "passes/guides/shared_guides.h"
#include "passes/temporal/reprojection.h"
#include "shaders/conventions/packed_light.h"
#include "shaders/shaders.h"
#include "shaders/temporal/temporal_antialiasing.h"

namespace walr {
namespace {

/// In the order of `view` of temporal_antialiasing.comp.
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

/// The object of every pixel: what another light has kept, if there is one.
ObjectIds objectsOf(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides) {
  if (graph.shared() == nullptr) return addObjectIds(graph, inputs, guides);
  if (!graph.shared()->objects()) graph.shared()->keepObjects(addObjectIds(graph, inputs, guides));
  return *graph.shared()->objects();
}

/// Declares what a pass reads for reprojection and for the pass-through.
using ReadHistory = std::function<void(fg::PassBuilder& pass, bool view)>;

/// The length that the highest level of a packed history length would stand for (packed_light.glsl).
constexpr float kHighestLevel = 1 << (kLongestLevel - 1);

/// Whether the clipping box is smaller where history of another surface mixes in. The tests of history taps tell where
/// that is, although all taps are read.
bool tightAtEdges(const TemporalAntialiasingSettings& settings) {
  const bool tests = settings.rejection != HistoryRejection::None || settings.objectIds;
  return tests && settings.edgeClipGamma < settings.clipGamma;
}

/// Add the stage; `read` declares its reprojection.
/// @param kept whether that comes from the taps that accumulation kept
/// @param shortening see `addTemporalAntialiasing`
/// @param number a texture of unsigned integers that the pass reads
fg::Texture addStage(StageGraph graph, bool kept, const ReadHistory& read, fg::Texture filtered, fg::Texture output,
                     const TemporalAntialiasingSettings& settings, fg::Texture shortening, fg::Texture number) {
  const fg::Extent extent = graph->textureDesc(filtered).extent;
  const fg::History resolved = graph->history("resolved", {formatOf(settings.storage), extent});
  const bool packed = settings.storage == LightStorage::Packed;
  const HistoryThresholds thresholds =
      kept ? HistoryThresholds{} : settings.thresholds;  // Kept taps are tested already.
  const auto declare = [&](const std::string& name, bool view) {
    fg::PassBuilder pass =
        graph->compute(name, view ? shaders::temporalAntialiasingView({.kept = kept, .packed = packed})
                                  : shaders::temporalAntialiasing({.kept = kept, .packed = packed}));
    read(pass, view);
    pass.specialize("kShortened", shortening.valid()).sampleIf(shortening.valid(), "shortening", shortening, number);
    pass.sample("filtered", filtered)
        .sample("previousResolved", resolved.previous)
        .specialize("kClipRadius", settings.clipRadius)
        .constants(TemporalAntialiasingConstants{
            settings.maxHistory, settings.restFactor, settings.clipGamma, settings.edgeClipGamma, settings.filterRadius,
            settings.historySharpness, thresholds.planeTolerance, thresholds.normalThreshold})
        .dispatch(extent);
    if (packed) pass.specialize("kBeyondLevels", settings.restFactor * settings.maxHistory > kHighestLevel);
    return pass;
  };
  graph.offer(antialiasingViews(), extent, [&](const std::string& name) { return declare(name, true); });
  fg::PassBuilder pass = declare("temporal anti-aliasing", false);
  const fg::Texture mean = pass.store("outResolved", resolved.current);
  const fg::Texture image = pass.store("outImage", output);
  if (settings.accumulates) graph.offerHistoryLength(mean);
  return image;
}

}  // namespace

fg::Texture addTemporalAntialiasing(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture filtered, fg::Texture output,
                                    const TemporalAntialiasingSettings& settings, fg::Texture shortening) {
  const bool packed = settings.storage == LightStorage::Packed;
  const ReprojectionSettings reprojection =
      reprojectionOf(inputs.scene, true, settings.rejection, settings.dilateMotion);
  const bool still = reprojection.motion == MotionSource::None;
  const bool objects = !still && settings.objectIds && inputs.objectId.valid();
  const ObjectIds ids = objects ? objectsOf(graph, inputs, guides) : ObjectIds{};
  const bool pixelArea = coversPixelArea(settings, inputs.scene);
  const fg::Texture number = packed ? filtered : guides.depth;
  const auto read = [&](fg::PassBuilder& pass, bool view) {
    // A view does not show the pass-through, and so does not read it.
    const fg::Texture light = view ? fg::Texture{} : inputs.lighting;
    const StandIns standIns = {.colour = packed ? light : filtered, .number = number};
    pass.uniform("frameConstants", inputs.frame)
        .sampleIf(!still || !packed, "depth", guides.depth, standIns.number)
        .specialize("kStill", still)
        .specialize("kPixelArea", pixelArea)
        .specialize("kTightAtEdges", pixelArea && !still && tightAtEdges(settings));
    readReprojection(pass, inputs, guides, reprojection, standIns);
    readConfidence(pass, settings.accumulates ? inputs.confidence : fg::Texture{}, inputs, standIns);
    readObjectIds(pass, ids, standIns);
    if (view) pass.specialize("kKeepableMotion", false);
    if (packed && !view) {
      pass.sample("passThrough", inputs.lighting);
      specializeLight(pass, inputs.conventions.light);
    }
  };
  return addStage(graph, false, read, filtered, output, settings, shortening, number);
}

bool coversPixelArea(const TemporalAntialiasingSettings& settings, const SceneDescription& scene) {
  return settings.pixelArea && scene.jitter && !settings.accumulates;
}

void requireGivenTaps(const TemporalAntialiasingSettings& settings) {
  if (!settings.objectIds && !settings.dilateMotion) return;
  throw std::invalid_argument(std::string("setting antialiasing.") +
                              (settings.objectIds ? "object-ids" : "dilate-motion") +
                              " is for diffuse light: the history of specular light is where it was reflected");
}

bool sharesReprojection(const TemporalAntialiasingSettings& antialiasing,
                        const TemporalAccumulationSettings& accumulation) {
  if (antialiasing.objectIds || antialiasing.dilateMotion != accumulation.dilateMotion) return false;
  if (antialiasing.rejection == HistoryRejection::None) return true;
  return antialiasing.rejection == accumulation.rejection && antialiasing.thresholds == accumulation.thresholds;
}

fg::Texture addTemporalAntialiasingWithTaps(StageGraph graph, fg::Buffer frame, fg::Texture taps, fg::Texture depth,
                                            fg::Texture filtered, fg::Texture output,
                                            const TemporalAntialiasingSettings& settings, fg::Texture shortening) {
  const auto read = [&](fg::PassBuilder& pass, bool /*view*/) {
    pass.uniform("frameConstants", frame)
        .sample("keptTaps", taps)
        .sampleIf(depth.valid(), "depth", depth, taps)
        .specialize("kPixelArea", depth.valid())
        .specialize("kTightAtEdges", depth.valid() && tightAtEdges(settings))
        .specialize("kRejectHistory", settings.rejection != HistoryRejection::None);
  };
  return addStage(graph, true, read, filtered, output, settings, shortening, taps);
}

}  // namespace walr
