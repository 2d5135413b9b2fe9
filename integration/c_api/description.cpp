#include "integration/c_api/description.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <utility>

#include <glm/gtc/type_ptr.hpp>

#include "framegraph/declare/format.h"
#include "integration/c_api/structs.h"
#include "integration/setting_info.h"

namespace walr::api {
namespace {

constexpr std::uint32_t kLargestExtent = 16384;
constexpr std::uint32_t kMostFramesInFlight = 16;
constexpr std::uint32_t kUsualFramesInFlight = 2;

WalrConventions checkedConventions(const WalrConventions* given) {
  WalrConventions conventions = readOptional(given, "WalrConventions");
  checkedEnum(conventions.normal_space, WALR_SPACE_WORLD, "WalrConventions::normal_space");
  checkedEnum(conventions.motion_unit, WALR_MOTION_PICTURES, "WalrConventions::motion_unit");
  checkedEnum(conventions.motion_depth, WALR_MOTION_DEPTH_FOUND, "WalrConventions::motion_depth");
  checkedEnum(conventions.depth, WALR_DEPTH_DEVICE, "WalrConventions::depth");
  checkedEnum(conventions.normals, WALR_NORMALS_OCTAHEDRAL_UNSIGNED, "WalrConventions::normals");
  checkSwitch(conventions.pre_exposed, "WalrConventions::pre_exposed");
  checkSwitch(conventions.motion_jittered, "WalrConventions::motion_jittered");
  checkSwitch(conventions.rectangle, "WalrConventions::rectangle");
  checkSwitch(conventions.orthographic, "WalrConventions::orthographic");
  checkSwitch(conventions.light_masked, "WalrConventions::light_masked");
  checkSwitch(conventions.light_counted, "WalrConventions::light_counted");
  for (float& scale : conventions.motion_scale) {
    if (!std::isfinite(scale)) {
      throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrConventions::motion_scale is not finite");
    }
    if (scale == 0.0F) scale = 1.0F;
  }
  for (std::uint32_t& side : conventions.light_group) {
    if (side > kMostPerLightTexel) {
      throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrConventions::light_group is " + std::to_string(side) +
                                                   " pixels wide or high: it must be at most " +
                                                   std::to_string(kMostPerLightTexel));
    }
    side = std::max(side, 1U);
  }
  return conventions;
}

void checkSwitches(const WalrDenoiserInfo& info) {
  checkSwitch(info.timestamps, "WalrDenoiserInfo::timestamps");
  checkSwitch(info.lint, "WalrDenoiserInfo::lint");
  checkSwitch(info.counters, "WalrDenoiserInfo::counters");
  checkSwitch(info.history_length, "WalrDenoiserInfo::history_length");
  checkSwitch(info.light_direction, "WalrDenoiserInfo::light_direction");
  checkSwitch(info.expected_error, "WalrDenoiserInfo::expected_error");
}

VkFormat checkedResultFormat(VkFormat format) {
  if (format == VK_FORMAT_UNDEFINED) return kResultFormats.front();
  std::string known;
  for (const VkFormat each : kResultFormats) {
    if (format == each) return format;
    known.append(known.empty() ? "" : " or ").append(fg::formatInfo(each).name);
  }
  throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrDenoiserInfo::denoised_format is " +
                                               std::string(fg::formatInfo(format).name) + " (" +
                                               std::to_string(format) + "): it must be " + known);
}

fg::Extent checkedExtent(std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0 || width > kLargestExtent || height > kLargestExtent) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "an image size of " + std::to_string(width) + " x " +
                                                 std::to_string(height) + " pixels: both must be 1 to " +
                                                 std::to_string(kLargestExtent));
  }
  return {width, height};
}

std::uint32_t checkedSlots(std::uint32_t framesInFlight) {
  if (framesInFlight <= kMostFramesInFlight) return framesInFlight == 0 ? kUsualFramesInFlight : framesInFlight;
  throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrDenoiserInfo::frames_in_flight is " + std::to_string(framesInFlight) +
                                               ": it must be at most " + std::to_string(kMostFramesInFlight));
}

/// Null for a whole method.
/// @throws std::invalid_argument naming all methods and stages if it is neither
std::unique_ptr<PassNode> stageNamed(std::string_view name) {
  const auto found = std::ranges::find(passTypes(), name, &PassType::name);
  return found != passTypes().end() && found->composition ? nullptr : makePass(name);
}

