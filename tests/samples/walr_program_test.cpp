#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passes/methods/denoiser.h"
#include "samples/image/exr.h"
#include "tests/samples/schema_check.h"
#include "tests/samples/walr_program.h"

namespace walr {
namespace {

namespace fs = std::filesystem;
using test::Channels;
using test::expectFailure;
using test::expectSuccess;
using test::kInput;
using test::kUsage;
using test::ProcessOptions;
using test::ProcessResult;
using test::SyntheticSequence;

TEST_F(ProgramTest, HelpExplainsEveryCommand) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{{}, {"denoise"}, {"graph"}}) {
    std::vector<std::string> arguments = command;
    arguments.emplace_back("--help");
    const ProcessResult result = walr(arguments);
    expectSuccess(result);
    EXPECT_NE(result.out.find("Exit codes"), std::string::npos) << result.out;
  }
  const std::string help = walr({"denoise", "--help"}).out;
  for (const std::string& method : denoiserNames()) {
    EXPECT_NE(help.find(method), std::string::npos) << method;
  }
}

TEST_F(ProgramTest, AWrongCommandLineIsAUsageError) {
  files.write(0, 0);
  expectFailure(walr({}), kUsage, {"subcommand"});
  expectFailure(walr({"denoise"}), kUsage, {"INPUT"});
  expectFailure(walr({"denoise", input}), kUsage, {"--output"});
  expectFailure(denoise({"--method", "magic"}), kUsage, {"magic"});
  expectFailure(denoise({"--frames", "5-2"}), kUsage, {"--frames 5-2", "first and a last"});
  expectFailure(denoise({"--non-finite", "maybe"}), kUsage, {"maybe"});
  expectFailure(denoise({"--set", "nothing=1"}), kUsage, {"nothing"});
  expectFailure(denoise({"--set", "nothing"}), kUsage, {"NAME=VALUE"});
  expectFailure(walr({"denoise", input, "--output", input}), kUsage, {"input folder"});
  expectFailure(denoise({"--preset", "fancy"}), kUsage, {"--preset fancy"});
  expectFailure(denoise({"--preset", "paper"}), kUsage, {"--preset paper", "walr_paper"});
  expectFailure(denoise({"--view", "hedges", "--method", "walr_paper"}), kUsage,
                {"--view hedges", "edges: ", "slope-u: "});
  expectFailure(denoise({"--view", "slope-u"}), kUsage, {"--view slope-u", "with these settings", "slope-occlusion: "});
  expectFailure(denoise({"--view", "edges", "--method", "flr"}), kUsage, {"--view edges", "flr has no", "history: "});
  expectFailure(denoise({"--view", "history", "--method", "none"}), kUsage, {"--view history", "none has no views"});
  expectFailure(denoise({"--view", "?"}), kUsage, {"--list-views"});
  expectFailure(denoise({"--png", "--exposure", "bright"}), kUsage, {"--exposure bright", "auto"});
  expectFailure(denoise({"--exposure", "1"}), kUsage, {"--exposure", "--png"});
  expectFailure(denoise({"--direct-light", "none"}), kUsage, {"none"});
  expectFailure(denoise({"--direct-light", "reference"}), kUsage, {"--direct-light", "--composite"});
  expectFailure(walr({"graph", "--list-settings", "--json"}), kUsage, {"--list-settings", "--json"});
  expectFailure(denoise({"--light", "every"}), kUsage, {"--light", "every"});
  expectFailure(walr({"graph", "--size", "10"}), kUsage, {"--size 10"});
}

