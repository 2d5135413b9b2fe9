// What the path tracer on the GPU refuses, and what a frame of it needs.
#include <gtest/gtest.h>

#include "framegraph/vulkan/error.h"
#include "samples/gpu_render/film_tracer.h"
#include "samples/render/load_scene.h"
#include "samples/render/scene_error.h"
#include "tests/error_text.h"
#include "tests/gpu_render/tracing_fixture.h"

namespace walr::gpu_render::test {
namespace {

render::Scene box() {
  return render::loadScene(WALR_SCENES "/box.gltf", {});
}

}  // namespace

TEST(GpuScene, NamesWhatADeviceLacks) {
  const GpuDevice without({.device = {}, .validation = true});  // Its ray queries, if it has them, are not enabled.
  const render::Scene scene = box();
  const render::World world(scene, render::RayCasting::None);
  fg::test::expectError<fg::vk::Unsupported>([&] { GpuScene(without, world); },
                                             {without.name(), "ray queries", "--tracer cpu"});
}

using GpuScenes = TracingTest;

TEST_F(GpuScenes, RefuseWhatTheyDoNotHave) {
  const render::Scene scene = box();
  const render::World world(scene, render::RayCasting::None);
  const render::View view = render::viewFrom(world, render::findCamera(scene, {}), 16, 9, {}, {});
  FilmTracer tracer(gpu, world);
  render::SamplingSettings settings;
  render::Reservoirs reservoirs(16, 9, 20.0F);
  settings.reservoirs = &reservoirs;
  EXPECT_THROW(tracer.film(view, settings), render::SceneError);
  settings.reservoirs = nullptr;
  EXPECT_EQ(tracer.film(view, settings).direct.size(), 16U * 9U);
}

// The image may change its size, and reports of progress add up to all pixels.
TEST_F(GpuScenes, RenderAnySizeAndReportProgress) {
  const render::Scene scene = box();
  const render::World world(scene, render::RayCasting::None);
  FilmTracer tracer(gpu, world);
  for (const fg::Extent extent : {fg::Extent{17, 9}, fg::Extent{1, 1}, fg::Extent{20, 23}}) {
    const render::View view =
        render::viewFrom(world, render::findCamera(scene, {}), extent.width, extent.height, {}, {});
    std::uint64_t reported = 0;
    render::SamplingSettings settings;
    settings.samples = 66;  // More than one dispatch.
    settings.pixelsDone = [&](std::uint64_t count) { reported += count; };
    const std::uint64_t pixels = std::uint64_t{extent.width} * extent.height;
    const render::Film film = tracer.film(view, settings);
    EXPECT_EQ(film.gbuffer.size(), pixels);
    EXPECT_EQ(reported, pixels);
    EXPECT_GT(film.rays, 66 * pixels);
    reported = 0;
    std::uint64_t rays = 0;
    settings.samples = 132;
    tracer.reference(view, settings, {}, rays);
    EXPECT_EQ(reported, pixels);
  }
}

}  // namespace walr::gpu_render::test
