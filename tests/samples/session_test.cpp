// What the user of the sample host does between frames: the camera, playback, and which changes need another graph. No
// device is needed.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "passes/methods/denoiser.h"
#include "samples/host/camera_control.h"
#include "samples/host/default_extent.h"
#include "samples/host/resolution_control.h"
#include "samples/host/scene_loader.h"
#include "samples/host/session.h"
#include "samples/host/setting_values.h"
#include "samples/host/tracer.h"
#include "tests/samples/temporary_directory.h"

namespace walr::host {
namespace {

float aheadOf(const glm::mat4& view, const glm::vec3& point) {
  return -(view * glm::vec4(point, 1.0F)).z;
}

TEST(FreeCamera, StartsWhereTheOtherStands) {
  const glm::mat4 view = glm::lookAt(glm::vec3(3.0F, 2.0F, -1.0F), glm::vec3(0.5F, -1.0F, 4.0F), glm::vec3(0, 1, 0));
  const FreeCamera camera(view, 2.0F);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      EXPECT_NEAR(camera.view()[column][row], view[column][row], 1e-5F);
    }
  }
  EXPECT_NEAR(aheadOf(view, camera.target()), 2.0F, 1e-5F);
}

TEST(FreeCamera, OrbitKeepsItsTargetInTheMiddle) {
  FreeCamera camera(glm::lookAt(glm::vec3(0, 1, 5), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0)), 5.0F);
  const glm::vec3 target = camera.target();
  camera.orbit({.turn = {0.7F, 0.4F}});
  EXPECT_LT(glm::distance(camera.target(), target), 1e-5F);
  EXPECT_NEAR(glm::distance(camera.position(), target), 5.0F, 1e-5F);
  EXPECT_GT(glm::distance(camera.position(), glm::vec3(0, 1, 5)), 1.0F);
  camera.orbit({.zoom = 1.0F});
  EXPECT_NEAR(glm::distance(camera.position(), target), 5.0F * 7.0F / 8.0F, 1e-5F);
  // The camera never turns upside down, however far it is turned.
  camera.orbit({.turn = {0.0F, 10.0F}});
  EXPECT_GT(glm::inverse(camera.view())[1].y, 0.0F);
}

TEST(FreeCamera, FliesAlongItsAxes) {
  FreeCamera camera(glm::mat4(1.0F), 1.0F);
  camera.fly({.move = {1.0F, 2.0F, 3.0F}});
  EXPECT_LT(glm::distance(camera.position(), glm::vec3(1.0F, 2.0F, -3.0F)), 1e-5F);
  constexpr float kQuarter = 1.5707963F;
  camera.fly({.turn = {kQuarter, 0.0F}, .move = {0.0F, 0.0F, 1.0F}});
  EXPECT_LT(glm::distance(camera.position(), glm::vec3(2.0F, 2.0F, -3.0F)), 1e-5F);
}

class SessionTest : public testing::Test {
 protected:
  Session make(const FrameRange& frames, bool once) {
    return Session(tracer, "walr", makeDenoiser("walr"), {}, {}, frames, once);
  }
  static Tracer::Options boxScene() {
    Tracer::Options options;
    options.scene = WALR_SCENES "/box.gltf";
    options.extent = {72, 40};
    return options;
  }
  Tracer tracer{boxScene()};
};

TEST_F(SessionTest, PlaysOnceOrAgain) {
  Session once = make({2, 4}, true);
  for (const int frame : {2, 3, 4}) {
    EXPECT_EQ(once.nextRequest()->animationFrame, frame);
  }
  EXPECT_FALSE(once.nextRequest().has_value());
  EXPECT_TRUE(once.frozen);
  EXPECT_EQ(once.nextRequest(true)->animationFrame, 4);
  Session loop = make({2, 3}, false);
  for (const int frame : {2, 3, 2, 3, 2}) {
    const Tracer::Request request = loop.nextRequest().value();
    EXPECT_EQ(request.animationFrame, frame);
    EXPECT_EQ(request.cut, frame == 2 && request.number > 2);
  }
}

TEST_F(SessionTest, PauseHoldsTheAnimationAndGoesOnSampling) {
  Session session = make({0, 9}, false);
  session.nextRequest();
  session.paused = true;
  const Tracer::Request first = session.nextRequest().value();
  const Tracer::Request second = session.nextRequest().value();
  EXPECT_EQ(first.animationFrame, 0.0);
  EXPECT_EQ(second.animationFrame, 0.0);
  EXPECT_NE(first.number, second.number);
}

