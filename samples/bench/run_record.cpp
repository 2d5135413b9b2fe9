#include "samples/bench/run_record.h"

#include <fstream>
#include <span>

#include <nlohmann/json.hpp>

#include "samples/image/file_output.h"

namespace walr {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json spreadOrNull(const std::optional<Spread>& value) {
  return value ? toJson(*value) : Json();
}

std::optional<Spread> readSpread(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return Spread{json.at("median"), json.at("p5"), json.at("p95")};
}

}  // namespace

Json toJson(const Spread& spread) {
  return {{"median", spread.median}, {"p5", spread.p5}, {"p95", spread.p95}};
}

Json toJson(const RunRecord& record) {
  Json frames = Json::array();
  for (const FrameErrors& frame : record.frames) {
    Json object = {{"frame", frame.frame}, {"history_reset", frame.resetHistory}};
    for (const Metric& metric : kMetrics) object[std::string(metric.name)] = orNull(frame.*metric.figure);
    object["non_finite"] = frame.nonFinite;
    frames.push_back(std::move(object));
  }
  Json passes = Json::array();
  for (const PassSpread& pass : record.passes) {
    Json object = {{"name", pass.name}};
    object.update(toJson(pass.milliseconds));
    passes.push_back(std::move(object));
  }
  return {{"variant", record.variant},
          {"frames", std::move(frames)},
          {"reproducible", record.reproducible},
          {"timed_frames", record.timedFrames},
          {"milliseconds", spreadOrNull(record.milliseconds)},
          {"ratio", spreadOrNull(record.ratio)},
          {"passes", std::move(passes)}};
}

RunRecord recordFromJson(const Json& json) {
  RunRecord record{.variant = json.at("variant"),
                   .frames = {},
                   .reproducible = json.at("reproducible"),
                   .timedFrames = json.at("timed_frames"),
                   .milliseconds = readSpread(json.at("milliseconds")),
                   .ratio = readSpread(json.at("ratio")),
                   .passes = {}};
  for (const Json& object : json.at("frames")) {
    FrameErrors frame;
    frame.frame = object.at("frame");
    frame.resetHistory = object.at("history_reset");
    for (const Metric& metric : kMetrics) {
      const Json& figure = object.at(std::string(metric.name));
      if (!figure.is_null()) frame.*metric.figure = figure.get<double>();
    }
    frame.nonFinite = object.at("non_finite");
    record.frames.push_back(frame);
  }
  for (const Json& pass : json.at("passes")) record.passes.push_back({pass.at("name"), *readSpread(pass)});
  return record;
}

std::filesystem::path RunStore::file(const std::string& sequence, const std::string& variant) const {
  return folder_ / sequence / (variant + ".json");
}

std::optional<RunRecord> RunStore::find(const std::string& sequence, const std::string& variant,
                                        const std::string& key) const {
  std::ifstream stream(file(sequence, variant));
  try {
    const Json json = Json::parse(stream);
    if (json.at("key") != key) return std::nullopt;
    return recordFromJson(json.at("run"));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

void RunStore::save(const std::string& sequence, const RunRecord& record, const std::string& key) const {
  prepareOutputDirectory(folder_ / sequence);
  const std::string text = Json{{"key", key}, {"run", toJson(record)}}.dump(1) + "\n";
  writeFileAtomically(file(sequence, record.variant), std::as_bytes(std::span(text)));
}

}  // namespace walr
