#include "samples/bench/bench_report.h"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "samples/bench/or_null.h"
#include "samples/denoise/report.h"

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
                    {"taps_per_pixel", orNull(cost.tapsPerPixel)},
                    {"persistent_bytes", cost.persistentBytes},
                    {"transient_unaliased_bytes", cost.transientUnaliasedBytes},
                    {"transient_peak_bytes", cost.transientPeakBytes}});
  }
  return list;
}

/// Whether a variant is its method with its preset, whatever it is called.
bool isDefault(const BenchReport& report, const Variant& variant) {
  Variant untouched;
  untouched.method = variant.method;
  untouched.preset = variant.preset;
  return report.settings.at(variant.name) == settingsOf(untouched);
}

Json variantsJson(const BenchReport& report) {
  Json list = Json::array();
  for (const Variant& variant : report.variants) {
    Json settings = Json::object();
    for (const auto& [name, value] : report.settings.at(variant.name)) settings[name] = value;
    list.push_back({{"name", variant.name},
                    {"method", variant.method},
                    {"preset", variant.preset},
                    {"sweep", variant.sweep},
                    {"is_default", isDefault(report, variant)},
                    {"settings", std::move(settings)},
                    {"costs", costsJson(report.costs.at(variant.name))}});
  }
  return list;
}

Json sequenceJson(const SequenceReport& sequence) {
  Json frames = Json::array();
  for (const FrameFacts& frame : sequence.frames) {
    frames.push_back({{"frame", frame.number},
                      {"history_reset", frame.resetHistory},
                      {"disoccluded", orNull(frame.disoccluded)},
                      {"reference_noise", orNull(frame.referenceNoise)}});
  }
  Json runs = Json::array();
  for (const RunRecord& run : sequence.runs) {
    Json object = toJson(run);
    object["mean"] = figuresJson(run.frames, meanOf);
    object["mean_after_4"] = figuresJson(afterWarmUp(run.frames), meanOf);
    object["worst_after_4"] = figuresJson(afterWarmUp(run.frames), worstOf);
    runs.push_back(std::move(object));
  }
  return {{"name", sequence.name},          {"layout", sequence.layout},
          {"width", sequence.extent.width}, {"height", sequence.extent.height},
          {"frames", std::move(frames)},    {"picture_frames", sequence.pictureFrames},
          {"runs", std::move(runs)}};
}

Json sizeJson(const SizeTimes& size) {
  Json timings = Json::array();
  for (const SizeTiming& timing : size.timings) {
    Json object = {{"variant", timing.variant}};
    addTiming(object, timing.timing);
    object["why_not"] = timing.whyNot.empty() ? Json() : Json(timing.whyNot);
    timings.push_back(std::move(object));
  }
  return {{"width", size.extent.width}, {"height", size.extent.height}, {"timings", std::move(timings)}};
}

