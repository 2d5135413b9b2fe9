#include "samples/denoise/light_denoisers.h"

#include <array>
#include <utility>

namespace walr {
namespace {

// Lights but the last one, if that is specular light beside others.
std::span<const LightMethod> diffuseOf(std::span<const LightMethod> lights) {
  const bool others = lights.size() > 1 && lights.back().light == Light::Specular;
  return lights.first(lights.size() - (others ? 1 : 0));
}

// Whether one denoiser denoises all these lights.
bool shareGuides(std::span<const LightMethod> lights) {
  return lights.size() > 1 && lights[1].method->sharesGuides();
}

std::vector<Denoiser*> methodsOf(std::span<const LightMethod> lights) {
  std::vector<Denoiser*> methods;
  for (const LightMethod& light : lights) methods.push_back(light.method.get());
  return methods;
}

}  // namespace

LightDenoisers::LightDenoisers(const GpuDevice& device, std::span<const LightMethod> lights, fg::Extent extent,
                               const Layout& layout, const InspectionWish& wanted, std::uint32_t framesInFlight,
                               const OptionalImages& given)
    : shared_(std::make_shared<fg::vk::SharedObjects>(device.device().context(), device.pipelines())),
      light_(lights.front().light),
      together_(shareGuides(diffuseOf(lights))),
      first_(device, methodsOf(lights.first(together_ ? 2 : 1)), extent, layout, wanted, framesInFlight, given,
             member()) {
  const InspectionWish nothing;
  const std::span<const LightMethod> diffuse = diffuseOf(lights);
  if (diffuse.size() > 1 && !together_) {
    direct_.emplace(device, *diffuse[1].method, extent, layout, nothing, framesInFlight, given, member());
  }
  if (diffuse.size() == lights.size()) return;
  specularLayout_ = std::make_unique<Layout>(layout);
  specularLayout_->conventions.specular = true;
  specularLayout_->conventions.light = {};  // Its samples are the pixels with a distance.
  specular_.emplace(device, *lights.back().method, extent, *specularLayout_, nothing, framesInFlight, given, member());
}

fg::vk::Membership LightDenoisers::member() {
  return {shared_, shared_->addMember()};
}

PackedLights LightDenoisers::pack(Frame frame) const {
  PackedLights lights{packFrame(std::move(frame), light_), {}, {}};
  if (direct_ || together_) lights.direct = packLight(lights.packed.frame, Light::Direct);
  if (specular_) lights.specular = packSpecular(lights.packed.frame);
  return lights;
}

void LightDenoisers::submit(PackedLights frame) {
  if (specular_) specular_->submitLight(frame.packed, *frame.specular);
  if (together_) return first_.submit(std::move(frame.packed), std::array{LightTexels(frame.direct)});
  if (direct_) direct_->submitLight(frame.packed, frame.direct);
  first_.submit(std::move(frame.packed));
}

std::optional<DenoisedFrame> LightDenoisers::finish() {
  std::optional<DenoisedFrame> done = first_.finish();
  if (!done) return done;
  if (light_ == Light::Direct) std::swap(done->indirect, done->direct);
  if (light_ == Light::Specular) std::swap(done->indirect, done->specular);
  const auto finishOther = [&](std::optional<GpuDenoiser>& denoiser, Image& image) {
    if (!denoiser) return;
    DenoisedPicture picture = denoiser->finishPicture();
    if (done->gpuMilliseconds) *done->gpuMilliseconds += picture.milliseconds().value_or(0.0);
    image = std::move(picture.lights.front());
  };
  finishOther(direct_, done->direct);
  finishOther(specular_, done->specular);
  return done;
}

}  // namespace walr
