#include "passes/methods/denoiser.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "passes/methods/accumulate.h"
#include "passes/methods/bmfr.h"
#include "passes/methods/flnr.h"
#include "passes/methods/flr.h"
#include "passes/methods/joint_bilateral.h"
#include "passes/methods/refwlr.h"
#include "passes/methods/svgf.h"
#include "passes/methods/walr_method.h"
#include "passes/methods/walr_paper.h"
#include "passes/settings/text.h"
#include "passes/stage/pass_through.h"
#include "shaders/conventions/frame.h"

namespace walr {
namespace {

template <typename Settings>
struct Preset {
  std::string_view name;
  Settings (*make)();
};

template <typename Settings>
constexpr std::array<Preset<Settings>, 0> kPresets{};
template <>
constexpr std::array kPresets<WalrSettings>{Preset<WalrSettings>{"standard", [] { return WalrSettings{}; }}};
template <>
constexpr std::array kPresets<WalrPaperSettings>{Preset<WalrPaperSettings>{"paper", paperWalr},
                                                 Preset<WalrPaperSettings>{"robust", robustWalr}};
template <>
constexpr std::array kPresets<RefwlrSettings>{Preset<RefwlrSettings>{"robust", robustRefwlr},
                                              Preset<RefwlrSettings>{"paper", paperRefwlr}};
template <>
constexpr std::array kPresets<BmfrSettings>{Preset<BmfrSettings>{"tuned", tunedBmfr},
                                            Preset<BmfrSettings>{"paper", paperBmfr}};
template <>
constexpr std::array kPresets<SvgfSettings>{Preset<SvgfSettings>{"tuned", tunedSvgf},
                                            Preset<SvgfSettings>{"paper", paperSvgf}};
template <>
constexpr std::array kPresets<FlnrSettings>{Preset<FlnrSettings>{"small", [] { return FlnrSettings{}; }},
                                            Preset<FlnrSettings>{"full", fullFlnr},
                                            Preset<FlnrSettings>{"paper", paperFlnr}};

/// What to add to the message when a method has no such preset, for presets that it once had.
template <typename Settings>
constexpr std::string_view kFormerPresets{};
template <>
constexpr std::string_view kFormerPresets<WalrSettings> =
    "; of the former presets, fast, blocks, one-sample and many-samples are part of standard, which takes in "
    "accumulated light where that gains and spends little time on it elsewhere, and robust and paper are presets of "
    "the method walr_paper";

/// The scene that satisfies both descriptions.
SceneDescription common(const SceneDescription& a, const SceneDescription& b) {
  return {.cameraMotion = a.cameraMotion && b.cameraMotion,
          .objectMotion = a.objectMotion && b.objectMotion,
          .jitter = a.jitter && b.jitter,
          .sky = a.sky && b.sky,
          .hostAntialiasing = a.hostAntialiasing || b.hostAntialiasing,
          .resizing = a.resizing || b.resizing};
}

struct Method {
  std::string_view name;
  std::string_view description;
  std::unique_ptr<Denoiser> (*make)(const Method& method);
  bool takesSparseLight = false;
  bool sharesGuides = true;
  bool takesSpecularLight = false;
};

/// @throws std::invalid_argument if a method needs light at every pixel and not every pixel has it, or takes diffuse
///         light only and the light is specular
void checkLight(const Method& method, const InputConventions& conventions);

/// A method made of a settings struct and the function that adds its passes.
template <typename Settings, auto kAdd>
class DenoiserOf final : public Denoiser {
 public:
  explicit DenoiserOf(const Method& method) : method_(method) {}

  void visitSettings(SettingVisitor& visitor) override {
    settings_.visit(visitor);
    scene_.visit(visitor);
  }

  [[nodiscard]] std::vector<std::string> presets() const override {
    std::vector<std::string> names;
    for (const auto& preset : kPresets<Settings>) names.emplace_back(preset.name);
    return names;
  }

  void usePreset(std::string_view name) override {
    for (const auto& preset : kPresets<Settings>) {
      if (preset.name != name) continue;
      settings_ = preset.make();
      scene_ = {};
      return;
    }
    throw std::invalid_argument("there is no preset \"" + std::string(name) + "\" of this method; known presets: " +
                                (kPresets<Settings>.empty() ? "none" : join(presets())) +
                                std::string(kFormerPresets<Settings>));
  }

  [[nodiscard]] bool sharesGuides() const override { return method_.sharesGuides; }
  [[nodiscard]] bool takesSpecularLight() const override { return method_.takesSpecularLight; }

  void requireLight(const InputConventions& conventions) const override { checkLight(method_, conventions); }

  fg::Texture add(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output) override {
    checkSettings();
    requireLight(inputs.conventions);
    if (graph.shared() != nullptr && !method_.sharesGuides) {
      throw std::invalid_argument("method '" + std::string(method_.name) +
                                  "' has no guides that lights could share: make a denoiser for each light");
    }
    DenoiserInputs described = inputs;
    described.scene = common(inputs.scene, scene_);
    if (inputs.conventions.orthographic && described.scene.cameraMotion) described.scene.objectMotion = true;
    described.conventions.light = inputs.conventions.samples();
    const fg::Texture denoised = kAdd(graph, described, output, settings_);
    graph.requireOutputs();
    return denoised;
  }