/// Where a host says the preset of each light; that of the first counts for all that have none.
constexpr std::array<const char * WalrDenoiserInfo::*, kMostLights> kPresets{&WalrDenoiserInfo::preset,
                                                                             &WalrDenoiserInfo::second_preset};
/// And the kind of each light.
constexpr std::array<WalrLightKind WalrDenoiserInfo::*, kMostLights> kLightKinds{&WalrDenoiserInfo::light_kind,
                                                                                 &WalrDenoiserInfo::second_light_kind};

/// The kinds of all lights.
/// @throws Error saying why there cannot be as many lights, or that a light is of no kind
std::vector<WalrLightKind> checkedLights(const WalrDenoiserInfo& info) {
  const std::size_t count = std::max<std::size_t>(info.light_count, 1);
  if (count > kMostLights) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrDenoiserInfo::light_count is " + std::to_string(count) +
                                                 ": lights share guides " + std::to_string(kMostLights) +
                                                 " at a time; make a further denoiser, see "
                                                 "WalrDenoiserInfo::shared_with");
  }
  for (std::size_t i = count; i < kMostLights; ++i) {
    const bool preset = info.*kPresets.at(i) != nullptr;
    if (!preset && info.*kLightKinds.at(i) == WALR_LIGHT_DIFFUSE) continue;
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "WalrDenoiserInfo::" + std::string(kLightNames.at(i).images) + (preset ? "preset" : "light_kind") +
                    " is given, but there are fewer lights: set light_count to " + std::to_string(i + 1));
  }
  std::vector<WalrLightKind> kinds;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "WalrDenoiserInfo::" + std::string(kLightNames.at(i).images) + "light_kind";
    kinds.push_back(checkedEnum(info.*kLightKinds.at(i), WALR_LIGHT_SPECULAR, name.c_str()));
  }
  const bool formats = info.specular_albedo_format != VK_FORMAT_UNDEFINED ||
                       info.roughness_format != VK_FORMAT_UNDEFINED ||
                       info.specular_motion_format != VK_FORMAT_UNDEFINED;
  if (formats && std::ranges::count(kinds, WALR_LIGHT_SPECULAR) == 0) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "WalrDenoiserInfo::specular_albedo_format, roughness_format or specular_motion_format is given, but no "
                "light is specular: set light_kind or second_light_kind to WALR_LIGHT_SPECULAR");
  }
  return kinds;
}

/// A method for each light; none for a stage.
std::vector<std::unique_ptr<Denoiser>> makeMethods(std::span<const WalrLightKind> lights, const std::string& name,
                                                   bool stage) {
  if (stage && lights.size() == 1) return {};
  if (stage) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "stage '" + name +
                                                 "' has one light: set WalrDenoiserInfo::light_count "
                                                 "for a whole method");
  }
  std::vector<std::unique_ptr<Denoiser>> methods;
  for (std::size_t i = 0; i < lights.size(); ++i) methods.push_back(makeDenoiser(name));
  const bool shares =
      std::ranges::any_of(lights, [&](WalrLightKind kind) { return std::ranges::count(lights, kind) > 1; });
  if (shares && !methods.front()->sharesGuides()) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "method '" + name +
                    "' has no guides that lights could share: leave "
                    "WalrDenoiserInfo::light_count at 1 and make a denoiser for each light");
  }
  return methods;
}

/// The same text at a place that lasts as long as the library is loaded.
std::string_view lasting(const std::string& text) {
  static std::mutex mutex;
  static std::set<std::string> texts;
  const std::lock_guard lock(mutex);
  return *texts.insert(text).first;
}

VkFormat formatOr(VkFormat format, std::size_t input) {
  const bool usual = format == VK_FORMAT_UNDEFINED && !kHostInputs.at(input).optional;
  return usual ? kHostInputs.at(input).format : format;
}

void requireFinite(std::span<const float> values, const char* what) {
  if (std::ranges::all_of(values, [](float value) { return std::isfinite(value); })) return;
  throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string(what) + " is not finite");
}

const WalrCamera& checkedCamera(const WalrCamera& camera) {
  requireFinite(camera.view, "WalrCamera::view");
  requireFinite(camera.projection, "WalrCamera::projection");
  requireFinite(camera.jitter, "WalrCamera::jitter");
  return camera;
}

}  // namespace