TEST_F(SessionTest, AsksForResampledLightWhileThatIsOn) {
  Session session = make({0, 9}, false);
  EXPECT_EQ(session.nextRequest()->resampledFrames, 0U);
  session.resample = true;
  EXPECT_EQ(session.nextRequest()->resampledFrames, 20U);
  session.resampledFrames = 5;
  EXPECT_EQ(session.nextRequest()->resampledFrames, 5U);
  session.resample = false;
  EXPECT_EQ(session.nextRequest()->resampledFrames, 0U);
  EXPECT_EQ(session.takeGraphChange(), GraphChange::None);
}

TEST_F(SessionTest, CutsAndResetsAreAskedOnce) {
  Session session = make({0, 9}, false);
  session.nextRequest();
  session.cutCamera();
  const Tracer::Request cut = session.nextRequest().value();
  EXPECT_TRUE(cut.cut);
  EXPECT_EQ(cut.animationFrame, 6.0);
  session.resetHistory();
  const Tracer::Request reset = session.nextRequest().value();
  EXPECT_FALSE(reset.cut);
  EXPECT_TRUE(reset.resetHistory);
  EXPECT_FALSE(session.nextRequest()->resetHistory);
}

TEST_F(SessionTest, OnlyWhatChangesTheGraphAsksForAnother) {
  Session session = make({0, 9}, false);
  EXPECT_EQ(session.takeGraphChange(), GraphChange::None);
  session.chooseView({});
  EXPECT_EQ(session.takeGraphChange(), GraphChange::None);
  session.chooseView({HostView::Kind::Split});
  EXPECT_EQ(session.takeGraphChange(), GraphChange::Settings);
  EXPECT_EQ(session.takeGraphChange(), GraphChange::None);
  EXPECT_TRUE(session.nextRequest()->reference);
  session.chooseMethod("svgf");
  EXPECT_EQ(session.methodName(), "svgf");
  session.chooseView({});
  EXPECT_EQ(session.takeGraphChange(), GraphChange::Method);
  session.choosePreset("paper");
  EXPECT_EQ(session.takeGraphChange(), GraphChange::Method);
  session.settingsChanged();
  EXPECT_EQ(session.takeGraphChange(), GraphChange::Settings);
}

TEST_F(SessionTest, TellsThePresetInUse) {
  Session session = make({0, 9}, false);
  EXPECT_EQ(session.preset(), "standard");
  session.chooseMethod("walr_paper");
  EXPECT_EQ(session.preset(), "paper");
  session.choosePreset("robust");
  EXPECT_EQ(session.preset(), "robust");
  session.method().set("accumulation.max-history", "5");
  session.settingsChanged();
  EXPECT_EQ(session.preset(), std::nullopt);
  session.chooseMethod("svgf");
  EXPECT_EQ(session.preset(), "tuned");
  session.chooseMethod("none");
  EXPECT_EQ(session.preset(), std::nullopt);
}

TEST_F(SessionTest, RefusedChoicesGoBackToThoseLastAccepted) {
  Session session = make({0, 9}, false);
  session.chooseMethod("svgf");
  EXPECT_FALSE(session.refuse("of the first")) << "there is nothing to go back to";
  EXPECT_EQ(session.methodName(), "svgf");
  EXPECT_EQ(session.refusal(), "");
  session.method().set("accumulation.max-history", "5");
  session.settingsChanged();
  session.accept();
  EXPECT_FALSE(session.refuse("of nothing")) << "nothing has been chosen since";

  Denoiser* const accepted = &session.method();
  session.method().set("accumulation.max-history", "6");
  session.settingsChanged();
  session.chooseMethod("flr");
  session.chooseView({HostView::Kind::Compare, ""});
  session.compareWith("bmfr", makeDenoiser("bmfr"));
  EXPECT_TRUE(session.refuse("of two"));
  EXPECT_EQ(session.refusal(), "Not changed: of two");
  EXPECT_EQ(session.methodName(), "svgf");
  EXPECT_EQ(&session.method(), accepted);
  const auto settings = session.method().settings();
  EXPECT_EQ(std::ranges::find(settings, "accumulation.max-history", &SettingText::name)->value, "5");
  EXPECT_EQ(session.preset(), std::nullopt);
  EXPECT_EQ(session.view(), HostView{});
  EXPECT_EQ(session.comparedName(), "none");
  session.takeGraphChange();
  session.settingsChanged();
  EXPECT_EQ(session.takeGraphChange(), GraphChange::None) << "all values are those that were accepted";
  session.accept();
  EXPECT_NE(session.refusal(), "") << "nothing has been chosen since";
  session.choosePreset("paper");
  session.accept();
  EXPECT_EQ(session.refusal(), "");
}

