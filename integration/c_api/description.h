#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <walr/walr_passes.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "framegraph/compile/compile.h"
#include "framegraph/plan/plan.h"
#include "integration/c_api/host_images.h"
#include "integration/single_stage.h"
#include "passes/conventions/frame.h"
#include "passes/methods/denoiser.h"

namespace walr::api {

/// Contents of the upload buffers of one frame.
struct Constants {
  FrameDescription camera;  ///< Source of `frame`.
  FrameConstants frame;
  HostConstants host;
};

/// A frame as the host describes it, without its images.
struct FrameStatement {
  const WalrCamera* camera = nullptr;
  const WalrCamera* previousCamera = nullptr;  ///< Null means the camera of the frame before.
  glm::dvec3 origin{0.0};
  glm::dvec3 previousOrigin{0.0};  ///< Of `previousCamera`; not used if that is null.
  float skyDepth = 0.0F;
  float preExposure = 0.0F;
  glm::uvec2 offset{0};
  glm::uvec2 lightOffset{0};
  std::optional<std::uint32_t> index;  ///< Nothing means the number of frames before.
};

/// What the host says about a frame.
/// @param frame WalrFrame or WalrPassFrame; must outlive the result
template <typename Frame>
FrameStatement statementOf(const Frame& frame) {
  const bool givesIndex = (frame.flags & WALR_FRAME_INDEX_GIVEN) != 0;
  return {.camera = frame.camera,
          .previousCamera = frame.previous_camera,
          .origin = glm::make_vec3(frame.origin),
          .previousOrigin = glm::make_vec3(frame.previous_origin),
          .skyDepth = frame.sky_depth,
          .preExposure = frame.pre_exposure,
          .offset = glm::make_vec2(frame.offset),
          .lightOffset = glm::make_vec2(frame.light_offset),
          .index = givesIndex ? std::optional(frame.frame_index) : std::nullopt};
}

/// A graph that holds one method or stage between the host's images.
struct ListedGraph {
  fg::Graph graph;
  fg::Buffer frame;              ///< Upload of `Constants::frame`; invalid if nothing reads it.
  fg::Buffer host;               ///< Upload of `Constants::host`; invalid if nothing reads it.
  std::vector<StagePort> ports;  ///< Of a single stage.
  fg::Buffer lint;               ///< Import that receives the linter's counts; invalid without lint.
  Inspection inspection;         ///< With counters: in an import that receives them.
};

/// A method or single stage and the host's images: the checked contents of a WalrDenoiserInfo.
class Description {
 public:
  enum class Of : std::uint8_t { Methods, MethodsAndStages };
  /// @throws Error, or std::invalid_argument, naming what is wrong
  explicit Description(const WalrDenoiserInfo& info, Of of = Of::Methods);

  void resize(std::uint32_t width, std::uint32_t height);

  /// A graph of the method between the host's images, which have `kInnerStates` before and after it.
  /// @throws std::invalid_argument naming settings that contradict each other
  /// @throws also naming a view that does not exist
  /// @param wanted further outputs, for debugging
  [[nodiscard]] DenoiseGraph declare(const InspectionWish& wanted = {}) const;
  /// Views of the methods of all lights with their current settings; names of another light have its prefix.
  /// @throws std::invalid_argument naming settings that contradict each other
  [[nodiscard]] std::vector<ViewInfo> views() const;
  /// A graph of the method or the stage between the host's images.
  /// @param ports  formats of the images that are connected to a stage's other inputs; empty for a method
  /// @param wanted further outputs of a method, for debugging; no views
  /// @throws as `declare` does; also naming an unknown port, or conventions that a stage does not accept
  [[nodiscard]] ListedGraph list(std::span<const WalrPortFormat> ports, const InspectionWish& wanted) const;
  /// Conventions of a light.
  [[nodiscard]] InputConventions inputConventions(std::size_t light = 0) const;