TEST_F(ProgramTest, DenoisesAndMeasures) {
  files.write(0, 5);
  const fs::path json = directory.path() / "report.json";
  const ProcessResult result = denoise({"--json", json.string(), "--png"});
  expectSuccess(result);
  EXPECT_NE(result.out.find("Blender Cycles"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("frame 6 of 6"), std::string::npos) << result.err;
  EXPECT_EQ(outputFiles().size(), 18U);

  EXPECT_EQ(test::schemaTroubles("samples/denoise/denoise.schema.json", json), "");
  const auto report = nlohmann::json::parse(test::readText(json));
  EXPECT_EQ(report["method"], "walr");
  EXPECT_FALSE(report["device"].get<std::string>().empty());
  EXPECT_FALSE(report["driver"].get<std::string>().empty());
  ASSERT_EQ(report["frames"].size(), 6U);
  EXPECT_EQ(report["frames"][5]["frame"], 5);
  EXPECT_GT(report["frames"][5]["gpu_ms"], 0.0);
  // The reference is constant, so a denoiser's error must be far below that of one sample per pixel.
  EXPECT_LT(report["frames"][5]["rmse"].get<double>(), 0.25 * report["frames"][5]["noisy"]["rmse"].get<double>());
  expectFinite(readPlane(output / "denoised_0005.exr"));
}

TEST_F(ProgramTest, DenoisesSpecularLight) {
  const std::string scene = std::string(WALR_SCENES) + "/gloss.gltf";
  expectSuccess(walr({"render", scene, "--output", input.string(), "--frames", "8-11", "--size", "64x36", "--bounces",
                      "1", "--specular", "--reference-spp", "16", "--reference-frames", "11-11"}));
  const fs::path json = directory.path() / "report.json";
  expectSuccess(denoise({"--light", "specular", "--view", "reflection-motion", "--json", json.string(), "--png"}));
  EXPECT_EQ(test::schemaTroubles("samples/denoise/denoise.schema.json", json), "");
  const auto last = nlohmann::json::parse(test::readText(json))["frames"][3];
  EXPECT_TRUE(last["rmse"].is_null());  // Of indirect light.
  EXPECT_LT(last["specular"]["rmse"].get<double>(), 0.9 * last["specular"]["noisy"]["rmse"].get<double>());
  expectFinite(readPlane(output / "denoised_0011.exr", "Specular"));
  EXPECT_TRUE(fs::exists(output / "view_reflection-motion_0011.exr"));

  const fs::path compared = directory.path() / "compared";
  const auto bench = [&](std::initializer_list<std::string> more) {
    std::vector<std::string> arguments = {"bench",   "--sequences", input.string(), "--output", compared.string(),
                                          "--light", "specular",    "--repeat",     "0"};
    arguments.insert(arguments.end(), more);
    return walr(arguments);
  };
  expectFailure(bench({"--response"}), kUsage, {"--light specular", "--response"});
  expectFailure(bench({"--methods", "bmfr"}), kUsage, {"'bmfr'", "diffuse light only", "--methods"});
  expectSuccess(bench({"--methods", "none"}));
  EXPECT_EQ(test::schemaTroubles("samples/bench/bench.schema.json", compared / "bench.json"), "");
  const auto sequence = nlohmann::json::parse(test::readText(compared / "bench.json"))["sequences"][0];
  const auto judged = sequence["runs"][0]["frames"][3];
  EXPECT_EQ(judged["rmse"], last["specular"]["rmse"]);
  EXPECT_EQ(judged["rmse_by_roughness"], last["specular"]["rmse_by_roughness"]);
  EXPECT_EQ(sequence["runs"][1]["frames"][3]["rmse"], last["specular"]["noisy"]["rmse"]);
  const auto noise = sequence["frames"][3]["reference_noise_by_roughness"];
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(noise[i].is_null(), judged["rmse_by_roughness"][i].is_null()) << i;
  const auto clean = judged["clean_square_by_roughness"];
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(clean[i].is_null(), noise[i].is_null()) << i;
  // What the noise of the reference adds is left out.
  EXPECT_LT(judged["clean_square"].get<double>(), std::pow(judged["rmse"].get<double>(), 2.0));
  EXPECT_NE(test::readText(compared / "report.html").find(".6 to 1"), std::string::npos);

  expectFailure(denoise({"--light", "specular", "--method", "walr_paper"}), kUsage,
                {"'walr_paper'", "diffuse light only", "accumulate"});
  for (const char* const method : {"walr", "svgf"}) {
    expectFailure(denoise({"--light", "specular", "--method", method, "--set", "spatial-only=on"}), kUsage,
                  {"spatial-only", "diffuse light"});
  }
  expectFailure(denoise({"--light", "specular", "--composite"}), kUsage, {"--composite", "--light all"});
  const ProcessResult views = walr({"denoise", "--list-views", "--light", "specular", "--method", "accumulate"});
  expectSuccess(views);
  EXPECT_NE(views.out.find("reflection-motion"), std::string::npos) << views.out;
}

// The picture is lit by the lights that are written beside it, and nothing else.
TEST_F(ProgramTest, DenoisesAllLightOfAPicture) {
  const std::string scene = std::string(WALR_SCENES) + "/gloss.gltf";
  expectSuccess(walr({"render", scene, "--output", input.string(), "--frames", "8-9", "--size", "64x36", "--bounces",
                      "1", "--specular"}));
  const ProcessResult result = denoise({"--light", "all", "--method", "accumulate", "--composite"});
  expectSuccess(result);
  EXPECT_NE(result.out.find("without denoising: Emission\n"), std::string::npos) << result.out;
  const auto lit = [&](const std::string& plane) { return readPlane(output / "denoised_0009.exr", plane); };
  const auto frame = [&](const std::string& plane) { return readPlane(input / "noisy_0009.exr", plane); };
  const Image picture = lit("");
  const Image indirect = lit("Indirect");
  const Image direct = lit("Direct");
  const Image specular = lit("Specular");
  const Image albedo = frame("Albedo");
  const Image specularAlbedo = frame("SpecularAlbedo");
  const Image emission = frame("Emission");
  EXPECT_FALSE(std::ranges::equal(specular.values(), frame("Specular").values()));
  EXPECT_FALSE(std::ranges::equal(indirect.values(), frame("Indirect").values()));
  EXPECT_FALSE(std::ranges::equal(direct.values(), frame("Direct").values()));
  for (std::size_t i = 0; i < picture.values().size(); ++i) {
    const float expected = albedo.values()[i] * (indirect.values()[i] + direct.values()[i]) + emission.values()[i] +
                           specularAlbedo.values()[i] * specular.values()[i];
    // The picture is rounded to halves, the smallest of which is 2^-24.
    ASSERT_NEAR(picture.values()[i], expected, 0x1p-24F + 0x1p-10F * expected) << i;
  }
}

TEST_F(ProgramTest, NamesTheSpecularLightThatFramesLack) {
  files.write(0, 0);
  expectFailure(denoise({"--light", "specular", "--method", "accumulate"}), kInput,
                {"noisy_0000.exr", "no specular light", "--specular"});
}

TEST_F(ProgramTest, ListsViews) {
  const ProcessResult result = walr({"denoise", "--list-views", "--method", "svgf"});
  expectSuccess(result);
  for (const ViewInfo& view : makeDenoiser("svgf")->views()) {
    EXPECT_NE(result.out.find(std::string(view.name) + ": "), std::string::npos) << result.out;
  }
  EXPECT_NE(walr({"denoise", "--list-views", "--method", "none"}).out.find("no views"), std::string::npos);
}

// At this image height the filter has one iteration, so a window has at most 3 x 3 samples.
TEST_F(ProgramTest, WritesViewsBesideTheResult) {
  files.write(0, 1);
  expectSuccess(denoise({"--method", "walr_paper", "--preset", "robust", "--view", "samples", "--view", "edges.0"}));
  const std::vector<std::string> expected = {"denoised_0000.exr",     "denoised_0001.exr",     "view_edges.0_0000.exr",
                                             "view_edges.0_0001.exr", "view_samples_0000.exr", "view_samples_0001.exr"};
  EXPECT_EQ(outputFiles(), expected);
  ExrReader reader(output / "view_samples_0001.exr");
  Image count(reader.width(), reader.height(), 1);
  reader.read(std::vector<ExrReader::Target>{{"X", &count, 0}});
  EXPECT_TRUE(std::ranges::all_of(count.values(), [](float w) { return w >= 0.0F && w <= 9.0F; }));
  EXPECT_GT(*std::ranges::max_element(count.values()), 8.0F);
}

TEST_F(ProgramTest, CountsWhatHappensInside) {
  files.write(0, 1);
  const fs::path json = directory.path() / "report.json";
  const ProcessResult result = denoise({"--counters", "--json", json.string()});
  expectSuccess(result);
  EXPECT_NE(result.out.find("rejected-history-taps"), std::string::npos) << result.out;
  EXPECT_EQ(test::schemaTroubles("samples/denoise/denoise.schema.json", json), "");
  const auto report = nlohmann::json::parse(test::readText(json));
  EXPECT_EQ(report["frames"][1]["counters"]["non-finite-lighting"], 0);
  EXPECT_GT(report["frames"][0]["counters"]["no-history"], 0);
  expectFailure(denoise({"--method", "walr_paper", "--preset", "robust", "--view", "edges.3"}), kUsage,
                {"view \"edges.3\"", "0 to 0"});
  expectSuccess(denoise({"--method", "none", "--counters"}));
}

TEST_F(ProgramTest, ResultsOfMovingCropsLieOverTheirFrames) {
  files.writeCameras(0, 1);
  const Imath::Box2i display{{0, 0}, {23, 17}};
  writeCycles(input / "f0.exr", {.channels = {}, .data = {{2, 1}, {17, 12}}}, display);
  writeCycles(input / "f1.exr", {.channels = {}, .data = {{6, 3}, {23, 14}}}, display);
  const ProcessResult result = denoise({"--method", "none"});
  expectSuccess(result);
  EXPECT_NE(result.out.find("within 22 x 14 pixels from (2, 1) of the picture of 24 x 18"), std::string::npos)
      << result.out;
  const ExrReader denoised(output / "denoised_0001.exr");
  EXPECT_EQ(denoised.dataWindow(), (PixelRect{{6, 3}, {18, 12}}));
  EXPECT_EQ(denoised.displayWindow(), (PixelRect{{0, 0}, {24, 18}}));
  // The method gives the input back, rounded to halves, which the values are.
  EXPECT_EQ(readPlane(output / "denoised_0001.exr").at(0, 0, 2), test::valueAt(6, 3, 4));
  expectFailure(denoise({"--average", "2"}), kUsage, {"--average", "data window"});
}

TEST_F(ProgramTest, RendersLintsAndDenoisesSparseLight) {
  const std::string scene = std::string(WALR_SCENES) + "/box.gltf";
  expectSuccess(walr({"render", scene, "--output", input.string(), "--frames", "4-7", "--size", "97x55", "--jitter",
                      "--light-rate", "1/4"}));
  expectSuccess(walr({"lint", input.string()}));
  expectSuccess(walr({"denoise", input.string(), "--output", output.string()}));
  expectFailure(walr({"denoise", input.string(), "--output", output.string(), "--method", "svgf"}), kUsage,
                {"method 'svgf' needs a sample of light at every pixel"});
}

TEST_F(ProgramTest, DenoisesWithAShareOfTheSamples) {
  files.write(0, 2);
  expectSuccess(denoise({"--method", "accumulate"}));
  const Image all = readPlane(output / "denoised_0002.exr", "Indirect");
  const ProcessResult result = denoise({"--method", "accumulate", "--light-rate", "1/4"});
  expectSuccess(result);
  EXPECT_NE(result.out.find("one sample in 2 x 2 pixels"), std::string::npos) << result.out;
  EXPECT_FALSE(std::ranges::equal(readPlane(output / "denoised_0002.exr", "Indirect").values(), all.values()));
  expectFailure(denoise({"--method", "svgf", "--light-rate", "1/4"}), kUsage,
                {"needs a sample of light at every pixel"});
}

TEST_F(ProgramTest, MethodNoneGivesTheInputBack) {
  files.write(0, 1);
  expectSuccess(denoise({"--method", "none"}));
  const Image in = readPlane(files.frameFile(1), "DiffInd");
  const Image out = readPlane(output / "denoised_0001.exr");
  EXPECT_TRUE(std::ranges::equal(in.values(), out.values()));
}

TEST_F(ProgramTest, WritesAndMeasuresAveragedPictures) {
  files.write(0, 1);
  expectSuccess(denoise({"--method", "accumulate"}));
  const Image fine = readPlane(output / "denoised_0001.exr");
  const fs::path json = directory.path() / "report.json";
  const ProcessResult result = denoise({"--method", "accumulate", "--average", "3", "--json", json.string(), "--png"});
  expectSuccess(result);
  EXPECT_NE(result.out.find("pictures: 8 x 6, means over 3 x 3 pixels"), std::string::npos) << result.out;
  EXPECT_EQ(test::schemaTroubles("samples/denoise/denoise.schema.json", json), "");
  const auto report = nlohmann::json::parse(test::readText(json));
  EXPECT_EQ(report["average"], 3);
  EXPECT_GT(report["mean"]["rmse"], 0.0);
  const Image picture = readPlane(output / "denoised_0001.exr");
  ASSERT_EQ(picture.width(), 8);
  ASSERT_EQ(picture.height(), 6);
  double sum = 0.0;
  for (int y = 9; y < 12; ++y) {
    for (int x = 6; x < 9; ++x) sum += fine.at(x, y, 1) / 9.0;
  }
  // Both the mean and its parts are rounded to halves.
  EXPECT_NEAR(picture.at(2, 3, 1), sum, 2.0 * sum * 0x1p-11);
  expectFailure(denoise({"--average", "5"}), kUsage,
                {"--average: squares of 5 x 5 pixels do not fill frames of 24 x 18"});
  expectFailure(denoise({"--average", "0"}), kUsage, {"--average"});
}

TEST_F(ProgramTest, TheSkyComesOutAsItWentIn) {
  files.writeCameras(0, 0);
  files.writeFrame(0, [](Channels& channels) { channels.at("DiffInd.G").at(7, 0, 0) = 0.75F; });
  expectSuccess(denoise());
  const Image out = readPlane(output / "denoised_0000.exr");
  for (int x = 0; x < out.width(); ++x) {
    EXPECT_EQ(out.at(x, 0, 0), 0.0F);
    EXPECT_EQ(out.at(x, 0, 1), x == 7 ? 0.75F : 0.0F);
  }
}

TEST_F(ProgramTest, TwoRunsGiveTheSameBytes) {
  files.write(0, 2);
  const auto run = [&] {
    expectSuccess(denoise());
    return test::readText(output / "denoised_0002.exr");
  };
  EXPECT_EQ(run(), run());
}

TEST_F(ProgramTest, WritesAComposite) {
  files.write(0, 0);
  const ProcessResult result = denoise({"--composite"});
  expectSuccess(result);
  EXPECT_EQ(ExrReader(output / "denoised_0000.exr").channels(),
            (std::vector<std::string>{"B", "DiffDir.B", "DiffDir.G", "DiffDir.R", "DiffInd.B", "DiffInd.G", "DiffInd.R",
                                      "G", "R"}));
  const std::string said = "added as they are, without denoising: Emit\n";
  EXPECT_NE(result.out.find(said), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find(said), result.out.rfind(said)) << "said once";
  EXPECT_NE(result.out.find("the frames have no Env, GlossDir, GlossInd"), std::string::npos) << result.out;
}

// Combined is what Blender says it is: the sum of the passes, each light multiplied by its colour.
TEST_F(ProgramTest, ACompositeThatIsNotDenoisedIsBlendersCombined) {
  const int width = 5;
  const int height = 4;
  const SyntheticSequence small{input, width, height};
  small.writeCameras(0, 0);
  std::mt19937 random(7);
  std::map<std::string, std::vector<double>> combined;
  small.writeFrame(0, [&](Channels& channels) {
    const auto fill = [&](const std::string& plane, float largest) {
      for (const char* const colour : {".R", ".G", ".B"}) {
        Image& image = channels["ViewLayer." + plane + colour] = Image(width, height, 1);
        for (float& value : image.values()) value = largest * static_cast<float>(random() % 1024) / 1024.0F;
      }
    };
    for (const char* const guide : {"Normal.X", "Normal.Y", "Normal.Z", "Depth.Z", "Vector.X", "Vector.Y"}) {
      channels[std::string("ViewLayer.") + guide] = channels.at(guide);
    }
    std::erase_if(channels, [](const auto& channel) { return !channel.first.starts_with("ViewLayer."); });
    for (const char* const colour : {"DiffCol", "GlossCol", "TransCol"}) fill(colour, 1.0F);
    for (const char* const light : {"DiffDir", "DiffInd", "GlossDir", "GlossInd", "TransDir", "TransInd", "VolumeDir",
                                    "VolumeInd", "Emit", "Env"}) {
      fill(light, 8.0F);
    }
    channels["ViewLayer.Roughness.X"] = Image(width, height, 1);
    for (const char* const colour : {".R", ".G", ".B"}) {
      const auto value = [&](const char* plane, std::size_t i) {
        return double{channels.at(std::string("ViewLayer.") + plane + colour).values()[i]};
      };
      for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
        combined[colour].push_back(value("DiffCol", i) * (value("DiffDir", i) + value("DiffInd", i)) +
                                   value("GlossCol", i) * (value("GlossDir", i) + value("GlossInd", i)) +
                                   value("TransCol", i) * (value("TransDir", i) + value("TransInd", i)) +
                                   value("VolumeDir", i) + value("VolumeInd", i) + value("Emit", i) + value("Env", i));
      }
    }
  });
  const auto expectCombined = [&] {
    ExrReader reader(output / "denoised_0000.exr");
    for (const std::string colour : {"R", "G", "B"}) {
      Image lit(width, height, 1);
      reader.read(std::vector<ExrReader::Target>{{colour, &lit, 0}});
      for (std::size_t i = 0; i < lit.values().size(); ++i) {
        const double expected = combined["." + colour][i];
        // Half floats round the denoised lights on their way through the device, and the sum: 2^-11 each, relatively.
        EXPECT_NEAR(lit.values()[i], expected, 2.0 * 0x1p-11 * expected) << colour << i;
      }
    }
  };
  Channels reflected;
  for (const char* const channel : {"GlossDir.R", "GlossDir.G", "Emit.R", "Emit.G"}) {
    reflected[std::string("ViewLayer.") + channel] = Image(width, height, 1);
  }
  const std::filesystem::path specularFile = input / "specular_0000.exr";
  for (const bool specular : {false, true}) {
    test::writeChannels(specularFile, reflected);
    std::vector<std::string> arguments{"--method", "none", "--composite"};
    if (specular) arguments.insert(arguments.end(), {"--light", "all"});
    for (const bool hasDistances : {true, false}) {
      if (!hasDistances) std::filesystem::remove(specularFile);
      const ProcessResult result = denoise(arguments);
      expectSuccess(result);
      EXPECT_EQ(result.out.find("the frames have no") == std::string::npos, hasDistances || !specular) << result.out;
      expectCombined();
    }
  }
}

