#include "samples/gpu_report/timed_content.h"

#include <span>

#include "samples/bench/response_scene.h"
#include "samples/errors.h"
#include "samples/gpu_report/built_in_scene.h"
#include "samples/image/file_output.h"
#include "samples/render/film.h"
#include "samples/render/load_scene.h"
#include "samples/render/sequence_frame.h"

namespace walr {
namespace {

constexpr int kFirstFrame = 8;
constexpr double kFramesPerSecond = 24.0;

/// Drops what the device does not need: at 4K, it is more than a gigabyte.
PackedFrame slim(PackedFrame packed) {
  Frame& frame = packed.frame;
  for (Image* image : {&frame.indirect, &frame.direct, &frame.albedo, &frame.normal, &frame.motion, &frame.emission,
                       &frame.objectId}) {
    *image = Image();
  }
  frame.reference.reset();
  packed.objectId.clear();
  frame.resetHistory = false;
  return packed;
}

std::filesystem::path writeScene(const std::filesystem::path& folder) {
  std::filesystem::path file = folder / "turntable.gltf";
  writeFileAtomically(file, std::as_bytes(std::span(kTurntable)));
  return file;
}

}  // namespace

TimedContent syntheticContent(fg::Extent extent) {
  return {.name = "synthetic",
          .description = "a wall and a slab that moves in front of it",
          .extent = extent,
          .layout = &projectLayout(),
          .frames = {slim(slabFrame(extent, kFirstFrame).packed), slim(slabFrame(extent, kFirstFrame + 1).packed)}};
}

void requireTwoFrames(const Sequence& sequence, const std::string& name) {
  if (sequence.entries().size() < 2) throw InputError(name + ": times need two frames at least");
}

TimedContent sequenceContent(const Sequence& sequence, const std::string& name) {
  requireTwoFrames(sequence, name);
  const std::size_t count = sequence.entries().size();
  const std::size_t first = count / 2 - 1;
  return {.name = "sequence",
          .description = name + ", frames " + std::to_string(sequence.entries()[first].number) + " and " +
                         std::to_string(sequence.entries()[first + 1].number),
          .extent = sequence.extent(),
          .layout = &sequence.denoiserLayout(),
          .frames = {slim(packFrame(sequence.read(first))), slim(packFrame(sequence.read(first + 1)))}};
}

BuiltInScene::BuiltInScene(const std::filesystem::path& folder)
    : scene_(render::loadScene(writeScene(folder))), camera_(render::findCamera(scene_, {})), world_(scene_) {}

render::View BuiltInScene::viewAt(fg::Extent extent, int number) {
  world_.moveTo(number / kFramesPerSecond, (number - 1) / kFramesPerSecond);
  return render::viewFrom(world_, camera_, extent.width, extent.height, render::haltonJitter(number),
                          render::haltonJitter(number - 1));
}

Image BuiltInScene::truth(fg::Extent extent, int number, std::uint32_t samples) {
  const render::View view = viewAt(extent, number);
  render::SamplingSettings sampling;
  sampling.samples = samples;
  sampling.seed = 1;  // That of the noisy frames is 0.
  return render::toReference(render::renderFilm(world_, view, sampling)).indirect;
}

PackedFrame BuiltInScene::frame(fg::Extent extent, int number) {
  const render::View view = viewAt(extent, number);
  render::SamplingSettings sampling;
  sampling.sampler = render::Sampler::Kind::BlueNoise;
  sampling.firstSample = static_cast<std::uint32_t>(number);
  return packFrame(render::toFrame(render::renderFilm(world_, view, sampling), view, number));
}

TimedContent BuiltInScene::content(fg::Extent extent) {
  return {.name = "scene",
          .description = "the built-in scene turntable, one path per pixel",
          .extent = extent,
          .layout = &projectLayout(),
          .frames = {slim(frame(extent, kFirstFrame)), slim(frame(extent, kFirstFrame + 1))}};
}

}  // namespace walr