TEST_F(SessionTest, EverySettingGoesBackToTheBit) {
  for (const std::string& name : denoiserNames()) {
    const std::unique_ptr<Denoiser> method = makeDenoiser(name);
    const std::vector<SettingText> defaults = method->settings();
    const SettingValues values(*method);
    // A third is no number of decimals, which text would keep.
    struct : SettingVisitor {
      void visit(const SettingInfo& /*info*/, float& value) override { value += 1.0F / 3.0F; }
      void visit(const SettingInfo& /*info*/, std::uint32_t& value) override { ++value; }
      void visit(const SettingInfo& /*info*/, bool& value) override { value = !value; }
      void choice(const SettingInfo& /*info*/, std::span<const std::string_view> names, std::uint32_t& value) override {
        value = (value + 1) % static_cast<std::uint32_t>(names.size());
      }
    } change;
    method->visitSettings(change);
    const SettingValues changed(*method);
    values.restore(*method);
    const std::vector<SettingText> after = method->settings();
    for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].value, defaults[i].value) << after[i].name;
    EXPECT_TRUE(SettingValues(*method) == values) << name;
    EXPECT_EQ(changed == values, after.empty()) << name;
  }
}

TEST_F(SessionTest, FreeCameraStartsFromTheScenes) {
  Session session = make({0, 9}, false);
  EXPECT_FALSE(session.nextRequest()->view.has_value());
  session.chooseCamera(CameraMode::Orbit);
  session.paused = true;
  const glm::mat4 view = session.nextRequest()->view.value();
  for (int column = 0; column < 4; ++column) {
    EXPECT_LT(glm::distance(view[column], tracer.sceneCamera(0.0)[column]), 1e-4F);
  }
  session.moveCamera({.turn = {0.2F, 0.0F}});
  EXPECT_GT(glm::distance(session.nextRequest()->view.value()[3], view[3]), 0.01F);
  session.chooseCamera(CameraMode::Scene);
  EXPECT_FALSE(session.nextRequest()->view.has_value());
}

TEST_F(SessionTest, EdgesOfTheSplitViewFollowTheMouse) {
  Session session = make({0, 9}, false);
  const auto width = static_cast<int>(tracer.extent().width);
  session.viewConstants.leftEdge = width / 3;
  session.viewConstants.rightEdge = 2 * width / 3;
  const auto left = static_cast<float>(session.viewConstants.leftEdge);
  const auto right = static_cast<float>(session.viewConstants.rightEdge);
  EXPECT_FALSE(session.grabEdge(left, 4.0F)) << "another view has no edges";
  session.chooseView({HostView::Kind::Split, ""});
  EXPECT_FALSE(session.grabEdge(left - 5.0F, 4.0F));
  session.moveEdge(0.0F);
  EXPECT_EQ(session.viewConstants.leftEdge, width / 3) << "no edge is held";

  EXPECT_TRUE(session.grabEdge(left + 2.0F, 4.0F));
  session.moveEdge(left + 3.4F);
  EXPECT_EQ(session.viewConstants.leftEdge, width / 3 + 3);
  session.moveEdge(-100.0F);
  EXPECT_EQ(session.viewConstants.leftEdge, 0);
  session.moveEdge(right + 10.0F);
  EXPECT_EQ(session.viewConstants.leftEdge, 2 * width / 3) << "edges do not pass each other";
  session.moveEdge(left);
  session.releaseEdge();
  session.moveEdge(0.0F);
  EXPECT_EQ(session.viewConstants.leftEdge, width / 3);

  EXPECT_TRUE(session.grabEdge(right, 4.0F));
  session.moveEdge(1e6F);
  EXPECT_EQ(session.viewConstants.rightEdge, width);
  session.moveEdge(0.0F);
  EXPECT_EQ(session.viewConstants.rightEdge, width / 3);
}