Description::Description(const WalrDenoiserInfo& info, Of of)
    : methodName_(info.method == nullptr ? "walr" : info.method),
      lightKinds_(checkedLights(info)),
      stage_(of == Of::MethodsAndStages ? stageNamed(methodName_) : nullptr),
      methods_(makeMethods(lightKinds_, methodName_, stage_ != nullptr)),
      extent_(checkedExtent(info.width, info.height)),
      conventions_(checkedConventions(info.conventions)),
      formats_{formatOr(info.lighting_format, 0),   formatOr(info.depth_format, 1),
               formatOr(info.normal_format, 2),     formatOr(info.motion_format, 3),
               formatOr(info.albedo_format, 4),     formatOr(info.object_id_format, 5),
               formatOr(info.confidence_format, 6), formatOr(info.specular_albedo_format, 7),
               formatOr(info.roughness_format, 8),  formatOr(info.specular_motion_format, 9)},
      resultFormat_(checkedResultFormat(info.denoised_format)),
      historyLength_(info.history_length == VK_TRUE),
      lightDirection_(info.light_direction == VK_TRUE),
      expectedError_(info.expected_error == VK_TRUE),
      slots_(checkedSlots(info.frames_in_flight)) {
  checkSwitches(info);
  if (info.preset != nullptr) usePreset(info.preset);
  for (std::size_t i = 1; i < methods_.size(); ++i) {
    if (const char* own = info.*kPresets.at(i); own != nullptr) methods_[i]->usePreset(own);
  }
  for (std::size_t i = 0; i < lightKinds_.size(); ++i) {
    const InputConventions conventions = inputConventions(i);
    if (!methods_.empty()) methods_[i]->requireLight(conventions);
    checkOrthographic(conventions, hostConventions(), info.lint == VK_TRUE);
    // Refuse wrong formats here and not when the first frame is recorded.
    fg::Graph scratch;
    (void)importInputs(scratch, extent_, conventions, kInnerStates.inputs, formats_, hostConventions());
  }
}

void Description::resize(std::uint32_t width, std::uint32_t height) {
  extent_ = checkedExtent(width, height);
}

std::vector<ViewInfo> Description::views() const {
  std::vector<ViewInfo> all;
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    for (ViewInfo& view : methods_[i]->views(inputConventions(i))) {
      view.name = lasting(std::string(kLightNames.at(i).settings).append(view.name));
      all.push_back(std::move(view));
    }
  }
  return all;
}

DenoiseGraph Description::declare(const InspectionWish& wanted) const {
  InspectionWish all = wanted;
  all.historyLength = historyLength_;
  all.lightDirection = lightDirection_;
  all.expectedError = expectedError_;
  std::vector<DenoisedLight> lights;
  for (const std::unique_ptr<Denoiser>& method : methods_)
    lights.push_back({method.get(), lightKinds_[lights.size()] == WALR_LIGHT_SPECULAR});
  return declareDenoiseGraph(lights, extent_, inputConventions(), kInnerStates, formats_, hostConventions(), all);
}

ListedGraph Description::list(std::span<const WalrPortFormat> ports, const InspectionWish& wanted) const {
  if (stage_ != nullptr && (wanted.lint || wanted.counters)) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "stage '" + methodName_ +
                                                 "' cannot check inputs or count: set WalrDenoiserInfo::lint and "
                                                 "WalrDenoiserInfo::counters for a whole method");
  }
  if (stage_ != nullptr && (historyLength_ || lightDirection_ || expectedError_)) {
    const std::string output(historyLength_    ? kHistoryLengthName
                             : lightDirection_ ? kLightDirectionName
                                               : kExpectedErrorName);
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "stage '" + methodName_ + "' has no output '" + output +
                                                 "': set WalrDenoiserInfo::" + output + " for a whole method");
  }
  if (stage_ != nullptr) return listStage(ports);
  if (!ports.empty()) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "'" + methodName_ +
                                                 "' is a whole method: its images' formats are in WalrDenoiserInfo, "
                                                 "WalrPassesInfo::ports are those of a single stage");
  }
  DenoiseGraph declared = declare(wanted);
  return {.graph = std::move(declared.graph),
          .frame = declared.inputs.frame,
          .host = declared.host,
          .ports = {},
          .lint = declared.lint,
          .inspection = std::move(declared.inspection)};
}