Json contentJson(const ContentTimes& times) {
  Json list = Json::array();
  for (std::size_t i = 0; i < times.timings.size(); ++i) {
    Json object = {{"content", contents()[i].name}};
    addTiming(object, times.timings[i]);
    list.push_back(std::move(object));
  }
  return {{"variant", times.variant}, {"timings", std::move(list)}};
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

/// Costs at the size of a sequence.
const PlanCosts& costsAt(const BenchReport& report, const std::string& variant, fg::Extent extent) {
  return *std::ranges::find(report.costs.at(variant), extent, &PlanCosts::extent);
}

double bytesPerPixel(const PlanCosts& costs) {
  return costs.bytesReadPerPixel + costs.bytesWrittenPerPixel;
}

std::string cell(const std::optional<double>& value, int width, int decimals) {
  std::ostringstream text;
  text << std::setw(width);
  if (value) {
    text << std::fixed << std::setprecision(decimals) << *value;
  } else {
    text << '-';
  }
  return text.str();
}

struct Column {
  const char* title;
  const char* metric;
  int decimals;
};
constexpr std::array kColumns = {
    Column{"RMSE", "rmse", 5}, Column{"PSNR", "psnr", 2},           Column{"SSIM", "ssim", 4},
    Column{"FLIP", "flip", 4}, Column{"relMSE", "relative_mse", 4}, Column{"flicker", "flicker", 5},
    Column{"VMAF", "vmaf", 1}};
constexpr int kCellWidth = 9;

const Metric& metricOf(const char* name) {
  return *std::ranges::find(kMetrics, name, &Metric::name);
}

int widestName(const BenchReport& report) {
  std::size_t widest = 8;
  for (const Variant& variant : report.variants) widest = std::max(widest, variant.name.size());
  return static_cast<int>(widest);
}

std::string frames(const std::optional<int>& count) {
  return count ? std::to_string(*count) : "not by end";
}

void printResponses(std::ostream& stream, const BenchReport& report) {
  const int nameWidth = widestName(report) + 1;
  const auto columns = [&stream](std::initializer_list<std::string> cells) {
    for (const std::string& text : cells) stream << std::setw(14) << text;
    stream << '\n';
  };
  stream << '\n' << std::left << std::setw(nameWidth) << "response" << std::right;
  columns({"first RMSE", "settled RMSE", "flicker", "light, frames", "light lag", "recovery", "trail at 0",
           "left by cut", "untold cut"});
  for (const Response& response : report.responses) {
    stream << std::left << std::setw(nameWidth) << response.variant << std::right;
    columns({cell(response.firstFrame, 1, 4), cell(response.settled, 1, 4), cell(response.settledFlicker, 1, 5),
             frames(response.lightFrames), cell(response.lightLag, 1, 1), frames(response.recoveryFrames),
             cell(response.trailByAge.front(), 1, 3), cell(response.cut.left, 1, 3),
             cell(response.untoldCut.left, 1, 3)});
  }
  stream
      << "Synthetic scenes with a known answer: frames until a tenth of a light that went down is left, by how many "
         "frames a moving light lags, and frames until the error behind a moving slab is within a quarter of what it "
         "is elsewhere; share of the slab's light, and of the picture before a camera cut, told and not, that is left "
         "on the first frame.\n";
}

/// Worst case only of some results: the report has the whole table.
template <typename Result, typename Describe>
void printHardCases(std::ostream& stream, const std::string& what, const std::vector<Result>& results,
                    Describe describe) {
  std::size_t nonFinite = 0;
  std::size_t negative = 0;
  const Result* worst = &results.front();
  for (const Result& result : results) {
    nonFinite += result.nonFiniteOut;
    negative += result.negativeOut;
    if (!(result.error <= worst->error)) worst = &result;
  }
  stream << "\nhard cases, " << what << ": " << results.size() << " runs, " << nonFinite
         << " values that are not finite, " << negative << " below 0; largest relative error " << worst->error << ": "
         << worst->hardCase << ", " << describe(*worst) << ".\n";
}

/// Median of the ratio, and where 5 and 95 % of it lie.
void printRatio(std::ostream& stream, const std::optional<Spread>& ratio) {
  stream << cell(ratio ? std::optional(ratio->median) : std::nullopt, kCellWidth, 3);
  std::ostringstream range;
  if (ratio) range << std::fixed << std::setprecision(2) << '(' << ratio->p5 << " to " << ratio->p95 << ')';
  stream << std::setw(17) << range.str();
}

void printSize(std::ostream& stream, const BenchReport& report, const SizeTimes& size) {
  const int nameWidth = widestName(report) + 1;
  stream << '\n'
         << std::left << std::setw(nameWidth)
         << std::to_string(size.extent.width) + " x " + std::to_string(size.extent.height) << std::right
         << std::setw(kCellWidth) << "time x"
         << "    (5 to 95 %) " << (report.device.software ? "" : "       ms") << '\n';
  for (const SizeTiming& timing : size.timings) {
    stream << std::left << std::setw(nameWidth) << timing.variant << std::right;
    if (timing.whyNot.empty()) {
      printRatio(stream, timing.timing.ratio);
      const std::optional<Spread>& time = timing.timing.milliseconds;
      if (!report.device.software) stream << cell(time ? std::optional(time->median) : std::nullopt, kCellWidth, 3);
    } else {
      stream << "  " << timing.whyNot;
    }
    stream << '\n';
  }
}

void printContents(std::ostream& stream, const BenchReport& report) {
  const int nameWidth = widestName(report) + 1;
  stream << '\n' << std::left << std::setw(nameWidth) << "time x, by content" << std::right;
  for (const Content& content : contents()) stream << std::setw(kCellWidth + 2) << content.name;
  stream << '\n';
  for (const ContentTimes& times : report.contents) {
    stream << std::left << std::setw(nameWidth) << times.variant << std::right;
    for (const Timing& timing : times.timings) {
      stream << cell(timing.ratio ? std::optional(timing.ratio->median) : std::nullopt, kCellWidth + 2, 3);
    }
    stream << '\n';
  }
}

void printSequence(std::ostream& stream, const BenchReport& report, const SequenceReport& sequence) {
  const int nameWidth = widestName(report) + 1;
  stream << '\n' << std::left << std::setw(nameWidth) << sequence.name << std::right;
  for (const Column& column : kColumns) stream << std::setw(kCellWidth) << column.title;
  stream << std::setw(kCellWidth) << "time x"
         << "    (5 to 95 %) " << (report.device.software ? "" : "       ms") << std::setw(kCellWidth) << "B/pixel"
         << std::setw(kCellWidth) << "taps" << std::setw(kCellWidth) << "MB" << '\n';
  for (const RunRecord& run : sequence.runs) {
    const std::vector<FrameErrors> frames = afterWarmUp(run.frames);
    stream << std::left << std::setw(nameWidth) << run.variant << std::right;
    for (const Column& column : kColumns) {
      stream << cell(meanOf(frames, metricOf(column.metric)), kCellWidth, column.decimals);
    }
    printRatio(stream, run.timing.ratio);
    if (!report.device.software) {
      stream << cell(run.timing.milliseconds ? std::optional(run.timing.milliseconds->median) : std::nullopt,
                     kCellWidth, 3);
    }
    const PlanCosts& costs = costsAt(report, run.variant, sequence.extent);
    constexpr double kMegabyte = 1e6;
    stream << cell(bytesPerPixel(costs), kCellWidth, 0) << cell(costs.tapsPerPixel, kCellWidth, 0)
           << cell(static_cast<double>(costs.persistentBytes + costs.transientPeakBytes) / kMegabyte, kCellWidth, 1);
    const bool finite = std::ranges::all_of(run.frames, [](const FrameErrors& frame) { return frame.nonFinite == 0; });
    stream << (finite ? "" : "  NOT FINITE") << (run.reproducible ? "" : "  NOT REPRODUCIBLE") << '\n';
  }
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
                        {"timestamp_ns", device.timestampNanoseconds},
                        {"empty_pass_ms", device.timerMilliseconds ? toJson(*device.timerMilliseconds) : Json()},
                        {"copy_bytes_per_second", orNull(device.copyBytesPerSecond)}};
  document["tone_map"] = "x/(1+x), exposure 1";
  document["vmaf"] = {{"by", report.vmaf.empty() ? Json() : Json(report.vmaf)},
                      {"missing_because", report.vmaf.empty() ? Json(report.whyNoVmaf) : Json()}};
  document["baseline"] = kBaseline;
  document["repetitions"] = report.repetitions;
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
  document["sizes"] = Json::array();
  for (const SizeTimes& size : report.sizes) document["sizes"].push_back(sizeJson(size));
  document["contents"] = Json::array();
  for (const ContentTimes& times : report.contents) document["contents"].push_back(contentJson(times));
  document["responses"] = Json::array();
  for (const Response& response : report.responses) document["responses"].push_back(responseJson(response));
  document["hard_cases"] = Json::array();
  for (const NumericsResult& result : report.numerics) document["hard_cases"].push_back(numericsJson(result));
  document["method_hard_cases"] = Json::array();
  for (const MethodHardCase& result : report.methodHardCases) {
    document["method_hard_cases"].push_back(methodHardCaseJson(result));
  }
  return document.dump(1) + "\n";
}

