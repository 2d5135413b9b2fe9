#include "samples/bench/bench_report.h"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "samples/bench/or_null.h"
#include "samples/denoise/report.h"
#include "samples/estimate/machine.h"
#include "samples/estimate/shader_figures.h"
#include "samples/json_text.h"

namespace walr {
namespace {

using Json = nlohmann::ordered_json;

Json figuresJson(const std::vector<FrameErrors>& frames,
                 std::optional<double> (*figure)(const std::vector<FrameErrors>&, const Metric&)) {
  Json object = Json::object();
  for (const Metric& metric : kMetrics) object[std::string(metric.name)] = orNull(figure(frames, metric));
  return object;
}

Json costsJson(const std::vector<PlanCosts>& costs) {
  Json list = Json::array();
  for (const PlanCosts& cost : costs) {
    list.push_back({{"width", cost.extent.width},
                    {"height", cost.extent.height},
                    {"bytes_read_per_pixel", cost.bytesReadPerPixel},
                    {"bytes_written_per_pixel", cost.bytesWrittenPerPixel},
                    {"persistent_bytes", cost.persistentBytes},
                    {"transient_unaliased_bytes", cost.transientUnaliasedBytes},
                    {"transient_peak_bytes", cost.transientPeakBytes},
                    {"estimated_microseconds", orNull(cost.estimatedMicroseconds)}});
  }
  return list;
}

Json variantsJson(const BenchReport& report) {
  Json list = Json::array();
  for (const Variant& variant : report.variants) {
    Json settings = Json::object();
    for (const auto& [name, value] : report.settings.at(variant.name)) settings[name] = value;
    list.push_back({{"name", variant.name},
                    {"method", variant.method},
                    {"preset", variant.preset},
                    {"settings", std::move(settings)},
                    {"costs", costsJson(report.costs.at(variant.name))}});
  }
  return list;
}

Json sequenceJson(const SequenceReport& sequence) {
  Json frames = Json::array();
  for (const FrameFacts& frame : sequence.frames) {
    Json object = {{"frame", frame.number},
                   {"history_reset", frame.resetHistory},
                   {"disoccluded", orNull(frame.disoccluded)},
                   {"reference_noise", orNull(frame.referenceNoise)}};
    addByRoughness(object, "reference_noise_by_roughness", frame.noiseByRoughness);
    frames.push_back(std::move(object));
  }
  Json runs = Json::array();
  for (const RunRecord& run : sequence.runs) {
    Json object = toJson(run);
    object["mean"] = figuresJson(run.frames, meanOf);
    object["mean_after_4"] = figuresJson(afterWarmUp(run.frames), meanOf);
    object["worst_after_4"] = figuresJson(afterWarmUp(run.frames), worstOf);
    addByRoughness(object, "rmse_by_roughness_after_4", meanByRoughness(afterWarmUp(run.frames)));
    runs.push_back(std::move(object));
  }
  return {{"name", sequence.name},          {"layout", sequence.layout},
          {"width", sequence.extent.width}, {"height", sequence.extent.height},
          {"frames", std::move(frames)},    {"picture_frames", sequence.pictureFrames},
          {"runs", std::move(runs)}};
}

Json cutJson(const CutResponse& cut) {
  return {{"rmse", cut.rmse}, {"left", cut.left}};
}

Json responseJson(const Response& response) {
  return {{"variant", response.variant},
          {"first_frame_rmse", response.firstFrame},
          {"settled_rmse", response.settled},
          {"settled_flicker", response.settledFlicker},
          {"light_left", response.lightLeft},
          {"light_frames", orNull(response.lightFrames)},
          {"error_by_age", response.errorByAge},
          {"trail_by_age", response.trailByAge},
          {"recovery_frames", orNull(response.recoveryFrames)},
          {"light_lag", response.lightLag},
          {"cut", cutJson(response.cut)},
          {"untold_cut", cutJson(response.untoldCut)}};
}

Json hardCaseJson(const HardCaseErrors& errors) {
  Json counters = Json::object();
  for (const CounterValue& counter : errors.counters) counters[counter.name] = counter.value;
  return {{"case", errors.hardCase},
          {"error", errors.error},
          {"non_finite_in", errors.nonFiniteIn},
          {"non_finite_out", errors.nonFiniteOut},
          {"negative_out", errors.negativeOut},
          {"counters", std::move(counters)}};
}

Json numericsJson(const NumericsResult& result) {
  Json json = hardCaseJson(result);
  json["storage"] = result.setting.storage;
  json["regularisation"] = result.setting.regularisation;
  json["epsilon"] = result.setting.epsilon;
  return json;
}

Json methodHardCaseJson(const MethodHardCase& result) {
  Json json = hardCaseJson(result);
  json["variant"] = result.variant;
  return json;
}

struct Column {
  const char* title;
  const char* metric;
  int decimals;
};
constexpr std::array kColumns = {Column{"RMSE", "rmse", 5}, Column{"SSIM", "ssim", 4}, Column{"FLIP", "flip", 4},
                                 Column{"flicker", "flicker", 5}};
constexpr int kCellWidth = 9;

std::string cell(const std::optional<double>& value, int decimals) {
  std::ostringstream text;
  text << std::setw(kCellWidth);
  if (value) {
    text << std::fixed << std::setprecision(decimals) << *value;
  } else {
    text << '-';
  }
  return text.str();
}

/// Errors by class of roughness, if there are any.
void printRoughness(std::ostream& stream, const SequenceReport& sequence, int widest) {
  if (sequence.runs.empty() || !hasFigures(meanByRoughness(sequence.runs.front().frames))) return;
  stream << std::left << std::setw(widest) << "RMSE, r to" << std::right << std::defaultfloat << std::setprecision(6);
  for (std::size_t i = 0; i < kRoughnessClasses; ++i) stream << std::setw(kCellWidth) << kRoughnessBounds.at(i + 1);
  stream << '\n';
  for (const RunRecord& run : sequence.runs) {
    stream << std::left << std::setw(widest) << run.variant;
    for (const std::optional<double>& error : meanByRoughness(afterWarmUp(run.frames))) stream << cell(error, 5);
    stream << '\n';
  }
}

void printSequence(std::ostream& stream, const SequenceReport& sequence) {
  std::size_t widest = sequence.name.size();
  for (const RunRecord& run : sequence.runs) widest = std::max(widest, run.variant.size());
  const auto name = [&](const std::string& text) {
    stream << std::left << std::setw(static_cast<int>(widest)) << text;
  };
  stream << '\n';
  name(sequence.name);
  stream << std::right;
  for (const Column& column : kColumns) stream << std::setw(kCellWidth) << column.title;
  stream << std::setw(kCellWidth) << "time x" << '\n';
  for (const RunRecord& run : sequence.runs) {
    const std::vector<FrameErrors> frames = afterWarmUp(run.frames);
    name(run.variant);
    for (const Column& column : kColumns) {
      stream << cell(meanOf(frames, *std::ranges::find(kMetrics, column.metric, &Metric::name)), column.decimals);
    }
    stream << cell(run.timing.ratio ? std::optional(run.timing.ratio->median) : std::nullopt, 3);
    const bool finite = std::ranges::all_of(run.frames, [](const FrameErrors& frame) { return frame.nonFinite == 0; });
    stream << (finite ? "" : "  NOT FINITE") << (run.reproducible ? "" : "  NOT REPRODUCIBLE") << '\n';
  }
  printRoughness(stream, sequence, static_cast<int>(widest));
}

}  // namespace

std::string benchJson(const BenchReport& report, const std::string& command) {
  Json document;
  document["schema"] = 1;
  document["command"] = command;
  document["commit"] = report.build.commit;
  document["compiler"] = report.build.compiler;
  document["build_type"] = report.build.buildType;
  const DeviceFacts& device = report.device;
  document["device"] = {{"name", device.name},
                        {"driver", device.driver},
                        {"software", device.software},
                        {"timestamp_ns", device.timestampNanoseconds}};
  const FigureTable& figures = shaderFigures();
  const Machine& machine = machineNamed(kDefaultMachine);
  document["estimate"] = {
      {"machine", machine.name}, {"gpu", machine.gpu}, {"compiler", figures.driver}, {"family", figures.family}};
  document["tone_map"] = "x/(1+x), exposure 1";
  document["baseline"] = kBaseline;
  document["repetitions"] = report.repetitions;
  document["light"] = report.specular ? "specular" : "indirect";
  document["metrics"] = Json::array();
  for (const Metric& metric : kMetrics) {
    constexpr std::array kBetter = {"lower", "higher", "as_reference"};
    document["metrics"].push_back({{"name", metric.name},
                                   {"better", kBetter.at(static_cast<std::size_t>(metric.better))},
                                   {"description", metric.description}});
  }
  document["variants"] = variantsJson(report);
  document["sequences"] = Json::array();
  for (const SequenceReport& sequence : report.sequences) document["sequences"].push_back(sequenceJson(sequence));
  document["responses"] = Json::array();
  for (const Response& response : report.responses) document["responses"].push_back(responseJson(response));
  document["hard_cases"] = Json::array();
  for (const NumericsResult& result : report.numerics) document["hard_cases"].push_back(numericsJson(result));
  document["method_hard_cases"] = Json::array();
  for (const MethodHardCase& result : report.methodHardCases) {
    document["method_hard_cases"].push_back(methodHardCaseJson(result));
  }
  return jsonText(document, 1);
}

void printSummary(std::ostream& stream, const BenchReport& report) {
  for (const SequenceReport& sequence : report.sequences) printSequence(stream, sequence);
  if (report.sequences.empty()) return;
  stream << "\nMeans over the frames after the first " << kWarmUpFrames
         << ", or all if there are no more; time x: median ratio of the time to " << kBaseline << "'s on the same frame"
         << (report.device.software ? ", CPU times, not those of a GPU" : "") << ".\n";
}

}  // namespace walr
