// What the graph of a window does with the choices of its session, without the window: those that a method refuses
// leave everything as it was.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/vulkan/frame_queue.h"
#include "passes/methods/denoiser.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/follow_session.h"
#include "samples/host/live_frame.h"
#include "samples/host/session.h"
#include "samples/host/tracer.h"
#include "tests/samples/host_tracing.h"

namespace walr::host {
namespace {

Tracer::Options tracingSparsely() {
  Tracer::Options options = tracing();
  options.light = {.columns = 2, .rows = 2};
  return options;
}

/// A window's frame of a scene with light at one pixel of four.
class FollowSessionTest : public HostDeviceTest {
 protected:
  void SetUp() override { ASSERT_EQ(follow(GraphChange::Method), Followed::Declared); }
  void TearDown() override {
    queue.waitAll();
    HostDeviceTest::TearDown();
  }

  Followed follow(GraphChange change, fg::Extent extent = kExtent) {
    return followSession(live, session, change, extent);
  }
  Followed follow() { return follow(session.takeGraphChange()); }
  void record() {
    const HostFrame frame = tracer.hostFrame(session.nextRequest(true).value());
    const fg::vk::Frame recorded = queue.begin();
    live.record(recorded, frame, {});
    queue.submit(recorded);
  }
  /// How many frames the histories of the running graph hold.
  std::uint32_t age() { return live.histories().at(0).age; }
  /// @param named  part of the reason
  void expectRefused(Followed followed, const std::string& named) {
    EXPECT_EQ(followed, Followed::Refused);
    EXPECT_EQ(session.refusal().find("Not changed: "), 0U) << session.refusal();
    EXPECT_NE(session.refusal().find(named), std::string::npos) << session.refusal();
  }

