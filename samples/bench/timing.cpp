#include "samples/bench/timing.h"

#include <nlohmann/json.hpp>

namespace walr {
namespace {

using Json = nlohmann::ordered_json;

Json spreadOrNull(const std::optional<Spread>& value) {
  return value ? toJson(*value) : Json();
}

std::optional<Spread> readSpread(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return Spread{json.at("median"), json.at("p5"), json.at("p95")};
}

}  // namespace

void FrameTimes::add(std::span<const fg::vk::PassTime> passes) {
  if (passes.empty()) return;
  names_.resize(passes.size());
  passes_.resize(passes.size());
  double sum = 0.0;
  for (std::size_t pass = 0; pass < passes.size(); ++pass) {
    names_[pass] = passes[pass].name;
    passes_[pass].push_back(passes[pass].milliseconds);
    sum += passes[pass].milliseconds;
  }
  milliseconds_.push_back(sum);
}

Timing FrameTimes::timing(const FrameTimes& baseline) const {
  Timing all = timing();
  if (milliseconds_.empty()) return all;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < milliseconds_.size(); ++i) {
    ratios.push_back(milliseconds_[i] / baseline.milliseconds_[i]);
  }
  all.ratio = spread(ratios);
  return all;
}

Timing FrameTimes::timing() const {
  Timing timing;
  timing.frames = milliseconds_.size();
  if (milliseconds_.empty()) return timing;
  timing.milliseconds = spread(milliseconds_);
  for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
    timing.passes.push_back({names_[pass], spread(passes_[pass])});
  }
  return timing;
}

Json toJson(const Spread& spread) {
  return {{"median", spread.median}, {"p5", spread.p5}, {"p95", spread.p95}};
}

void addTiming(Json& object, const Timing& timing) {
  object["timed_frames"] = timing.frames;
  object["milliseconds"] = spreadOrNull(timing.milliseconds);
  object["ratio"] = spreadOrNull(timing.ratio);
  object["passes"] = Json::array();
  for (const PassSpread& pass : timing.passes) {
    Json json = {{"name", pass.name}};
    json.update(toJson(pass.milliseconds));
    object["passes"].push_back(std::move(json));
  }
}

Timing timingFromJson(const Json& object) {
  Timing timing{object.at("timed_frames"), readSpread(object.at("milliseconds")), readSpread(object.at("ratio")), {}};
  for (const Json& pass : object.at("passes")) timing.passes.push_back({pass.at("name"), *readSpread(pass)});
  return timing;
}

}  // namespace walr