ListedGraph Description::listStage(std::span<const WalrPortFormat> ports) const {
  if (hostConventions().differs() || !inputConventions().samples().everyPixel()) {
    throw Error(
        WALR_ERROR_INVALID_ARGUMENT,
        "stage '" + methodName_ +
            "' takes linear depth, signed normals, motion_depth as given, found or of a static scene, no pre-exposure, "
            "no rectangle, no orthographic camera, no sparse light, no specular light and no denoised_format: convert "
            "the images yourself, or use a whole method");
  }
  PortFormats formats;
  for (const Port& port : stage_->ports()) {
    const HostInput* input = port.output ? nullptr : hostInputNamed(port.name);
    if (input == nullptr) continue;
    const VkFormat format = formats_.at(static_cast<std::size_t>(input - kHostInputs.data()));
    if (format != VK_FORMAT_UNDEFINED) formats.emplace(port.name, format);
  }
  for (const WalrPortFormat& port : ports) {
    const std::string name(requireText(port.port, "WalrPortFormat::port"));
    if (formats.emplace(name, port.format).second) continue;
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "port '" + name + "' is named twice, or is an image whose format is in WalrDenoiserInfo");
  }
  stage_->setConventions(inputConventions());
  SingleStage declared = declareSingleStage(*stage_, extent_, kInnerStates, formats);
  return {.graph = std::move(declared.graph),
          .frame = declared.frame,
          .host = {},
          .ports = std::move(declared.ports),
          .lint = {},
          .inspection = {}};
}

Description::Named Description::named(std::string_view name) const {
  const OwnName own = withoutLight(name, methods_.size());
  const std::size_t first = own.light.value_or(0);
  const std::size_t count = own.light ? 1 : methods_.size();
  LightKinds kinds{false, false};
  for (const WalrLightKind kind : std::span(lightKinds_).subspan(first, count)) {
    (kind == WALR_LIGHT_SPECULAR ? kinds.specular : kinds.diffuse) = true;
  }
  return {std::span(methods_).subspan(first, count), kinds, own.name};
}

void Description::set(std::string_view name, std::string_view value) {
  if (stage_ != nullptr) return stage_->set(name, value);
  const Named target = named(name);
  target.lights.front()->requireEffect(target.name, target.kinds);
  for (const std::unique_ptr<Denoiser>& method : target.lights) method->set(target.name, value);
}

std::string Description::setting(std::string_view name) const {
  const Named target = named(name);
  Configurable& settings = stage_ != nullptr ? static_cast<Configurable&>(*stage_) : *target.lights.front();
  for (SettingDescription& setting : describeSettings(settings)) {
    if (setting.name == target.name) return std::move(setting.value);
  }
  throw Error(WALR_ERROR_INVALID_ARGUMENT,
              "method '" + methodName_ + "' has no setting \"" + std::string(target.name) + "\"");
}

void Description::usePreset(std::string_view name) {
  if (stage_ != nullptr) return stage_->usePreset(name);
  const Named target = named(name);
  for (const std::unique_ptr<Denoiser>& method : target.lights) method->usePreset(target.name);
}

HostConventions Description::hostConventions() const {
  return {.depth = static_cast<HostConventions::Depth>(conventions_.depth),
          .normal = static_cast<HostConventions::Normal>(conventions_.normals),
          .motionDepthReversed = conventions_.motion_depth == WALR_MOTION_DEPTH_REVERSED,
          .preExposed = conventions_.pre_exposed == VK_TRUE,
          .rectangle = conventions_.rectangle == VK_TRUE,
          .orthographic = conventions_.orthographic == VK_TRUE,
          .result = resultFormat_};
}

InputConventions Description::inputConventions(std::size_t light) const {
  using MotionDepth = InputConventions::MotionDepth;
  const WalrMotionDepth motionDepth = conventions_.motion_depth;
  return {.normal = conventions_.normal_space == WALR_SPACE_WORLD ? InputConventions::Space::World
                                                                  : InputConventions::Space::View,
          .motionDepth = motionDepth == WALR_MOTION_DEPTH_STATIC_SCENE ? MotionDepth::StaticScene
                         : motionDepth == WALR_MOTION_DEPTH_FOUND      ? MotionDepth::Found
                                                                       : MotionDepth::Given,
          .motionJittered = conventions_.motion_jittered == VK_TRUE,
          .specular = lightKinds_.at(light) == WALR_LIGHT_SPECULAR,
          .light = {.columns = conventions_.light_group[0],
                    .rows = conventions_.light_group[1],
                    .masked = conventions_.light_masked == VK_TRUE,
                    .counted = conventions_.light_counted == VK_TRUE}};
}