TEST_F(SessionTest, ComparesWithAnotherMethod) {
  Session session = make({0, 9}, false);
  session.chooseView({HostView::Kind::Compare, ""});
  EXPECT_EQ(session.takeGraphChange(), GraphChange::Settings);
  EXPECT_EQ(session.comparedName(), "none");
  ASSERT_NE(session.view().compared, nullptr);
  EXPECT_FALSE(session.nextRequest()->reference);
  const Denoiser* const before = session.view().compared;
  session.compareWith("svgf", makeDenoiser("svgf"));
  EXPECT_NE(session.view().compared, before);
  EXPECT_EQ(session.takeGraphChange(), GraphChange::Method) << "both start without history";

  const auto width = static_cast<int>(tracer.extent().width);
  session.viewConstants.middleEdge = width / 2;
  EXPECT_TRUE(session.grabEdge(static_cast<float>(width) / 2.0F, 4.0F));
  session.moveEdge(5.0F);
  EXPECT_EQ(session.viewConstants.middleEdge, 5);
  session.moveEdge(-5.0F);
  EXPECT_EQ(session.viewConstants.middleEdge, 0);
  session.moveEdge(1e6F);
  EXPECT_EQ(session.viewConstants.middleEdge, width);
  session.chooseView({});
  EXPECT_EQ(session.view().compared, nullptr);
  session.takeGraphChange();
  session.compareWith("flr", makeDenoiser("flr"));
  EXPECT_EQ(session.takeGraphChange(), GraphChange::None) << "it is not shown";
}

TEST_F(SessionTest, ObjectsStandStillWhileTheCameraMoves) {
  tracer.show(tracer.read(WALR_SCENES "/turntable.gltf"));
  Session session = make({12, 20}, false);
  session.nextRequest();
  session.nextRequest();
  session.objectsMove = false;
  for (const int frame : {14, 15, 16}) {
    const Tracer::Request request = session.nextRequest().value();
    EXPECT_EQ(request.animationFrame, 13.0);
    ASSERT_TRUE(request.view.has_value());
    EXPECT_EQ(*request.view, tracer.sceneCamera(frame));
    EXPECT_NE(*request.view, tracer.sceneCamera(13.0));
  }
  session.objectsMove = true;
  const Tracer::Request request = session.nextRequest().value();
  EXPECT_EQ(request.animationFrame, 17.0);
  EXPECT_FALSE(request.view.has_value());
}

TEST(DefaultExtent, IsLargeInAWindowOnAGpu) {
  constexpr fg::Extent kLarge{1920, 1080};
  for (const VkPhysicalDeviceType gpu :
       {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU}) {
    EXPECT_EQ(defaultExtent(true, gpu), kLarge);
    EXPECT_NE(defaultExtent(false, gpu), kLarge);
  }
  for (const VkPhysicalDeviceType other : {VK_PHYSICAL_DEVICE_TYPE_CPU, VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU}) {
    EXPECT_NE(defaultExtent(true, other), kLarge);
  }
}

/// Frames whose times are computed: a part that does not depend on the size, a part for every pixel, and noise.
class ResolutionTest : public testing::Test {
 protected:
  void play(int frames) {
    for (int i = 0; i < frames; ++i) {
      const fg::Extent before = control.extent();
      control.frameTook((fixed + perPixel * before.width * before.height) * (0.95 + 0.05 * (i % 3)));
      changes += control.extent() == before ? 0 : 1;
    }
  }
  [[nodiscard]] double time() const { return fixed + perPixel * control.extent().width * control.extent().height; }

  static constexpr fg::Extent kFull{1920, 1080};
  ResolutionControl control{kFull};
  double fixed = 2.0;
  double perPixel = 30.0 / (1920.0 * 1080.0);
  int changes = 0;
};

TEST_F(ResolutionTest, HoldsTheTimeOfAFrameWithFewChanges) {
  control.setTarget(16.0);
  play(100);
  EXPECT_LE(time(), 16.0);
  EXPECT_GE(time(), 0.8 * 16.0);
  EXPECT_LE(changes, 3);
  EXPECT_NEAR(control.extent().width * 1080.0, control.extent().height * 1920.0, 1920.0);
  changes = 0;
  play(400);
  EXPECT_EQ(changes, 0) << "the size comes to rest";

  for (const double load : {1.6, 0.5}) {
    perPixel *= load;
    changes = 0;
    play(100);
    EXPECT_LE(time(), 16.0) << load;
    EXPECT_GE(time(), 0.8 * 16.0) << load;
    EXPECT_LE(changes, 3) << load;
  }
}

