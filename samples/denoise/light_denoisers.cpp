#include "samples/denoise/light_denoisers.h"

#include <array>
#include <utility>

namespace walr {
namespace {

std::vector<Denoiser*> methodsOf(std::span<const LightMethod> lights) {
  std::vector<Denoiser*> methods;
  for (const LightMethod& light : lights) methods.push_back(light.method.get());
  return methods;
}

}  // namespace

LightDenoisers::LightDenoisers(const GpuDevice& device, std::span<const LightMethod> lights, fg::Extent extent,
                               const Layout& layout, const InspectionWish& wanted, std::uint32_t framesInFlight,
                               bool objectIds)
    : shared_(std::make_shared<fg::vk::SharedObjects>(device.device().context(), device.pipelineCache() != nullptr
                                                                                     ? device.pipelineCache()->handle()
                                                                                     : VK_NULL_HANDLE)),
      light_(lights.front().light),
      together_(lights.size() > 1 && lights[1].method->sharesGuides()),
      first_(device, methodsOf(lights.first(together_ ? lights.size() : 1)), extent, layout, wanted, framesInFlight,
             objectIds, member()) {
  if (lights.size() > 1 && !together_) {
    const InspectionWish nothing;
    direct_.emplace(device, *lights[1].method, extent, layout, nothing, framesInFlight, objectIds, member());
  }
}

fg::vk::Membership LightDenoisers::member() {
  return {shared_, shared_->addMember()};
}

PackedLights LightDenoisers::pack(Frame frame) const {
  PackedLights lights{packFrame(std::move(frame), light_), {}};
  if (direct_ || together_) lights.direct = packLight(lights.packed.frame, Light::Direct);
  return lights;
}

void LightDenoisers::submit(PackedLights frame) {
  if (together_) return first_.submit(std::move(frame.packed), std::array{LightTexels(frame.direct)});
  if (direct_) direct_->submitLight(frame.packed, frame.direct);
  first_.submit(std::move(frame.packed));
}

std::optional<DenoisedFrame> LightDenoisers::finish() {
  std::optional<DenoisedFrame> done = first_.finish();
  if (!done) return done;
  if (light_ == Light::Direct) std::swap(done->indirect, done->direct);
  if (light_ == Light::Specular) std::swap(done->indirect, done->specular);
  if (direct_) {
    DenoisedPicture direct = direct_->finishPicture();
    if (done->gpuMilliseconds) *done->gpuMilliseconds += direct.milliseconds().value_or(0.0);
    done->direct = std::move(direct.lights.front());
  }
  return done;
}

}  // namespace walr