TEST_F(ProgramTest, DenoisesBothLightsAsEachAlone) {
  files.write(0, 2);
  const auto noisyDirect = [](Channels& channels) {
    for (const char* const colour : {".R", ".G", ".B"}) {
      channels[std::string("DiffDir") + colour] = channels.at(std::string("DiffInd") + colour);
      for (float& value : channels[std::string("DiffDir") + colour].values()) value *= 0.5F;
    }
  };
  for (const int frame : {0, 1, 2}) files.writeFrame(frame, noisyDirect);
  const fs::path json = directory.path() / "report.json";
  const auto run = [&](const char* light) {
    expectSuccess(denoise({"--light", light, "--json", json.string(), "--counters", "--view", "history"}));
    EXPECT_EQ(test::schemaTroubles("samples/denoise/denoise.schema.json", json), "");
    const auto report = nlohmann::json::parse(test::readText(json));
    EXPECT_EQ(report["light"], light);
    EXPECT_EQ(report.contains("direct_settings"), std::string(light) == "both");
    return report["frames"][2];
  };
  const auto values = [&](const std::string& plane) {
    const Image image = readPlane(output / "denoised_0002.exr", plane);
    return std::vector<float>(image.values().begin(), image.values().end());
  };
  const auto indirect = run("indirect");
  const std::vector<float> indirectAlone = values("Indirect");
  EXPECT_EQ(ExrReader(output / "denoised_0002.exr").channels().size(), 3U);
  const auto direct = run("direct");
  const std::vector<float> directAlone = values("Direct");
  EXPECT_EQ(ExrReader(output / "denoised_0002.exr").channels().size(), 3U);
  EXPECT_NE(directAlone, indirectAlone);
  const auto both = run("both");
  EXPECT_EQ(values("Indirect"), indirectAlone);
  EXPECT_EQ(values("Direct"), directAlone);
  EXPECT_TRUE(indirect["direct"]["rmse"].is_null());
  EXPECT_TRUE(direct["rmse"].is_null());
  EXPECT_EQ(both["rmse"], indirect["rmse"]);
  EXPECT_EQ(both["direct"], direct["direct"]);
  EXPECT_LT(both["direct"]["rmse"].get<double>(), both["direct"]["noisy"]["rmse"].get<double>());
}