TEST_F(ResolutionTest, StaysBetweenHalfAndAllOfTheSides) {
  play(100);
  EXPECT_EQ(control.extent(), kFull) << "nothing is to be held";
  control.setTarget(1.0);
  play(100);
  EXPECT_EQ(control.extent(), (fg::Extent{960, 540}));
  control.setTarget(1000.0);
  play(100);
  EXPECT_EQ(control.extent(), kFull);
  control.setTarget(1.0);
  play(100);
  control.setTarget(0.0);
  EXPECT_EQ(control.extent(), kFull);
  EXPECT_EQ(changes, 3);
}

class SceneLoaderTest : public SessionTest {
 protected:
  /// A scene of the project without some of its parts.
  std::filesystem::path without(const std::string& scene, const std::vector<std::string>& nodeParts) {
    nlohmann::json content = nlohmann::json::parse(std::ifstream(WALR_SCENES "/" + scene));
    for (nlohmann::json& node : content["nodes"]) {
      for (const std::string& part : nodeParts) node.erase(part);
    }
    content.erase("animations");
    for (nlohmann::json& each : content["scenes"]) each.erase("extras");
    for (nlohmann::json& material : content["materials"]) material.erase("emissiveFactor");
    std::filesystem::path file = folder.path() / ("reduced " + scene);
    std::ofstream(file) << content;
    return file;
  }