  /// Constants of the next frame.
  /// @throws Error, or std::invalid_argument, naming what is invalid
  [[nodiscard]] Constants constants(const FrameStatement& frame) const;
  /// Take over camera, size and frame number of the frame that was recorded last with another description.
  void continueFrom(const Description& last);
  /// Note that a frame was recorded.
  void advance(const FrameStatement& frame);

  /// Change a setting of all lights, or of one alone, whose `LightNames::settings` the name begins with.
  /// @throws as `Configurable::set` does
  void set(std::string_view name, std::string_view value);
  /// Value of a setting of the first light, or of the one that the name begins with.
  /// @throws Error naming an unknown setting
  [[nodiscard]] std::string setting(std::string_view name) const;
  /// Use a preset for all lights, or for one alone.
  /// @throws std::invalid_argument naming the unknown preset and the known ones
  void usePreset(std::string_view name);
  /// Number of lights; 0 for a stage.
  [[nodiscard]] std::size_t lightCount() const { return methods_.size(); }
  /// Kinds of the lights that there are.
  [[nodiscard]] const std::vector<WalrLightKind>& lightKinds() const { return lightKinds_; }
  [[nodiscard]] bool hasSpecularLight() const { return std::ranges::count(lightKinds_, WALR_LIGHT_SPECULAR) > 0; }
  /// Name of the method or the stage.
  [[nodiscard]] const std::string& methodName() const { return methodName_; }
  [[nodiscard]] fg::Extent extent() const { return extent_; }
  /// Whether only a rectangle of the images is denoised.
  [[nodiscard]] bool rectangle() const { return conventions_.rectangle == VK_TRUE; }
  [[nodiscard]] bool orthographic() const { return conventions_.orthographic == VK_TRUE; }
  /// Format of the result's image.
  [[nodiscard]] VkFormat resultFormat() const { return resultFormat_; }
  [[nodiscard]] std::uint32_t slots() const { return slots_; }
  /// Frames recorded so far.
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// Slot (among the frames in flight) of the next frame.
  [[nodiscard]] std::uint32_t slot() const { return static_cast<std::uint32_t>(frames_ % slots_); }

 private:
  /// What a name of a setting or preset is about.
  struct Named {
    std::span<const std::unique_ptr<Denoiser>> lights;  ///< One, or all; none for a stage.
    LightKinds kinds;                                   ///< Of these.
    std::string_view name;                              ///< Without `LightNames::settings` before it.
  };
  [[nodiscard]] Named named(std::string_view name) const;
  [[nodiscard]] ListedGraph listStage(std::span<const WalrPortFormat> ports) const;
  [[nodiscard]] HostConventions hostConventions() const;
  [[nodiscard]] glm::ivec2 checkedOffset(glm::uvec2 offset) const;
  [[nodiscard]] glm::ivec2 checkedLightOffset(glm::uvec2 offset) const;

  std::string methodName_;
  std::vector<WalrLightKind> lightKinds_;           ///< Of each light; also of that of a stage.
  std::unique_ptr<PassNode> stage_;                 ///< Null for methods.
  std::vector<std::unique_ptr<Denoiser>> methods_;  ///< That of each light; none for a stage.
  fg::Extent extent_;
  WalrConventions conventions_;
  std::array<VkFormat, std::tuple_size_v<decltype(kHostInputs)>> formats_;
  VkFormat resultFormat_;
  bool historyLength_;
  bool lightDirection_;
  bool expectedError_;
  std::uint32_t slots_;
  std::uint64_t frames_ = 0;
  std::optional<WalrCamera> lastCamera_;
  glm::dvec3 lastOrigin_{0.0};  ///< Of `lastCamera_`.
  glm::uvec2 lastLightOffset_{0};
  std::optional<fg::Extent> lastExtent_;
};

/// @throws Error with the diagnostics if the graph does not compile
fg::Plan compilePlan(const fg::Graph& graph, const fg::MemoryModel& memory, const fg::CompileOptions& options = {});

}  // namespace walr::api
