#include "passes/stage/inspection.h"

#include <stdexcept>

#include "passes/settings/text.h"
#include "passes/stage/history_length.h"
#include "passes/stage/stage_graph.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

constexpr std::string_view kComponents = "XYZ";

std::string viewName(const ViewInfo& view, StageIteration iteration) {
  return std::string(view.name) + (iteration.count > 0 ? "." + std::to_string(iteration.index) : "");
}

bool asksFor(const std::string& wanted, const ViewInfo& view, StageIteration iteration) {
  return wanted == viewName(view, iteration) || (wanted == view.name && iteration.last());
}

}  // namespace

std::uint64_t Counter::value(std::span<const std::uint32_t> buffer) const {
  std::uint64_t sum = 0;
  for (const std::uint32_t word : words) sum += buffer[word];
  return sum;
}

void Inspection::offer(StageGraph graph, std::span<const ViewInfo> views, fg::Extent extent, const DeclareView& declare,
                       StageIteration iteration) {
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    const ViewInfo& info = views[i];
    if (iteration.index == 0) {
      known_.push_back(info);
      iterations_.push_back(iteration.count);
    }
    const std::string name = viewName(info, iteration);
    const auto write = [&](const std::string& passName, fg::Texture texture) {
      fg::PassBuilder pass = declare(passName);
      pass.appendConstant(i);
      return pass.store("outView", texture);
    };
    for (DebugView& view : views_) {
      if (!asksFor(view.name, info, iteration)) continue;
      view.texture = write("view " + view.name, view.texture);
      view.written = true;
    }
    const bool counted = !info.counters.empty() && (iteration.last() || info.countEveryIteration);
    if (!buffer_.valid() || !counted) continue;
    const fg::Texture texture = graph.texture("counted " + name, {kViewFormat, extent});
    count(graph, info, info.countEveryIteration ? name.substr(info.name.size()) : "",
          write("look at " + name, texture));
  }
}

void Inspection::count(StageGraph graph, const ViewInfo& view, const std::string& suffix, fg::Texture texture) {
  if (words_ + kComponents.size() > kCounterWords) throw std::logic_error("too many counters for their buffer");
  if (words_ == 0) {
    fg::PassBuilder clear = graph.compute("clear counters", shaders::countClear);
    clear.dispatch({1, 1});
    buffer_ = clear.store("counters", buffer_);
  }
  fg::PassBuilder pass = graph.compute("count " + std::string(view.name) + suffix, shaders::count);
  pass.sample("view", texture).constants(CountConstants{words_}).dispatch(graph.textureDesc(texture).extent);
  buffer_ = pass.update("counters", buffer_);
  for (const CounterInfo& info : view.counters) {
    Counter counter{std::string(info.name) + suffix, {}};
    for (const char component : info.components)
      counter.words.push_back(words_ + static_cast<std::uint32_t>(kComponents.find(component)));
    counters_.push_back(std::move(counter));
  }
  words_ += static_cast<std::uint32_t>(kComponents.size());
}

void Inspection::offerHistoryLength(StageGraph graph, fg::Texture accumulated, std::uint32_t channel,
                                    const LightPattern& groups) {
  if (!historyLength_.valid()) return;
  historyLength_ = addHistoryLength(graph, accumulated, channel, historyLength_, groups);
  historyLengthWritten_ = true;
}

void Inspection::requireHistoryLength() const {
  if (!historyLength_.valid() || historyLengthWritten_) return;
  throw std::invalid_argument(
      "there is no history length: with these settings the method does not accumulate light over time (spatial-only)");
}

void Inspection::offerLightDirection(const DeclareView& declare) {
  if (!lightDirection_.valid()) return;
  lightDirection_ = declare("light direction").store("outDirection", lightDirection_);
  lightDirectionWritten_ = true;
}

void Inspection::requireLightDirection() const {
  if (!lightDirection_.valid() || lightDirectionWritten_) return;
  throw std::invalid_argument(
      "there is no light direction: the method has no slopes of the light over the normal; use the method walr on "
      "diffuse light");
}

void Inspection::offerExpectedError(const DeclareView& declare) {
  if (!expectedError_.valid()) return;
  expectedError_ = declare("expected error").store("outExpectedError", expectedError_);
  expectedErrorWritten_ = true;
}

void Inspection::requireExpectedError() const {
  if (!expectedError_.valid() || expectedErrorWritten_) return;
  throw std::invalid_argument(
      "there is no expected error: use the method walr on diffuse light without spatial-only, with packed "
      "accumulation.storage, and with light whose groups have one row");
}

void Inspection::requireViews() const {
  for (const DebugView& view : views_) {
    if (view.written) continue;
    const std::string stem = view.name.substr(0, view.name.find('.'));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < known_.size(); ++i) {
      names.emplace_back(known_[i].name);
      if (stem != known_[i].name) continue;
      throw std::invalid_argument("view \"" + view.name + "\" asks for an iteration that there is not" +
                                  (iterations_[i] > 0
                                       ? "; after the dot comes 0 to " + std::to_string(iterations_[i] - 1)
                                       : ": its stage does not iterate; leave out what follows \"" + stem + "\""));
    }
    throw std::invalid_argument("there is no view \"" + view.name +
                                "\" with these settings; known views: " + (names.empty() ? "none" : join(names)));
  }
}

}  // namespace walr