 private:
  const Method& method_;
  Settings settings_{};
  SceneDescription scene_;
};

template <typename Settings, auto kAdd>
std::unique_ptr<Denoiser> make(const Method& method) {
  return std::make_unique<DenoiserOf<Settings, kAdd>>(method);
}

struct NoSettings {
  void visit(SettingVisitor& /*visitor*/) {}
};

fg::Texture addNone(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const NoSettings& /*none*/) {
  return addPassThrough(graph, inputs.lighting, output);
}

constexpr std::array kMethods{
    Method{"walr", "Weighted A-Trous Linear Regression over blocks of pixels: the project's own method",
           make<WalrSettings, addWalr>, true, true, true},
    Method{"walr_paper", "Weighted A-Trous Linear Regression over pixels, as published",
           make<WalrPaperSettings, addWalrPaper>, true},
    Method{"refwlr", "The reference of walr_paper: regression over the full window, seconds a frame",
           make<RefwlrSettings, addRefwlr>},
    Method{"bmfr", "Blockwise Multi-Order Feature Regression", make<BmfrSettings, addBmfr>, true},
    Method{"svgf", "Spatiotemporal Variance-Guided Filtering", make<SvgfSettings, addSvgf>, false, true, true},
    Method{"flr", "Fast Local Regression over downsampled moments", make<FlrSettings, addFlr>, true},
    Method{"flnr", "FLR with guides from a small network: experimental", make<FlnrSettings, addFlnr>},
    Method{"joint_bilateral", "Joint bilateral filter with temporal accumulation",
           make<JointBilateralSettings, addJointBilateral>},
    Method{"accumulate", "Temporal accumulation alone", make<AccumulateSettings, addAccumulate>, true, true, true},
    Method{"none", "The input as it is", make<NoSettings, addNone>, false, false, true},
};

const Method& findMethod(std::string_view name) {
  const auto found = std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return m.name == name; });
  if (found == kMethods.end()) {
    throw std::invalid_argument("there is no method \"" + std::string(name) +
                                "\"; known methods: " + join(denoiserNames()));
  }
  return *found;
}

/// Names of the methods that take a kind of light.
std::string methodsThat(bool Method::*takes) {
  std::vector<std::string> names;
  for (const Method& each : kMethods) {
    if (each.*takes) names.emplace_back(each.name);
  }
  return join(names);
}

void checkLight(const Method& method, const InputConventions& conventions) {
  const LightPattern& light = conventions.light;
  checkLightPattern(light);
  if (conventions.specular && !method.takesSpecularLight) {
    throw std::invalid_argument(
        "method '" + std::string(method.name) +
        "' takes diffuse light only; methods that take specular light: " + methodsThat(&Method::takesSpecularLight));
  }
  if (conventions.specular && (light.counted || !light.fullSize())) {
    throw std::invalid_argument(
        "specular light needs a texel at every pixel, and its alpha holds distances, not counts of samples: leave out "
        "light groups and counts, and set the distance to 0 where there is no sample");
  }
  if (light.everyPixel() || method.takesSparseLight) return;
  throw std::invalid_argument("method '" + std::string(method.name) +
                              "' needs a sample of light at every pixel; methods that take sparse light: " +
                              methodsThat(&Method::takesSparseLight));
}

}  // namespace

std::vector<ViewInfo> Denoiser::views(const InputConventions& conventions) {
  // The views that the stages offer when recorded on a graph that is then discarded.
  constexpr fg::Extent kExtent{1920, 1080};
  const fg::TextureDesc colour{VK_FORMAT_R16G16B16A16_SFLOAT, kExtent};
  fg::Graph graph;
  DenoiserInputs inputs;
  inputs.lighting = graph.texture("lighting", {colour.format, conventions.light.lightingExtent(kExtent)});
  inputs.depth = graph.texture("depth", {VK_FORMAT_R32_SFLOAT, kExtent});
  inputs.normal = graph.texture("normal", colour);
  inputs.motion = graph.texture("motion", colour);
  inputs.albedo = inputs.specularAlbedo = graph.texture("albedo", colour);
  inputs.roughness = graph.texture("roughness", {VK_FORMAT_R8_UNORM, kExtent});
  inputs.frame = graph.upload("frame constants", sizeof(FrameConstants));
  inputs.conventions = conventions;
  Inspection inspection;
  (void)add({graph, inspection}, inputs, graph.texture("output", colour));
  return inspection.known();
}

std::vector<std::string> denoiserNames() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) names.emplace_back(method.name);
  return names;
}

std::string_view denoiserDescription(std::string_view method) {
  return findMethod(method).description;
}

std::unique_ptr<Denoiser> makeDenoiser(std::string_view method) {
  const Method& found = findMethod(method);
  return found.make(found);
}

}  // namespace walr
