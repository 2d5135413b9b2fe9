#include "samples/denoise/report.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

#include <nlohmann/json.hpp>

namespace walr {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

void addFigures(Json& object, const ErrorFigures& figures) {
  object["rmse"] = number(figures.rmse);
  object["psnr"] = number(figures.psnr);
  object["ssim"] = number(figures.ssim);
}

void addMeasurements(Json& object, const FrameReport& frame) {
  object["gpu_ms"] = number(frame.gpuMilliseconds);
  addFigures(object, frame.denoised);
  addFigures(object["noisy"], frame.noisy);
  object["reference_noise"] = number(frame.referenceNoise);
}

Json meanJson(const FrameReport& mean) {
  Json object = Json::object();
  addMeasurements(object, mean);
  return object;
}

std::string cell(const std::optional<double>& value, int decimals, int width) {
  std::ostringstream text;
  text << std::setw(width);
  if (value) {
    text << std::fixed << std::setprecision(decimals) << *value;
  } else {
    text << '-';
  }
  return text.str();
}

void printFigures(std::ostream& stream, const ErrorFigures& figures) {
  stream << cell(figures.rmse, 5, 10) << cell(figures.psnr, 2, 8) << cell(figures.ssim, 4, 8);
}

void printRow(std::ostream& stream, const std::string& name, const FrameReport& frame, bool withErrors) {
  stream << std::left << std::setw(12) << name << std::right << cell(frame.gpuMilliseconds, 2, 10);
  if (withErrors) {
    printFigures(stream, frame.denoised);
    stream << "  |";
    printFigures(stream, frame.noisy);
  }
  stream << (frame.resetHistory ? "  history reset" : "") << '\n';
}

/// One line per counter: its mean, and its largest value with the frame of that value.
void printCounters(std::ostream& stream, const std::vector<FrameReport>& frames) {
  if (frames.empty() || frames.front().counters.empty()) return;
  constexpr int kNameWidth = 28;
  constexpr int kWidth = 14;
  stream << std::left << std::setw(kNameWidth) << "counter" << std::right << std::setw(kWidth) << "mean per frame"
         << std::setw(kWidth) << "most"
         << "  in frame\n";
  for (std::size_t i = 0; i < frames.front().counters.size(); ++i) {
    const auto value = [i](const FrameReport& frame) { return frame.counters[i].value; };
    const auto most = std::ranges::max_element(frames, {}, value);
    double sum = 0.0;
    for (const FrameReport& frame : frames) sum += static_cast<double>(value(frame));
    stream << std::left << std::setw(kNameWidth) << frames.front().counters[i].name << std::right
           << cell(sum / static_cast<double>(frames.size()), 1, kWidth) << std::setw(kWidth) << value(*most) << "  "
           << most->frame << '\n';
  }
}

}  // namespace

FrameReport meanReport(const std::vector<FrameReport>& frames, std::size_t first) {
  MeanFigures denoised;
  MeanFigures noisy;
  double milliseconds = 0.0;
  std::size_t timed = 0;
  double referenceNoise = 0.0;
  std::size_t halved = 0;
  FrameReport mean;
  for (std::size_t i = first; i < frames.size(); ++i) {
    denoised.add(frames[i].denoised);
    noisy.add(frames[i].noisy);
    milliseconds += frames[i].gpuMilliseconds.value_or(0.0);
    timed += frames[i].gpuMilliseconds ? 1 : 0;
    referenceNoise += frames[i].referenceNoise.value_or(0.0);
    halved += frames[i].referenceNoise ? 1 : 0;
    mean.nonFiniteOutput += frames[i].nonFiniteOutput;
  }
  mean.denoised = denoised.mean();
  mean.noisy = noisy.mean();
  if (timed > 0) {
    mean.gpuMilliseconds = milliseconds / static_cast<double>(timed);
  }
  if (halved > 0) mean.referenceNoise = referenceNoise / static_cast<double>(halved);
  return mean;
}

std::string reportJson(const DenoiseReport& report) {
  Json document;
  document["method"] = report.method;
  document["settings"] = Json::object();
  for (const auto& [name, value] : report.settings) {
    document["settings"][name] = value;
  }
  document["device"] = report.device;
  document["driver"] = report.driver;
  document["software_device"] = report.softwareDevice;
  document["layout"] = report.layout;
  document["width"] = report.extent.width;
  document["height"] = report.extent.height;
  document["tone_map"] = "x/(1+x)";
  document["frames"] = Json::array();
  for (const FrameReport& frame : report.frames) {
    Json object;
    object["frame"] = frame.frame;
    addMeasurements(object, frame);
    object["history_reset"] = frame.resetHistory;
    object["non_finite_output"] = frame.nonFiniteOutput;
    for (const CounterValue& counter : frame.counters) object["counters"][counter.name] = counter.value;
    document["frames"].push_back(std::move(object));
  }
  document["mean"] = meanJson(meanReport(report.frames, 0));
  document["mean_after_4"] = meanJson(meanReport(report.frames, kWarmUpFrames));
  return document.dump(2) + "\n";
}

void printReport(std::ostream& stream, const DenoiseReport& report) {
  const bool withErrors =
      std::ranges::any_of(report.frames, [](const FrameReport& frame) { return frame.denoised.rmse.has_value(); });
  stream << std::left << std::setw(12) << "frame" << std::right << std::setw(10)
         << (report.softwareDevice ? "ms (CPU)" : "gpu ms");
  if (withErrors) {
    const auto columns = [&] { stream << std::setw(10) << "RMSE" << std::setw(8) << "PSNR" << std::setw(8) << "SSIM"; };
    columns();
    stream << "  |";
    columns();
    stream << "  (of the noisy input)";
  }
  stream << '\n';
  for (const FrameReport& frame : report.frames) {
    printRow(stream, std::to_string(frame.frame), frame, withErrors);
  }
  printRow(stream, "mean", meanReport(report.frames, 0), withErrors);
  if (report.frames.size() > kWarmUpFrames) {
    printRow(stream, "mean after " + std::to_string(kWarmUpFrames), meanReport(report.frames, kWarmUpFrames),
             withErrors);
  }
  if (withErrors) {
    stream << "Errors are after the tone map x/(1+x), over pixels of surfaces with a diffuse albedo of at least 0.01; "
              "PSNR in dB against a peak of 1; SSIM with an 11x11 Gaussian window.\n";
  }
  if (const std::optional<double> noise = meanReport(report.frames, 0).referenceNoise) {
    stream << "Noise of the references: RMSE " << cell(noise, 5, 0) << ", which is part of every error above.\n";
  }
  printCounters(stream, report.frames);
  if (report.softwareDevice) {
    stream << report.device << " is a software device: its times are CPU times and do not predict those of a GPU.\n";
  }
}

}  // namespace walr