std::string benchCsv(const BenchReport& report) {
  std::ostringstream csv;
  csv << "sequence,variant,sweep";
  for (const Metric& metric : kMetrics) csv << ',' << metric.name << ",worst_" << metric.name;
  csv << ",non_finite,time_ratio_median,time_ratio_p5,time_ratio_p95,bytes_per_pixel,taps_per_pixel,persistent_bytes,"
         "transient_unaliased_bytes,transient_peak_bytes\n";
  const auto number = [&csv](const std::optional<double>& value) {
    csv << ',';
    if (value) csv << *value;
  };
  for (const SequenceReport& sequence : report.sequences) {
    for (std::size_t i = 0; i < sequence.runs.size(); ++i) {
      const RunRecord& run = sequence.runs[i];
      const std::vector<FrameErrors> frames = afterWarmUp(run.frames);
      csv << sequence.name << ',' << run.variant << ',' << report.variants[i].sweep;
      std::size_t nonFinite = 0;
      for (const FrameErrors& frame : run.frames) nonFinite += frame.nonFinite;
      for (const Metric& metric : kMetrics) {
        number(meanOf(frames, metric));
        number(worstOf(frames, metric));
      }
      csv << ',' << nonFinite;
      number(run.timing.ratio ? std::optional(run.timing.ratio->median) : std::nullopt);
      number(run.timing.ratio ? std::optional(run.timing.ratio->p5) : std::nullopt);
      number(run.timing.ratio ? std::optional(run.timing.ratio->p95) : std::nullopt);
      const PlanCosts& costs = costsAt(report, run.variant, sequence.extent);
      csv << ',' << bytesPerPixel(costs);
      number(costs.tapsPerPixel);
      csv << ',' << costs.persistentBytes << ',' << costs.transientUnaliasedBytes << ',' << costs.transientPeakBytes
          << '\n';
    }
  }
  return csv.str();
}