  bool open(const std::filesystem::path& file, Session& session) {
    SceneLoader loader(tracer, session);
    loader.start(file);
    while (!loader.done()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return loader.finish();
  }

  test::TemporaryDirectory folder;
};

TEST_F(SceneLoaderTest, KeepsSettingsAndStartsCameraAndHistoryAnew) {
  Session session = make({2, 9}, false);
  session.chooseMethod("svgf");
  session.method().set("accumulation.max-history", "5");
  session.settingsChanged();
  session.chooseCamera(CameraMode::Orbit);
  tracer.trace(session.nextRequest().value());
  tracer.trace(session.nextRequest().value());
  const glm::mat4 before = tracer.sceneCamera(0.0);
  session.takeGraphChange();
  ASSERT_TRUE(open(WALR_SCENES "/turntable.gltf", session)) << session.message;

  Tracer::Options options = boxScene();
  options.scene = WALR_SCENES "/turntable.gltf";
  Tracer alone(options);
  EXPECT_NE(alone.sceneCamera(0.0), before);
  EXPECT_EQ(tracer.bounds(), alone.bounds());
  EXPECT_EQ(session.message, "turntable.gltf");
  EXPECT_EQ(session.frames().first, 0);
  EXPECT_EQ(session.frames().last, 47);
  EXPECT_EQ(session.viewConstants.stops, alone.exposure(0.0));
  EXPECT_EQ(session.methodName(), "svgf");
  EXPECT_EQ(session.preset(), std::nullopt);
  EXPECT_EQ(session.cameraMode(), CameraMode::Scene);
  EXPECT_EQ(session.takeGraphChange(), GraphChange::Method);
  const Tracer::Request request = session.nextRequest().value();
  EXPECT_EQ(request.animationFrame, 0.0);
  EXPECT_FALSE(request.view.has_value());
  const Frame frame = tracer.trace(request);
  EXPECT_TRUE(frame.resetHistory);
  EXPECT_EQ(frame.camera.view, alone.sceneCamera(0.0));
  EXPECT_EQ(frame.camera.previousView, frame.camera.view);
}

TEST_F(SceneLoaderTest, AChosenExposureStays) {
  Session session = make({0, 9}, false);
  session.autoExposure = false;
  session.viewConstants.stops = 2.5F;
  ASSERT_TRUE(open(WALR_SCENES "/turntable.gltf", session));
  EXPECT_EQ(session.viewConstants.stops, 2.5F);
}

TEST_F(SceneLoaderTest, AFileThatCannotBeReadIsNamedAndTheOldSceneGoesOn) {
  const std::filesystem::path broken = folder.path() / "broken.glb";
  std::ofstream(broken) << "glTF";
  Session session = make({2, 9}, false);
  session.chooseCamera(CameraMode::Orbit);
  tracer.trace(session.nextRequest().value());
  const glm::vec4 bounds = tracer.bounds();
  for (const std::filesystem::path& file : {broken, folder.path() / "missing.gltf", folder.path()}) {
    EXPECT_FALSE(open(file, session));
    EXPECT_EQ(session.message.find("Not opened: " + file.string() + ": "), 0U) << session.message;
    EXPECT_GT(session.message.size(), ("Not opened: " + file.string() + ": ").size());
    EXPECT_EQ(tracer.bounds(), bounds);
    EXPECT_EQ(session.cameraMode(), CameraMode::Orbit);
    EXPECT_EQ(session.takeGraphChange(), GraphChange::None);
    EXPECT_FALSE(tracer.trace(session.nextRequest().value()).resetHistory);
  }
  EXPECT_EQ(session.animationFrame(), 5);
}

// The test holds the reading back as long as it likes.
TEST_F(SceneLoaderTest, TheOldSceneGoesOnWhileAnotherIsRead) {
  Session session = make({2, 9}, false);
  std::promise<void> released;
  const std::shared_future<void> release = released.get_future().share();
  std::vector<std::string> read;
  SceneLoader loader(tracer, session, [&](const std::filesystem::path& file) {
    read.push_back(file.filename());
    release.wait();
    return tracer.read(file);
  });
  EXPECT_FALSE(loader.done());
  session.paused = true;  // An animation that starts again would reset the history.
  tracer.trace(session.nextRequest().value());
  const glm::mat4 camera = tracer.sceneCamera(0.0);
  loader.start(WALR_SCENES "/kitchen.gltf");
  EXPECT_EQ(session.message, "Loading kitchen.gltf");
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(loader.done());
    EXPECT_FALSE(tracer.trace(session.nextRequest().value()).resetHistory);
    EXPECT_EQ(tracer.sceneCamera(0.0), camera);
  }
  // Of what is dropped meanwhile, only the last is of interest.
  loader.start(WALR_SCENES "/stair.gltf");
  loader.start(WALR_SCENES "/turntable.gltf");
  EXPECT_EQ(session.message, "Loading turntable.gltf");
  EXPECT_EQ(session.takeGraphChange(), GraphChange::None);
  released.set_value();
  while (!loader.done()) EXPECT_FALSE(tracer.trace(session.nextRequest().value()).resetHistory);
  EXPECT_TRUE(loader.done());
  EXPECT_EQ(tracer.sceneCamera(0.0), camera) << "nothing changes before the end";
  ASSERT_TRUE(loader.finish());
  EXPECT_FALSE(loader.done());
  EXPECT_EQ(read, (std::vector<std::string>{"kitchen.gltf", "turntable.gltf"}));
  EXPECT_EQ(session.message, "turntable.gltf");
  EXPECT_EQ(session.takeGraphChange(), GraphChange::Method);
  EXPECT_NE(tracer.sceneCamera(0.0), camera);
  EXPECT_TRUE(tracer.trace(session.nextRequest().value()).resetHistory);
}

// Most files that people have hold neither camera nor light.
TEST_F(SceneLoaderTest, WithoutCameraAndLightASceneIsSeenAllTheSame) {
  Session session = make({0, 9}, false);
  ASSERT_TRUE(open(without("turntable.gltf", {"camera", "extensions"}), session)) << session.message;
  EXPECT_NE(session.message.find("no camera"), std::string::npos) << session.message;
  EXPECT_NE(session.message.find("white sky"), std::string::npos) << session.message;
  EXPECT_EQ(session.message.find("black"), std::string::npos) << session.message;
  const Frame frame = tracer.trace(session.nextRequest().value());
  const glm::vec4 middle = frame.camera.view * glm::vec4(glm::vec3(tracer.bounds()), 1.0F);
  EXPECT_NEAR(middle.x, 0.0F, 1e-4F * tracer.bounds().w);
  EXPECT_NEAR(middle.y, 0.0F, 1e-4F * tracer.bounds().w);
  EXPECT_GT(-middle.z, tracer.bounds().w);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < frame.indirect.pixelCount(); ++i) lit += frame.indirect.pixel(i)[1] > 0.0F ? 1 : 0;
  EXPECT_GT(lit, frame.indirect.pixelCount() / 10);
}

}  // namespace
}  // namespace walr::host
