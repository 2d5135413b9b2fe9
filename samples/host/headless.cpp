#include "samples/host/headless.h"

#include <future>
#include <optional>
#include <vector>

#include "samples/image/exr.h"
#include "samples/image/png.h"
#include "samples/sequence/writer.h"

namespace walr::host {

void renderFrames(Tracer& tracer, Renderer& renderer, const FrameRange& frames, Tracer::Request request,
                  const std::function<void(const RenderedFrame&)>& use) {
  const auto traceFrame = [&](int number) {
    request.number = number;
    request.animationFrame = number;
    return tracer.hostFrame(request);
  };
  HostFrame frame = traceFrame(frames.first);
  for (int number = frames.first; number <= frames.last; ++number) {
    std::future<HostFrame> next;
    if (number < frames.last) {
      next = std::async(std::launch::async, traceFrame, number + 1);
    }
    renderer.submit(frame);
    if (renderer.full()) {
      use(*renderer.finish());
    }
    if (next.valid()) {
      frame = next.get();
    }
  }
  while (const std::optional<RenderedFrame> rest = renderer.finish()) {
    use(*rest);
  }
}

void writeRenderedFrame(const RenderedFrame& frame, fg::Extent extent, const std::filesystem::path& directory) {
  writePng(directory / frameFileName("frame", frame.number, "png"), static_cast<int>(extent.width),
           static_cast<int>(extent.height), frame.display);
  if (!frame.composite.empty()) {
    std::vector<ExrChannel> channels;
    appendChannels(channels, "", "RGB", frame.composite);
    writeExr(directory / frameFileName("frame", frame.number, "exr"), channels);
  }
}

}  // namespace walr::host
