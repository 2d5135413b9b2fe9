// Shaders that change while the host runs: the picture follows, and the history goes on.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passes/methods/denoiser.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/renderer.h"
#include "samples/host/shader_reloader.h"
#include "samples/host/tracer.h"
#include "tests/error_text.h"
#include "tests/samples/temporary_directory.h"

namespace walr::host {
namespace {

namespace fs = std::filesystem;

constexpr fg::Extent kExtent{72, 40};

/// A copy of the shaders that a test may change.
class Sources {
 public:
  Sources() { fs::copy(WALR_SHADER_SOURCES, folder(), fs::copy_options::recursive); }
  [[nodiscard]] fs::path folder() const { return directory_.path() / "shaders"; }
  /// Replace text in a file, which must have it.
  void replace(const std::string& file, const std::string& old, const std::string& text) {
    const fs::path path = folder() / file;
    std::ifstream in(path);
    std::string source{std::istreambuf_iterator<char>(in), {}};
    const std::size_t at = source.find(old);
    if (at == std::string::npos) throw std::logic_error(file + " has no \"" + old + '"');
    std::ofstream(path) << source.replace(at, old.size(), text);
    // File systems have coarse clocks.
    fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(++changes_));
  }

 private:
  test::TemporaryDirectory directory_;
  int changes_ = 0;
};

/// A host that renders frame by frame, with a copy of the shaders.
class Host {
 public:
  explicit Host(const GpuDevice& gpu) : method_(makeDenoiser("walr")), renderer_(gpu, *method_, kExtent, {}) {}

  /// Render the next frame with the shaders as they are.
  std::vector<std::uint32_t> frame() {
    Tracer::Request request;
    request.number = number_;
    request.animationFrame = number_++;
    renderer_.submit(packHostFrame(tracer_.trace(request)));
    return renderer_.finish()->display;
  }
  std::size_t poll() { return reloader_.poll(renderer_.graph().desc(), renderer_.executor()); }
  /// Messages since the last call.
  std::string said() {
    std::string text = messages_.str();
    messages_.str("");
    return text;
  }
  Sources& sources() { return sources_; }

 private:
  static Tracer::Options tracing() {
    Tracer::Options options;
    options.scene = WALR_SCENES "/box.gltf";
    options.extent = kExtent;
    return options;
  }

  Sources sources_;
  Tracer tracer_{tracing()};
  std::unique_ptr<Denoiser> method_;
  Renderer renderer_;
  std::ostringstream messages_;
  ShaderReloader reloader_{WALR_SHADER_COMMANDS, WALR_SHADER_SOURCES, sources_.folder(), messages_};
  int number_ = 0;
};

class ShaderReloaderTest : public testing::Test {
 protected:
  void TearDown() override { EXPECT_NO_THROW(gpu.refuseMessages()); }

  GpuDevice gpu{{.device = "", .validation = true}};
};

constexpr const char* kShader = "temporal/temporal_antialiasing.comp";
// The result, but not the history, which is stored before.
constexpr const char* kResult = "imageStore(outImage, p, vec4(light, 1.0));";
constexpr const char* kBrighter = "imageStore(outImage, p, vec4(2.0 * light, 1.0));";

TEST_F(ShaderReloaderTest, ThePictureFollowsTheSourceAndTheHistoryGoesOn) {
  Host usual(gpu);
  Host changing(gpu);
  const std::vector<std::uint32_t> first = Host(gpu).frame();
  EXPECT_EQ(changing.poll(), 0U);
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    if (i == 3) {
      changing.sources().replace(kShader, kResult, kBrighter);
      EXPECT_EQ(changing.poll(), 1U);
      fg::test::expectContains(changing.said(), {"shader 'temporal_antialiasing", "is reloaded"});
      EXPECT_NE(Host(gpu).frame(), first) << "a graph that is declared later uses it, too";
    }
    if (i == 4) {
      changing.sources().replace(kShader, kBrighter, kResult);
      EXPECT_EQ(changing.poll(), 1U);
    }
    EXPECT_EQ(changing.poll(), 0U);
    // With a history that had restarted, the pictures after the change would be noisier.
    if (i == 3) {
      EXPECT_NE(changing.frame(), usual.frame());
    } else {
      EXPECT_EQ(changing.frame(), usual.frame());
    }
  }
}

TEST_F(ShaderReloaderTest, AShaderThatCannotBeUsedIsReportedAndTheOldOneStays) {
  Host usual(gpu);
  Host broken(gpu);
  EXPECT_EQ(broken.frame(), usual.frame());
  broken.sources().replace(kShader, kResult, "imageStore(outImage, p, nonsense);");
  EXPECT_EQ(broken.poll(), 0U);
  fg::test::expectContains(broken.said(), {"does not compile, so that it stays as it is", "nonsense"});
  EXPECT_EQ(broken.frame(), usual.frame());

  // The message comes once for each change.
  EXPECT_EQ(broken.poll(), 0U);
  EXPECT_EQ(broken.said(), "");
  broken.sources().replace(kShader, "nonsense", "vec4(light, 1.0)");
  EXPECT_EQ(broken.poll(), 0U);
  EXPECT_EQ(broken.said(), "");

  broken.sources().replace(kShader, "local_size_x = 16", "local_size_x = 8");
  EXPECT_EQ(broken.poll(), 0U);
  fg::test::expectContains(broken.said(), {"other bindings or constants", "build the program again"});
  EXPECT_EQ(broken.frame(), usual.frame());
}

TEST_F(ShaderReloaderTest, AChangedIncludeReachesTheShadersThatIncludeIt) {
  Host host(gpu);
  host.frame();
  host.sources().replace("common/luminance.glsl", "0.2126", "0.9");
  EXPECT_GT(host.poll(), 1U);
  host.frame();
}

TEST(ShaderReloader, MissingFilesAreErrorsThatNameThem) {
  std::ostringstream messages;
  fg::test::expectError<std::runtime_error>(
      [&] { const ShaderReloader none("/nowhere/commands.txt", "/nowhere", WALR_SHADER_SOURCES, messages); },
      {"/nowhere/commands.txt"});
  const test::TemporaryDirectory empty;
  fg::test::expectError<std::runtime_error>(
      [&] { const ShaderReloader none(WALR_SHADER_COMMANDS, WALR_SHADER_SOURCES, empty.path(), messages); },
      {"no sources of shaders", empty.path().string()});
}

}  // namespace
}  // namespace walr::host