Constants Description::constants(const FrameStatement& frame) const {
  if (frame.camera == nullptr) throw Error(WALR_ERROR_INVALID_ARGUMENT, "the camera is null");
  const WalrCamera& now = checkedCamera(*frame.camera);
  const WalrCamera& previous = frame.previousCamera != nullptr ? checkedCamera(*frame.previousCamera)
                               : lastCamera_                   ? *lastCamera_
                                                               : now;
  glm::vec2 scale(conventions_.motion_scale[0], conventions_.motion_scale[1]);
  if (conventions_.motion_unit == WALR_MOTION_PICTURES) scale *= glm::vec2(extent_.width, extent_.height);
  FrameDescription description{.view = glm::make_mat4(now.view),
                               .previousView = glm::make_mat4(previous.view),
                               .projection = glm::make_mat4(now.projection),
                               .previousProjection = glm::make_mat4(previous.projection),
                               .jitter = glm::make_vec2(now.jitter),
                               .previousJitter = glm::make_vec2(previous.jitter),
                               .motionScale = scale,
                               .frameIndex = frame.index.value_or(static_cast<std::uint32_t>(frames_)),
                               .previousExtent = lastExtent_,
                               .origin = frame.origin,
                               .previousOrigin = frame.previousCamera != nullptr ? frame.previousOrigin
                                                 : lastCamera_                   ? lastOrigin_
                                                                                 : frame.origin,
                               .lightOffset = checkedLightOffset(frame.lightOffset),
                               .previousLightOffset = glm::ivec2(lastLightOffset_),
                               .orthographic = conventions_.orthographic == VK_TRUE};
  // Device depth is told from view depth by row z: [2][2] for an orthographic camera, [3][2] for a perspective one.
  const glm::mat4& projection = description.projection;
  const float scaled = conventions_.orthographic == VK_TRUE ? projection[2][2] : projection[3][2];
  if (conventions_.depth == WALR_DEPTH_DEVICE && scaled == 0.0F) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "row z of the projection gives every depth the same device depth: give the matrix with which the depth "
                "was rendered");
  }
  if (!(frame.skyDepth >= 0.0F)) throw Error(WALR_ERROR_INVALID_ARGUMENT, "sky_depth is negative or NaN");
  if (frame.skyDepth > 0.0F) description.skyDepth = frame.skyDepth;
  return {.camera = description,
          .frame = frameConstants(description, extent_),
          .host = hostConstants(glm::make_mat4(now.projection), frame.preExposure == 0.0F ? 1.0F : frame.preExposure,
                                checkedOffset(frame.offset))};
}

glm::ivec2 Description::checkedOffset(glm::uvec2 offset) const {
  if (offset == glm::uvec2(0)) return {};
  if (!rectangle()) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrFrame::offset is not zero: set WalrConventions::rectangle");
  }
  if (offset.x > kLargestExtent || offset.y > kLargestExtent) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "an offset of (" + std::to_string(offset.x) + ", " +
                                                 std::to_string(offset.y) + ") pixels: each must be at most " +
                                                 std::to_string(kLargestExtent));
  }
  return glm::ivec2(offset);
}

glm::ivec2 Description::checkedLightOffset(glm::uvec2 offset) const {
  const std::span<const std::uint32_t, 2> group = conventions_.light_group;
  if (offset.x < group[0] && offset.y < group[1]) return glm::ivec2(offset);
  throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrFrame::light_offset is (" + std::to_string(offset.x) + ", " +
                                               std::to_string(offset.y) +
                                               "): it must lie in WalrConventions::light_group, " +
                                               std::to_string(group[0]) + " x " + std::to_string(group[1]) + " pixels");
}

void Description::continueFrom(const Description& last) {
  lastCamera_ = last.lastCamera_;
  lastOrigin_ = last.lastOrigin_;
  lastLightOffset_ = last.lastLightOffset_;
  lastExtent_ = last.lastExtent_;
  frames_ = std::max(frames_, last.frames_);
}

void Description::advance(const FrameStatement& frame) {
  lastCamera_ = *frame.camera;
  lastOrigin_ = frame.origin;
  lastLightOffset_ = frame.lightOffset;
  lastExtent_ = extent_;
  ++frames_;
}

fg::Plan compilePlan(const fg::Graph& graph, const fg::MemoryModel& memory, const fg::CompileOptions& options) {
  fg::CompileResult result = fg::compile(graph.desc(), memory, options);
  if (!result.ok()) throw Error(WALR_ERROR_INTERNAL, "the method's frame graph does not compile:\n" + result.text());
  return std::move(result.plan);
}

}  // namespace walr::api
