#include "tests/passes/counted_run.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace walr::test {

CountedRun::CountedRun(const fg::test::TestDevice& device, Denoiser& method, glm::ivec2 size,
                       const std::vector<std::string>& views)
    : size_(size), inputs_(importInputs(graph_, size)), output_(importOutput(graph_, size)) {
  const fg::Extent extent{static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)};
  inspection_.wantCounters(graph_.import("counters", fg::BufferDesc{kCounterBytes}, fg::vk::kOverwritable));
  for (const std::string& view : views)
    inspection_.want(view, graph_.import("view of " + view, {kViewFormat, extent}, fg::vk::kOverwritable));
  graph_.exported(method.add({graph_, inspection_}, inputs_, output_), fg::vk::kReadable);
  for (const DebugView& view : inspection_.views()) graph_.exported(view.texture, fg::vk::kReadable);
  graph_.exported(inspection_.counterBuffer(), fg::vk::kReadable);
  run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
}

std::uint32_t CountedRun::submit(const reference::HostFrame& frame) {
  upload(*run_, inputs_, frame);
  return run_->submitFrame();
}

CountedRun::Counts CountedRun::count(const reference::HostFrame& frame) {
  const std::uint32_t slot = submit(frame);
  finish();
  return counters(slot);
}

CountedRun::Counts CountedRun::counters(std::uint32_t slot) const {
  const std::vector<std::uint32_t> words = run_->elements<std::uint32_t>(inspection_.counterBuffer(), slot);
  Counts values;
  for (const Counter& counter : inspection_.counters()) values[counter.name] = counter.value(words);
  return values;
}

double CountedRun::viewSum(std::size_t view, int component) const {
  const std::vector<float> texels = run_->texels<float>(inspection_.views()[view].texture);
  double sum = 0.0;
  for (std::size_t i = component; i < texels.size(); i += 4) sum += texels[i];
  return sum;
}

void CountedRun::expectSumsOfViews(const Counts& counted) const {
  for (std::size_t v = 0; v < inspection_.views().size(); ++v) {
    const auto& known = inspection_.known();
    const auto info = std::ranges::find(known, inspection_.views()[v].name, &ViewInfo::name);
    ASSERT_NE(info, known.end());
    for (const CounterInfo& counter : info->counters) {
      double sum = 0.0;
      for (const char component : counter.components) sum += viewSum(v, component - 'X');
      EXPECT_EQ(double(counted.at(std::string(counter.name))), sum) << counter.name;
    }
  }
}

}  // namespace walr::test
