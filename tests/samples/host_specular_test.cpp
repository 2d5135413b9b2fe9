// Specular light in the sample host: traced as `walr render` traces it, and shown in all lit images.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "passes/methods/denoiser.h"
#include "samples/command_line/usage_error.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/host/headless.h"
#include "samples/host/renderer.h"
#include "samples/host/tracer.h"
#include "samples/image/half.h"
#include "samples/image/tone_map.h"
#include "samples/render/render_sequence.h"
#include "samples/sequence/sequence.h"
#include "tests/error_text.h"
#include "tests/samples/host_tracing.h"
#include "tests/samples/temporary_directory.h"

namespace walr::host {
namespace {

Tracer::Options specularTracing() {
  Tracer::Options options = tracing("gloss.gltf");
  options.camera = "mirror";  // A mirror fills the centre, and the floor reflects, too.
  options.specular = true;
  return options;
}

// A mirror is in it as another surface, and the mirror's own light is not.
TEST(HostSpecular, TracesAsWalrRenderDoes) {
  const test::TemporaryDirectory folder;
  render::RenderOptions options;
  Tracer::Options tracerOptions = specularTracing();
  tracerOptions.gbuffer = render::GBufferMode::BehindMirrors;
  options.scene = tracerOptions.scene;
  options.camera = tracerOptions.camera;
  options.output = folder.path();
  options.lastFrame = 2;
  options.width = kExtent.width;
  options.height = kExtent.height;
  options.specular = options.replaceMirrors = true;
  render::renderSequence(options, {});
  SequenceOptions reading;
  reading.light = kWholePicture;
  reading.light.specular = SpecularWish::IfHeld;
  const Sequence sequence(folder.path(), reading);
  Tracer tracer(tracerOptions);
  for (int number = 0; number <= options.lastFrame; ++number) {
    const Frame frame = tracer.trace({.number = number, .animationFrame = double(number)});
    const Frame expected = sequence.read(static_cast<std::size_t>(number));
    const auto expectSame = [&](Image Frame::*image, const char* name) {
      EXPECT_TRUE(std::ranges::equal(inHalves(frame.*image).values(), inHalves(expected.*image).values()))
          << name << ", frame " << number;
    };
    expectSame(&Frame::indirect, "indirect");
    expectSame(&Frame::albedo, "albedo");
    expectSame(&Frame::normal, "normal");
    expectSame(&Frame::depth, "depth");
    expectSame(&Frame::specular, "specular");
    expectSame(&Frame::specularAlbedo, "specular albedo");
    if (number > 0) expectSame(&Frame::motion, "motion");  // The host's first frame has no previous one.
  }
}

/// The lit image with specular light, from values in the precision of the textures.
Image litWithSpecular(const Image& indirect, const Image& direct, const Image& specular, const Frame& frame) {
  Image lit = composite(inHalves(indirect), inHalves(direct), inHalves(frame.albedo), inHalves(frame.emission));
  for (std::size_t i = 0; i < lit.values().size(); ++i) {
    lit.values()[i] += toHalf(specular.values()[i]) * toHalf(frame.specularAlbedo.values()[i]);
  }
  return lit;
}

// In the noisy, the denoised and the reference's picture.
TEST(HostSpecular, LightIsInEveryLitImage) {
  GpuDevice gpu{{.device = "", .validation = true}};
  Tracer tracer(specularTracing());
  const std::unique_ptr<Denoiser> none = makeDenoiser("none");
  const Frame frame = tracer.trace({.reference = true});
  const Image noisy = litWithSpecular(frame.indirect, frame.direct, frame.specular, frame);
  const Image reference =
      litWithSpecular(frame.reference->indirect, frame.reference->direct, frame.reference->specular, frame);
  EXPECT_FALSE(std::ranges::equal(frame.specular.values(), frame.reference->specular.values()));
  for (const HostView::Kind kind : {HostView::Kind::Denoised, HostView::Kind::Noisy, HostView::Kind::Reference}) {
    Renderer renderer(gpu, *none, kExtent, {.view = {kind}, .specular = true});
    renderer.submit(packHostFrame(frame));
    const RenderedFrame shown = renderer.finish().value();
    const Image& expected = kind == HostView::Kind::Reference ? reference : noisy;
    for (std::size_t i = 0; i < expected.values().size(); ++i) {
      const std::uint32_t byte = shown.display[i / 3] >> (8U * (i % 3)) & 0xFFU;
      // The error of rounding to a byte, and half a step for an imprecise power function of the device.
      ASSERT_NEAR(static_cast<float>(byte), 255.0F * encodeSrgb(toneMap(expected.values()[i])), 1.0F)
          << "view " << static_cast<int>(kind) << ", value " << i;
    }
  }
  gpu.refuseMessages();
}

TEST(HostSpecular, LightIsDenoisedByMethodsThatTakeIt) {
  GpuDevice gpu{{.device = "", .validation = true}};
  const std::unique_ptr<Denoiser> accumulate = makeDenoiser("accumulate");
  ASSERT_TRUE(accumulate->takesSpecularLight());
  Layout specularLayout = projectLayout();
  specularLayout.conventions.specular = true;
  GpuDenoiser diffuse(gpu, *accumulate, kExtent, projectLayout());
  GpuDenoiser specular(gpu, *accumulate, kExtent, specularLayout, {}, 1, {.specularMotion = true});
  Renderer renderer(gpu, *accumulate, kExtent, {.readComposite = true, .specular = true});
  Tracer tracer(specularTracing());
  for (int number = 0; number < 3; ++number) {
    Frame frame = tracer.trace({.number = number, .animationFrame = double(number)});
    renderer.submit(packHostFrame(frame));
    frame.objectId = Image();  // The host's graph takes object numbers, which change nothing at these settings.
    const Image shown = renderer.finish().value().composite;
    const Image indirect = diffuse.run(packFrame(frame)).lights.front();
    const Image reflected = specular.run(packFrame(frame, Light::Specular)).lights.front();
    const Image expected = litWithSpecular(indirect, frame.direct, reflected, frame);
    EXPECT_EQ(std::ranges::equal(reflected.values(), inHalves(frame.specular).values()), number == 0);
    for (std::size_t i = 0; i < expected.values().size(); ++i) {
      // The picture is rounded to halves, the smallest of which is 2^-24.
      ASSERT_NEAR(shown.values()[i], expected.values()[i], 0x1p-24F + 0x1p-10F * expected.values()[i])
          << number << ", value " << i;
    }
  }
  gpu.refuseMessages();
}

TEST(HostSpecular, ReferencesAddUp) {
  Tracer::Options options = specularTracing();
  Tracer tracer(options);
  const Image first = tracer.trace({.reference = true}).reference->specular;
  const Image second = tracer.trace({.number = 1, .reference = true}).reference->specular;
  options.referenceSamples = 2;
  const Image both = Tracer(options).trace({.reference = true}).reference->specular;
  for (std::size_t i = 0; i < both.values().size(); ++i) {
    // Sums of the same two samples in single and in double precision.
    ASSERT_NEAR(second.values()[i], both.values()[i], 1e-5F * (1.0F + both.values()[i]));
  }
  EXPECT_FALSE(std::ranges::equal(first.values(), second.values()));
}

TEST(HostSpecular, RefusesWhatHasNoMeaning) {
  GpuDevice gpu{{.device = ""}};
  const std::unique_ptr<Denoiser> walr = makeDenoiser("walr");
  fg::test::expectError<UsageError>([&] { Renderer(gpu, *walr, kExtent, {.light = {.columns = 2}, .specular = true}); },
                                    {"--specular", "--light-rate"});
  EXPECT_NE(Tracer(specularTracing()).whyNotResampled().find("--specular"), std::string::npos);
}

}  // namespace
}  // namespace walr::host
