#include "samples/host/tracer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

#include <glm/geometric.hpp>

#include "samples/denoise/frame_output.h"
#include "samples/image/exposure.h"
#include "samples/render/animation.h"
#include "samples/render/default_view.h"
#include "samples/render/load_scene.h"
#include "samples/render/scene_error.h"
#include "samples/render/sequence_frame.h"
#include "samples/render/view.h"
#include "samples/sequence/sequence.h"

namespace walr::host {
namespace {

bool sameCamera(const render::View& a, const render::View& b) {
  return a.viewFromWorld == b.viewFromWorld && a.jitter == b.jitter && a.width == b.width && a.height == b.height;
}

glm::vec4 sphereAround(const render::Box& box) {
  return {0.5F * (box.low + box.high), 0.5F * glm::distance(box.low, box.high)};
}

/// Adds the direct light to the indirect light and sets the direct light to 0.
void moveDirect(Image& direct, Image& indirect) {
  std::ranges::transform(indirect.values(), direct.values(), indirect.values().begin(), std::plus<>());
  std::ranges::fill(direct.values(), 0.0F);
}

}  // namespace

Tracer::Content::Content(const Options& options, bool onDevice)
    : scene(render::loadScene(options.scene, options.sky)),
      camera(render::findCamera(scene, options.camera)),
      world(scene, onDevice ? render::RayCasting::None : render::RayCasting::Embree),
      bounds(sphereAround(render::boundingBox(scene, world.nodes()))) {
  scene.specular = options.specular;
}

void Tracer::Content::prepare(const GpuDevice& gpu) {
  device = std::make_unique<gpu_render::GpuScene>(gpu, world);
  device->prepare(gpu_render::Precision::Half);
}

Tracer::Tracer(const Options& options, const GpuDevice* gpu)
    : options_(options), gpu_(gpu), content_(std::make_unique<Content>(options, gpu != nullptr)) {
  if (gpu_ != nullptr) content_->prepare(*gpu_);
}

std::unique_ptr<Tracer::Content> Tracer::read(const std::filesystem::path& file) const {
  Options options = options_;
  options.scene = file;
  options.camera.clear();
  auto content = std::make_unique<Content>(options, gpu_ != nullptr);
  content->exposure = exposureOf(*content, 0.0);
  return content;
}

void Tracer::show(std::unique_ptr<Content> content) {
  if (gpu_ != nullptr) content->prepare(*gpu_);
  content_ = std::move(content);
  previous_.reset();
  reference_ = {};
}

glm::mat4 Tracer::sceneCamera(double animationFrame) const {
  const std::vector<glm::mat4> nodes =
      render::worldTransforms(content_->scene, animationFrame / options_.framesPerSecond);
  return render::viewFromNode(nodes[content_->camera], content_->scene.nodes[content_->camera].name);
}

int Tracer::lastAnimationFrame() const {
  float last = 0.0F;
  for (const render::AnimationChannel& channel : content_->scene.animation) {
    last = std::max(last, channel.times.back());
  }
  // Rounded, because times in float fall short of their frames: float(95 / 24.0) * 24 is less than 95.
  return static_cast<int>(std::lround(std::clamp(last * options_.framesPerSecond, 0.0, double{FrameRange::kMost})));
}

float Tracer::exposure(double animationFrame) {
  if (animationFrame == 0.0 && content_->exposure) return *content_->exposure;
  return exposureOf(*content_, animationFrame);
}

float Tracer::exposureOf(Content& content, double animationFrame) const {
  // Noise lowers the mean of logarithms, so few pixels with many samples are better than the reverse.
  constexpr std::uint32_t kRows = 36;
  constexpr std::uint32_t kSamples = 64;
  const double seconds = animationFrame / options_.framesPerSecond;
  // If a device traces, the processor cannot cast rays in `Content::world`.
  std::optional<render::World> forProcessor;
  render::World& world = gpu_ != nullptr ? forProcessor.emplace(content.scene) : content.world;
  world.moveTo(seconds, seconds);
  const std::uint32_t columns = std::max(1U, kRows * options_.extent.width / options_.extent.height);
  const render::View view = render::viewFrom(world, content.camera, columns, kRows, {}, {});
  const Frame frame = render::toFrame(
      render::renderFilm(world, view, {.samples = kSamples, .bounces = options_.bounces, .threads = options_.threads}),
      view, 0);
  Image lit = composite(frame.indirect, frame.direct, frame.albedo, frame.emission);
  for (std::size_t i = 0; i < frame.specular.values().size(); ++i) {
    lit.values()[i] += frame.specular.values()[i] * frame.specularAlbedo.values()[i];
  }
  return autoExposure(lit).value_or(0.0F);
}

render::View Tracer::viewOf(const Request& request) const {
  const auto jitter = [&](int frame) { return options_.jitter ? render::haltonJitter(frame) : glm::vec2(0.0F); };
  const Request& before = previous_ ? *previous_ : request;
  render::View view = render::viewFrom(content_->world, content_->camera, options_.extent.width, options_.extent.height,
                                       jitter(request.number), jitter(before.number));
  view.width = extentOf(request).width;
  view.height = extentOf(request).height;
  if (request.view) {
    view.viewFromWorld = *request.view;
  }
  view.previousViewFromWorld = previous_ ? previousView_ : view.viewFromWorld;
  return view;
}

glm::ivec2 Tracer::lightOffset(const Request& request) const {
  return lightOffsetOfFrame(options_.light, static_cast<std::uint32_t>(request.number));
}

std::string Tracer::whyNotResampled() const {
  if (content_->device) return "the path tracer on the GPU does not resample: use --tracer cpu";
  if (options_.specular) return "only diffuse light can be resampled: leave out --specular";
  if (!options_.light.everyPixel()) return "only light at every pixel can be resampled: use --light-rate 1";
  return {};
}

render::Reservoirs* Tracer::reservoirsFor(const Request& request) {
  if (request.resampledFrames == 0) {
    reservoirs_.reset();
    return nullptr;
  }
  const std::string reason = whyNotResampled();
  if (!reason.empty()) throw std::invalid_argument(reason);
  const bool goesOn = previous_ && !request.cut && !request.resetHistory &&
                      previous_->resampledFrames == request.resampledFrames &&
                      extentOf(*previous_) == extentOf(request);
  if (!goesOn) {
    const fg::Extent extent = extentOf(request);
    reservoirs_.emplace(extent.width, extent.height, static_cast<float>(request.resampledFrames));
  }
  return &*reservoirs_;
}

render::View Tracer::moveTo(const Request& request) {
  const double before = previous_ ? previous_->animationFrame : request.animationFrame;
  content_->world.moveTo(request.animationFrame / options_.framesPerSecond, before / options_.framesPerSecond);
  return viewOf(request);
}

render::SamplingSettings Tracer::samplingOf(const Request& request) {
  render::SamplingSettings sampling;
  sampling.samples = options_.samples;
  sampling.bounces = options_.bounces;
  sampling.gbuffer = options_.gbuffer;
  sampling.sampler = options_.samples == 1 ? render::Sampler::Kind::BlueNoise : render::Sampler::Kind::Sobol;
  sampling.seed = options_.seed * 2;
  sampling.firstSample = static_cast<std::uint32_t>(request.number) * options_.samples;
  sampling.threads = options_.threads;
  sampling.light = options_.light;
  sampling.lightOffset = lightOffset(request);
  sampling.reservoirs = reservoirsFor(request);
  return sampling;
}

void Tracer::finish(const Request& request, const render::View& view, Frame& frame) {
  frame.light = options_.light;
  frame.lightOffset = lightOffset(request);
  frame.previousLightOffset = previous_ ? lightOffset(*previous_) : frame.lightOffset;
  if (previous_ && extentOf(*previous_) != extentOf(request)) {
    frame.previousSize = glm::ivec2(extentOf(*previous_).width, extentOf(*previous_).height);
  }
  frame.camera.cut = request.cut;
  frame.resetHistory = request.cut || request.resetHistory || !previous_;
  previous_ = request;
  previousView_ = view.viewFromWorld;
}

HostFrame Tracer::hostFrame(const Request& request) {
  if (!content_->device) {
    HostFrame frame = packHostFrame(trace(request));
    frame.traced = traced_;
    return frame;
  }
  const render::View view = moveTo(request);
  gpu_render::TraceData data{gpu_render::sceneState(content_->world), content_->device->placements(content_->world),
                             gpu_render::traceConstants(content_->world, view, samplingOf(request))};
  if (options_.denoiseDirect) data.constants.flags |= gpu_render::kDirectInIndirect;
  Frame frame = render::frameOfView(view, request.number);
  finish(request, view, frame);
  return hostFrameToTrace(std::move(frame), std::move(data));
}

render::Film Tracer::renderFilm(const render::View& view, const render::SamplingSettings& sampling) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  render::Film film = render::renderFilm(content_->world, view, sampling);
  traced_ += {film.rays, std::chrono::duration<double>(Clock::now() - start).count()};
  return film;
}