TEST_F(ProgramTest, TheReferencesDirectLightIsNotDenoised) {
  files.write(0, 0);
  expectFailure(denoise({"--composite", "--direct-light", "reference", "--light", "both"}), kUsage,
                {"--direct-light reference", "--light both", "leave out one"});
  const ProcessResult result = denoise({"--composite", "--direct-light", "reference", "--method", "none"});
  expectSuccess(result);
  EXPECT_NE(result.out.find("light: indirect\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("direct light is that of the reference"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("DiffDir x DiffCol"), std::string::npos) << result.out;
  EXPECT_EQ(ExrReader(output / "denoised_0000.exr").channels().size(), 6U);
}

TEST_F(ProgramTest, SaysWhereACutIs) {
  files.write(0, 3);
  const ProcessResult result = denoise({"--cut", "2", "--method", "none"});
  expectSuccess(result);
  EXPECT_NE(result.out.find("history is reset at frame 2"), std::string::npos) << result.out;
}

// Pictures of one column or row. DenoiserTest.IsFiniteForAnyInputAndSize has them for the other methods.
TEST_F(ProgramTest, TinyAndOddSizesComeOutFinite) {
  for (const auto& [method, width, height] :
       {std::tuple("walr", 1, 5), std::tuple("svgf", 7, 1), std::tuple("walr_paper", 1, 5), std::tuple("refwlr", 7, 1),
        std::tuple("none", 7, 1)}) {
    SCOPED_TRACE(method);
    SyntheticSequence(input, width, height).write(0, 1);
    expectSuccess(denoise({"--method", method}));
    const Image out = readPlane(output / "denoised_0001.exr");
    EXPECT_EQ(out.width(), width);
    EXPECT_EQ(out.height(), height);
    expectFinite(out);
  }
}

TEST_F(ProgramTest, GraphPrintsThePlanWithoutADevice) {
  const ProcessOptions options{{{"VK_DRIVER_FILES", "/nonexistent"}, {"VK_ICD_FILENAMES", "/nonexistent"}}, {}};
  for (const std::string& method : denoiserNames()) {
    const ProcessResult result = walr({"graph", "--method", method, "--size", "640x360"}, options);
    expectSuccess(result);
    EXPECT_NE(result.out.find("640"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("denoised"), std::string::npos) << result.out;
  }
}

TEST_F(ProgramTest, GraphListsSettings) {
  const ProcessResult all = walr({"graph", "--list-settings"});
  const ProcessResult ofSpecularLight = walr({"graph", "--light", "specular", "--list-settings"});
  for (const ProcessResult* const result : {&all, &ofSpecularLight}) expectSuccess(*result);
  const auto lists = [](const ProcessResult& result, const SettingText& setting) {
    return result.out.find(setting.name + " = " + setting.value) != std::string::npos;
  };
  for (const SettingText& setting : makeDenoiser("walr")->settings()) {
    EXPECT_TRUE(lists(all, setting)) << setting.name;
    EXPECT_EQ(lists(ofSpecularLight, setting), setting.lights.specular) << setting.name;
  }
}

}  // namespace
}  // namespace walr
