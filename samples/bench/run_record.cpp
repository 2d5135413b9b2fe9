#include "samples/bench/run_record.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "samples/bench/or_null.h"
#include "samples/image/file_output.h"
#include "samples/json_text.h"

namespace walr {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kByRoughness = "rmse_by_roughness";
constexpr const char* kCleanSquare = "clean_square";
constexpr const char* kCleanSquareByRoughness = "clean_square_by_roughness";

FiguresByRoughness readByRoughness(const Json& object, const char* name) {
  FiguresByRoughness figures;
  for (std::size_t i = 0; object.contains(name) && i < kRoughnessClasses; ++i) {
    const Json& figure = object[name].at(i);
    if (!figure.is_null()) figures.at(i) = figure.get<double>();
  }
  return figures;
}

}  // namespace

Json toJson(const RunRecord& record) {
  Json frames = Json::array();
  for (const FrameErrors& frame : record.frames) {
    Json object = {{"frame", frame.frame}, {"history_reset", frame.resetHistory}};
    for (const Metric& metric : kMetrics) object[std::string(metric.name)] = orNull(frame.*metric.figure);
    addByRoughness(object, kByRoughness, frame.byRoughness);
    if (frame.cleanSquare) object[kCleanSquare] = *frame.cleanSquare;
    addByRoughness(object, kCleanSquareByRoughness, frame.cleanSquareByRoughness);
    object["non_finite"] = frame.nonFinite;
    frames.push_back(std::move(object));
  }
  Json json = {{"variant", record.variant}, {"frames", std::move(frames)}, {"reproducible", record.reproducible}};
  addTiming(json, record.timing);
  return json;
}

RunRecord recordFromJson(const Json& json) {
  RunRecord record{.variant = json.at("variant"),
                   .frames = {},
                   .reproducible = json.at("reproducible"),
                   .timing = timingFromJson(json)};
  for (const Json& object : json.at("frames")) {
    FrameErrors frame;
    frame.frame = object.at("frame");
    frame.resetHistory = object.at("history_reset");
    for (const Metric& metric : kMetrics) {
      const Json& figure = object.at(std::string(metric.name));
      if (!figure.is_null()) frame.*metric.figure = figure.get<double>();
    }
    frame.byRoughness = readByRoughness(object, kByRoughness);
    if (object.contains(kCleanSquare)) frame.cleanSquare = object[kCleanSquare].get<double>();
    frame.cleanSquareByRoughness = readByRoughness(object, kCleanSquareByRoughness);
    frame.nonFinite = object.at("non_finite");
    record.frames.push_back(frame);
  }
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
  const std::string text = jsonText(Json{{"key", key}, {"run", toJson(record)}}, 1);
  writeFileAtomically(file(sequence, record.variant), text);
}

}  // namespace walr