Frame Tracer::trace(const Request& request) {
  traced_ = {};
  const render::View view = moveTo(request);
  Frame frame = render::toFrame(renderFilm(view, samplingOf(request)), view, request.number);
  if (request.reference) {
    frame.reference = traceReference(request, view);
  }
  if (options_.denoiseDirect) {
    moveDirect(frame.direct, frame.indirect);
    if (frame.reference) {
      moveDirect(frame.reference->direct, frame.reference->indirect);
    }
  }
  finish(request, view, frame);
  return frame;
}

Reference Tracer::traceReference(const Request& request, const render::View& view) {
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  const bool same =
      reference_.steps > 0 && reference_.animationFrame == request.animationFrame && sameCamera(reference_.view, view);
  if (!same) {
    reference_ = {request.animationFrame, view, std::vector<glm::dvec3>(pixels), std::vector<glm::dvec3>(pixels),
                  std::vector<glm::dvec3>(options_.specular ? pixels : 0)};
  }
  render::SamplingSettings sampling;
  sampling.samples = options_.referenceSamples;
  sampling.bounces = options_.bounces;
  sampling.gbuffer = options_.gbuffer;
  // The lowest bit of the seed keeps the reference's random numbers apart from those of the noisy frames.
  sampling.seed = options_.seed * 2 + 1;
  sampling.firstSample = reference_.steps * options_.referenceSamples;
  sampling.threads = options_.threads;
  render::Film film = renderFilm(view, sampling);
  ++reference_.steps;
  const auto accumulate = [&](glm::dvec3& sum, glm::vec3& light) {
    sum += glm::dvec3(light);
    light = glm::vec3(sum / static_cast<double>(reference_.steps));
  };
  for (std::size_t i = 0; i < pixels; ++i) {
    accumulate(reference_.indirect[i], film.indirect[i]);
    accumulate(reference_.direct[i], film.direct[i]);
    if (options_.specular) accumulate(reference_.specular[i], film.specular[i].light);
  }
  return render::toReference(film);
}

}  // namespace walr::host