void printBench(std::ostream& stream, const BenchReport& report) {
  for (const SequenceReport& sequence : report.sequences) printSequence(stream, report, sequence);
  if (!report.sequences.empty()) {
    stream << "\nMeans over the frames after the first " << kWarmUpFrames
           << ". Errors after the tone map x/(1+x), but relMSE; "
           << "time: ratio to " << kBaseline
           << " on the same frame in the same run; bytes and taps per pixel and memory (persistent "
              "and shared transient): from the plan.\n";
    if (report.vmaf.empty()) stream << "No VMAF: " << report.whyNoVmaf << ".\n";
  }
  for (const SizeTimes& size : report.sizes) printSize(stream, report, size);
  if (!report.contents.empty()) printContents(stream, report);
  if (!report.responses.empty()) printResponses(stream, report);
  if (!report.numerics.empty()) {
    printHardCases(stream, "ways of storing and solving", report.numerics, [](const NumericsResult& result) {
      const NumericsSetting& setting = result.setting;
      return setting.storage + ", " + setting.regularisation + ' ' + setting.epsilon;
    });
    printHardCases(stream, "methods", report.methodHardCases,
                   [](const MethodHardCase& result) { return result.variant; });
  }
  if (report.device.software) {
    stream << report.device.name << " is a software device: ratios of its times are a processor's, not a GPU's.\n";
  }
}

}  // namespace walr