  Tracer tracer{tracingSparsely()};
  Session session{tracer, "walr", makeDenoiser("walr"), {}, {}, {0, 9}, false};
  ShownPicture picture{gpu, kExtent};
  LiveFrame live{gpu, picture, 2, tracer.light()};
  fg::vk::FrameQueue queue{gpu.device().context(), gpu.device().queue(), 2};
};

TEST_F(FollowSessionTest, ChoicesThatAreRefusedLeaveThePictureAndItsHistory) {
  const std::vector<std::pair<std::string, std::function<void()>>> refused{
      {"method 'svgf' needs a sample of light at every pixel", [&] { session.chooseMethod("svgf"); }},
      {"accumulation.antilag-low",
       [&] {
         session.method().set("accumulation.antilag-low", "5");
         session.method().set("accumulation.antilag-high", "1");
         session.settingsChanged();
       }},
      {"method 'flnr'",
       [&] {
         session.chooseView({HostView::Kind::Compare, ""});
         session.compareWith("flnr", makeDenoiser("flnr"));
       }},
      {"method 'none'",
       [&] {
         session.method().set("blocks.growth-errors", "1.5");
         session.settingsChanged();
         session.chooseMethod("none");
       }},
  };
  const std::vector<SettingText> before = session.method().settings();
  std::uint32_t frames = 0;
  for (const auto& [named, choose] : refused) {
    SCOPED_TRACE(named);
    record();
    EXPECT_EQ(age(), ++frames);
    const fg::Graph* const running = &live.graph();
    choose();
    expectRefused(follow(), named);
    EXPECT_EQ(&live.graph(), running);
    EXPECT_EQ(session.methodName(), "walr");
    EXPECT_EQ(session.preset(), "standard");
    EXPECT_EQ(session.comparedName(), "none");
    EXPECT_EQ(session.view(), HostView{});
    const std::vector<SettingText> after = session.method().settings();
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(after[i].value, before[i].value) << before[i].name;
    EXPECT_EQ(session.takeGraphChange(), GraphChange::None);
  }
  session.chooseMethod("bmfr");
  EXPECT_EQ(follow(), Followed::Declared);
  EXPECT_EQ(session.refusal(), "") << "another choice was accepted";
}

TEST_F(FollowSessionTest, ARefusalStaysUntilAnotherChoiceIsAccepted) {
  session.chooseMethod("svgf");
  expectRefused(follow(), "svgf");
  record();
  EXPECT_EQ(follow(GraphChange::Settings, {36, 20}), Followed::Declared);
  expectRefused(Followed::Refused, "svgf");
  session.method().set("blocks.growth-errors", "1.5");
  session.settingsChanged();
  EXPECT_EQ(followSession(live, session, session.takeGraphChange(), {36, 20}), Followed::Updated);
  EXPECT_EQ(session.refusal(), "");
  // What is refused next goes back to what was accepted last.
  session.chooseMethod("svgf");
  EXPECT_EQ(followSession(live, session, session.takeGraphChange(), {36, 20}), Followed::Refused);
  const auto settings = session.method().settings();
  EXPECT_EQ(std::ranges::find(settings, "blocks.growth-errors", &SettingText::name)->value, "1.5");
  EXPECT_EQ(session.preset(), std::nullopt);
}

TEST_F(FollowSessionTest, ASizeThatChangesWithARefusedChoiceIsFollowedAllTheSame) {
  record();
  session.chooseMethod("svgf");
  EXPECT_EQ(follow(session.takeGraphChange(), {36, 20}), Followed::Declared);
  expectRefused(Followed::Refused, "svgf");
  EXPECT_EQ(live.extent(), (fg::Extent{36, 20}));
  session.extent = {36, 20};
  record();
  EXPECT_EQ(age(), 2U) << "the history goes on";

  queue.waitAll();
  live.changeScene(nullptr);
  session.sceneChanged();
  session.chooseMethod("svgf");
  EXPECT_EQ(follow(session.takeGraphChange(), {36, 20}), Followed::Declared);
  expectRefused(Followed::Refused, "svgf");
  record();
  EXPECT_EQ(age(), 1U);
}

TEST_F(FollowSessionTest, WhatIsRefusedAtTheStartHasNothingToGoBackTo) {
  Session first(tracer, "svgf", makeDenoiser("svgf"), {}, {}, {0, 9}, false);
  EXPECT_THROW(followSession(live, first, GraphChange::Method, kExtent), std::invalid_argument);
  EXPECT_EQ(first.refusal(), "");
}

TEST_F(FollowSessionTest, ASliderThatIsDraggedWaitsForAnotherGraphAndGoesBackIfItIsRefused) {
  record();
  session.dragging = true;
  session.method().set("spatial-only", "on");
  session.settingsChanged();
  EXPECT_EQ(follow(), Followed::Refused);
  session.method().set("antialiasing.enabled", "off");
  session.settingsChanged();
  EXPECT_EQ(follow(), Followed::Waits);
  EXPECT_NE(session.refusal(), "");
  session.dragging = false;
  EXPECT_EQ(follow(GraphChange::Settings), Followed::Declared);
  EXPECT_EQ(session.refusal(), "");
}

// The panel shows in grey what would be refused.
TEST_F(FollowSessionTest, TellsBeforehandWhatWouldBeRefused) {
  for (const char* const name : {"walr", "walr_paper", "bmfr", "flr", "accumulate"}) {
    EXPECT_EQ(refusalOfMethod(live, session, name), "");
    EXPECT_EQ(refusalOfCompared(live, session, name), "");
  }
  for (const std::string name : {"svgf", "refwlr", "flnr", "joint_bilateral", "none"}) {
    EXPECT_NE(refusalOfMethod(live, session, name).find("method '" + name + "'"), std::string::npos);
    EXPECT_NE(refusalOfCompared(live, session, name).find("method '" + name + "'"), std::string::npos);
  }
  EXPECT_EQ(refusalOfPreset(live, session, "standard"), "");
  record();
  EXPECT_EQ(age(), 1U) << "the graph is the same";
}

TEST_F(FollowSessionTest, ATextureThatIsNoMoreGivesWayToTheDenoisedImage) {
  const auto show = [&](const std::string& texture) {
    const std::vector<std::string> textures = viewableTextures(live.graph().desc());
    ASSERT_NE(std::ranges::find(textures, texture), textures.end()) << testing::PrintToString(textures);
    session.chooseView({HostView::Kind::Texture, texture});
    EXPECT_EQ(follow(), Followed::Declared);
    EXPECT_EQ(session.view().texture, texture);
  };
  show("normal");
  session.chooseMethod("bmfr");
  EXPECT_EQ(follow(), Followed::Declared);
  EXPECT_EQ(session.view().texture, "normal") << "every method has it";
  session.chooseMethod("walr");
  EXPECT_EQ(follow(), Followed::Declared);
  show("block moments 0");
  EXPECT_EQ(refusalOfMethod(live, session, "bmfr"), "");
  session.chooseMethod("bmfr");
  EXPECT_EQ(follow(), Followed::Declared);
  EXPECT_EQ(session.methodName(), "bmfr");
  EXPECT_EQ(session.view(), HostView{});

  session.chooseMethod("walr");
  EXPECT_EQ(follow(), Followed::Declared);
  show("resolved.current");
  session.method().set("antialiasing.enabled", "off");
  session.settingsChanged();
  EXPECT_EQ(follow(), Followed::Declared);
  EXPECT_EQ(session.view(), HostView{});
  EXPECT_EQ(session.refusal(), "");
  EXPECT_EQ(session.takeGraphChange(), GraphChange::None);

  // What is refused in any view brings the texture back.
  show("block moments 0");
  session.chooseMethod("svgf");
  expectRefused(follow(), "method 'svgf'");
  EXPECT_EQ(session.view().texture, "block moments 0");
}

// At first it is the noisy light, which a comparison takes at every pixel.
TEST_F(FollowSessionTest, AComparisonTakesAMethodThatTheFramesSuit) {
  chooseComparison(live, session);
  EXPECT_EQ(follow(), Followed::Declared);
  EXPECT_EQ(session.view().kind, HostView::Kind::Compare);
  EXPECT_EQ(session.comparedName(), "walr_paper") << "the first that is not that on the left";
  session.compareWith("flr", makeDenoiser("flr"));
  session.chooseView({});
  EXPECT_EQ(follow(), Followed::Declared);
  chooseComparison(live, session);
  EXPECT_EQ(follow(), Followed::Declared);
  EXPECT_EQ(session.comparedName(), "flr") << "it stays";
}

}  // namespace
}  // namespace walr::host
