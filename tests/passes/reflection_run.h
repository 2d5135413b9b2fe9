#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "passes/guides/shared_guides.h"
#include "passes/methods/denoiser.h"
#include "passes/temporal/reflection_motion.h"
#include "tests/passes/host_textures.h"
#include "tests/passes/mirror_optics.h"

namespace walr::test {

/// A method, or the stage alone on given guides, on a device frame by frame, with the stage's views.
class ReflectionRun {
 public:
  struct Options {
    bool alone = true;            ///< No other light could share the guides, so that passes may be joined.
    bool history = false;         ///< There is a third view, that of the history of accumulated light.
    bool specularMotion = false;  ///< Frames have `HostFrame::specularMotion`.
    InputConventions::MotionDepth motionDepth = InputConventions::MotionDepth::Given;
  };
  ReflectionRun(const fg::test::TestDevice& device, Denoiser& method, const Options& options)
      : inputs_(importInputs(graph_, kMirrorSize, {.motionDepth = options.motionDepth, .specular = true},
                             options.specularMotion)),
        output_(importOutput(graph_, kMirrorSize)) {
    wantViews(options.history);
    SharedGuides shared;
    const SharedLight light{.guides = options.alone ? nullptr : &shared};
    graph_.exported(method.add({graph_, inspection_, light}, inputs_, output_), fg::vk::kReadable);
    start(device);
  }
  ReflectionRun(const fg::test::TestDevice& device, Denoiser& method) : ReflectionRun(device, method, Options{}) {}
  /// Of the stage. The output is the confidence.
  ReflectionRun(const fg::test::TestDevice& device, const SceneDescription& scene, bool specularMotion,
                InputConventions::MotionDepth motionDepth)
      : inputs_(importInputs(graph_, kMirrorSize, {.motionDepth = motionDepth, .specular = true}, specularMotion)),
        guides_(importGuides(graph_, kMirrorSize)) {
    inputs_.scene = scene;
    wantViews(false);
    output_ =
        copyOut(graph_, "confidence", addReflectionMotion({graph_, inspection_}, inputs_, guides_, {}).confidence);
    start(device);
  }
  void frame(const reference::HostFrame& frame) {
    upload(*run_, inputs_, frame);
    run_->frame();
  }
  void frame(const reference::HostFrame& frame, const reference::Image<reference::Guide>& guides,
             const reference::Image<reference::Guide>& previous) {
    upload(*run_, guides_, guides);
    uploadPrevious(*run_, guides_, previous);
    this->frame(frame);
  }
  void reset() { run_->executor().resetAllHistory(); }
  [[nodiscard]] reference::Image<glm::dvec3> view(std::size_t index) const {
    const std::vector<float> texels = run_->texels<float>(inspection_.views()[index].texture);
    reference::Image<glm::dvec3> image(kMirrorSize);
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
      image.pixels()[i] = {texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]};
    return image;
  }
  [[nodiscard]] reference::Image<glm::dvec4> output() const { return readHalves(*run_, output_, kMirrorSize); }

 private:
  void wantViews(bool history) {
    const fg::Extent extent{static_cast<std::uint32_t>(kMirrorSize.x), static_cast<std::uint32_t>(kMirrorSize.y)};
    std::vector<const char*> views{"reflection-motion", "reflection-history"};
    if (history) views.push_back("history");
    for (const char* const view : views)
      inspection_.want(view,
                       graph_.import(std::string("view of ") + view, {kViewFormat, extent}, fg::vk::kOverwritable));
  }
  void start(const fg::test::TestDevice& device) {
    for (const DebugView& view : inspection_.views()) graph_.exported(view.texture, fg::vk::kReadable);
    run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
  }

  fg::Graph graph_;
  DenoiserInputs inputs_;
  Guides guides_;
  fg::Texture output_;
  Inspection inspection_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

}  // namespace walr::test
