// The frames that `walr render --tracer gpu` writes pass the linter of inputs.
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/gpu_render/tracing_fixture.h"
#include "tests/samples/process.h"
#include "tests/samples/temporary_directory.h"
#include "tests/shared_data.h"

namespace walr::gpu_render::test {
namespace {

// Frames of a scene in which its camera or its objects move, of a size at which they take seconds on a software driver.
struct Case {
  const char* scene;
  const char* frames;
  const char* size;
  const char* lightRate = "1";
};

void PrintTo(const Case& rendered, std::ostream* out) {
  *out << rendered.scene << ", frames " << rendered.frames << ", " << rendered.size << ", light rate "
       << rendered.lightRate;
}

void expectThatFramesPass(const std::filesystem::path& folderOfScenes, const Case& rendered) {
  const walr::test::TemporaryDirectory folder;
  walr::test::expectSuccess(
      walr::test::runProcess({WALR_PROGRAM, "render", (folderOfScenes / rendered.scene).string(), "--tracer", "gpu",
                              "--output", folder.path().string(), "--frames", rendered.frames, "--light-rate",
                              rendered.lightRate, "--size", rendered.size, "--jitter", "--validate"}));
  walr::test::expectSuccess(walr::test::runProcess({WALR_PROGRAM, "lint", folder.path().string()}));
}

class TracedFrames : public TracingTest, public testing::WithParamInterface<Case> {};

TEST_P(TracedFrames, PassTheLinter) {
  expectThatFramesPass(WALR_SCENES, GetParam());
}

using SharedDataTracedFrames = TracingTest;

TEST_F(SharedDataTracedFrames, PassTheLinter) {
  const walr::test::SharedData scenes("scenes");
  if (!scenes) GTEST_SKIP() << scenes.whyNot();
  expectThatFramesPass(scenes.path(), {"sponza.glb", "12-14", "96x54"});
}

INSTANTIATE_TEST_SUITE_P(Scenes, TracedFrames,
                         testing::Values(Case{"box.gltf", "12-14", "192x108"},
                                         Case{"turntable.gltf", "11-14", "192x108", "1/4"},
                                         Case{"kitchen.gltf", "20-22", "192x108"},
                                         Case{"stair.gltf", "28-30", "192x108"},
                                         Case{"garden.gltf", "12-14", "192x108"}),
                         [](const auto& test) {
                           const std::string name = test.param.scene;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace walr::gpu_render::test
