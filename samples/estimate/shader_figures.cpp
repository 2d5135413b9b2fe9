#include "samples/estimate/shader_figures.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "samples/estimate/embedded_files.h"
#include "samples/estimate/json_file.h"

namespace walr {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kAbout =
    "What AMD's compiler makes of every pipeline that the methods run at default settings: instructions, fetches and "
    "waits of one wave of 64 threads. The estimates are computed from them and are no measured times. Written by "
    "`cmake --build build --target update_costs`; see tests/costs/README.md.";

FigureTable tableOf(const nlohmann::json& json) {
  FigureTable table;
  table.driver = json.at("driver");
  table.family = json.at("family");
  for (const nlohmann::json& entry : json.at("shaders")) {
    ShaderFigures figures = {.shader = entry.at("shader"),
                             .specialization = entry.at("specialization"),
                             .waves = entry.at("waves"),
                             .wave = {}};
    if (!entry.at("vector").is_null()) {
      figures.wave = WaveCounts{.vector = entry.at("vector"),
                                .multiplications = entry.at("multiplications"),
                                .transcendentals = entry.at("transcendentals"),
                                .fetches = entry.at("fetches"),
                                .waits = entry.at("waits")};
    }
    table.shaders.push_back(std::move(figures));
  }
  table.machine = json.at("machine");
  table.extent = {json.at("width"), json.at("height")};
  const auto optional = [](const nlohmann::json& value) {
    return value.is_null() ? std::nullopt : std::optional(value.get<double>());
  };
  for (const nlohmann::json& entry : json.at("estimates")) {
    table.estimates.push_back({.variant = entry.at("variant"),
                               .cyclesPerPixel = optional(entry.at("cycles_per_pixel")),
                               .megabytes = entry.at("megabytes"),
                               .memoryMegabytes = entry.at("memory_megabytes"),
                               .microseconds = optional(entry.at("microseconds"))});
  }
  return table;
}

Json toJson(const ShaderFigures& figures) {
  const auto counted = [&](double WaveCounts::*count) { return figures.wave ? Json((*figures.wave).*count) : Json(); };
  return {{"shader", figures.shader},
          {"specialization", figures.specialization},
          {"waves", figures.waves},
          {"vector", counted(&WaveCounts::vector)},
          {"multiplications", counted(&WaveCounts::multiplications)},
          {"transcendentals", counted(&WaveCounts::transcendentals)},
          {"fetches", counted(&WaveCounts::fetches)},
          {"waits", counted(&WaveCounts::waits)}};
}

Json toJson(const MethodEstimate& estimate) {
  const auto rounded = [](const std::optional<double>& value) {
    return value ? Json(std::round(10.0 * *value) / 10.0) : Json();
  };
  return {{"variant", estimate.variant},
          {"cycles_per_pixel", rounded(estimate.cyclesPerPixel)},
          {"megabytes", rounded(estimate.megabytes)},
          {"memory_megabytes", rounded(estimate.memoryMegabytes)},
          {"microseconds", rounded(estimate.microseconds)}};
}

template <typename Entry>
void writeLines(std::ostream& stream, const char* name, const std::vector<Entry>& entries) {
  stream << ",\n  \"" << name << "\": [";
  for (std::size_t i = 0; i < entries.size(); ++i) stream << (i == 0 ? "\n    " : ",\n    ") << toJson(entries[i]);
  stream << "\n  ]";
}

}  // namespace

const ShaderFigures* FigureTable::find(const fg::ComputeDispatch& dispatch) const {
  const auto found = std::ranges::find_if(shaders, [&](const ShaderFigures& figures) {
    return figures.shader == dispatch.shader->name && figures.specialization == dispatch.specialization;
  });
  return found == shaders.end() ? nullptr : &*found;
}

const FigureTable& shaderFigures() {
  static const FigureTable kTable = [] {
    FigureTable table;
    readJsonText("shader_figures.json", kShaderFiguresJson, [&](const nlohmann::json& json) { table = tableOf(json); });
    return table;
  }();
  return kTable;
}

FigureTable readFigures(const std::filesystem::path& file) {
  FigureTable table;
  readJson(file, [&](const nlohmann::json& json) { table = tableOf(json); });
  return table;
}

std::string figuresJson(const FigureTable& table) {
  std::ostringstream stream;
  stream << "{\n  \"about\": " << Json(kAbout) << ",\n  \"driver\": " << Json(table.driver)
         << ",\n  \"family\": " << Json(table.family);
  writeLines(stream, "shaders", table.shaders);
  stream << ",\n  \"machine\": " << Json(table.machine) << ",\n  \"width\": " << table.extent.width
         << ",\n  \"height\": " << table.extent.height;
  writeLines(stream, "estimates", table.estimates);
  stream << "\n}\n";
  return stream.str();
}

}  // namespace walr
