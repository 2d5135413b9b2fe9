#include "samples/denoise/report.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string_view>

#include <nlohmann/json.hpp>

#include "samples/json_text.h"

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

void addErrors(Json& object, const LightErrors& errors) {
  addFigures(object, errors.denoised);
  addFigures(object["noisy"], errors.noisy);
  object["reference_noise"] = number(errors.referenceNoise);
}

void addMeasurements(Json& object, const FrameReport& frame) {
  object["gpu_ms"] = number(frame.gpuMilliseconds);
  addErrors(object, frame.indirect);
  addErrors(object["direct"], frame.direct);
  Json& specular = object["specular"];
  addErrors(specular, frame.specular);
  specular["rmse_by_roughness"] = Json::array();
  for (const std::optional<double>& rmse : frame.byRoughness) specular["rmse_by_roughness"].push_back(number(rmse));
}

Json settingsJson(const SettingsText& settings) {
  Json object = Json::object();
  for (const auto& [name, value] : settings) object[name] = value;
  return object;
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

/// The lights whose errors are known.
struct MeasuredLight {
  std::string_view name;
  LightErrors FrameReport::*errors;
};

std::vector<MeasuredLight> measuredLights(const std::vector<FrameReport>& frames) {
  std::vector<MeasuredLight> lights{{"indirect light", &FrameReport::indirect},
                                    {"direct light", &FrameReport::direct},
                                    {"specular light", &FrameReport::specular}};
  std::erase_if(lights, [&](const MeasuredLight& light) {
    return std::ranges::none_of(
        frames, [&](const FrameReport& frame) { return (frame.*light.errors).denoised.rmse.has_value(); });
  });
  return lights;
}

/// Means over the frames from index `first` on, each value over the frames that have it.
LightErrors meanErrors(const std::vector<FrameReport>& frames, std::size_t first, LightErrors FrameReport::*light) {
  MeanFigures denoised;
  MeanFigures noisy;
  double referenceNoise = 0.0;
  std::size_t halved = 0;
  for (std::size_t i = first; i < frames.size(); ++i) {
    const LightErrors& errors = frames[i].*light;
    denoised.add(errors.denoised);
    noisy.add(errors.noisy);
    referenceNoise += errors.referenceNoise.value_or(0.0);
    halved += errors.referenceNoise ? 1 : 0;
  }
  LightErrors mean{denoised.mean(), noisy.mean(), {}};
  if (halved > 0) mean.referenceNoise = referenceNoise / static_cast<double>(halved);
  return mean;
}

/// @param light  whose errors are printed; null: none
void printRow(std::ostream& stream, const std::string& name, const FrameReport& frame,
              LightErrors FrameReport::*light) {
  stream << std::left << std::setw(12) << name << std::right << cell(frame.gpuMilliseconds, 2, 10);
  if (light != nullptr) {
    printFigures(stream, (frame.*light).denoised);
    stream << "  |";
    printFigures(stream, (frame.*light).noisy);
  }
  stream << (frame.resetHistory ? "  history reset" : "") << '\n';
}

/// Times of all frames, and errors of a light, which may be null.
void printTable(std::ostream& stream, const DenoiseReport& report, LightErrors FrameReport::*light) {
  stream << std::left << std::setw(12) << "frame" << std::right << std::setw(10)
         << (report.softwareDevice ? "ms (CPU)" : "gpu ms");
  if (light != nullptr) {
    const auto columns = [&] { stream << std::setw(10) << "RMSE" << std::setw(8) << "PSNR" << std::setw(8) << "SSIM"; };
    columns();
    stream << "  |";
    columns();
    stream << "  (of the noisy input)";
  }
  stream << '\n';
  for (const FrameReport& frame : report.frames) {
    printRow(stream, std::to_string(frame.frame), frame, light);
  }
  printRow(stream, "mean", meanReport(report.frames, 0), light);
  if (report.frames.size() > kWarmUpFrames) {
    printRow(stream, "mean after " + std::to_string(kWarmUpFrames), meanReport(report.frames, kWarmUpFrames), light);
  }
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

void printRoughness(std::ostream& stream, const FiguresByRoughness& errors) {
  stream << "Mean RMSE of the specular light by linear roughness:";
  for (std::size_t i = 0; i < errors.size(); ++i) {
    stream << (i > 0 ? ", " : " ") << kRoughnessBounds.at(i) << " to " << kRoughnessBounds.at(i + 1) << ' '
           << cell(errors.at(i), 5, 0);
  }
  stream << '\n';
}

}  // namespace

FrameReport meanReport(const std::vector<FrameReport>& frames, std::size_t first) {
  double milliseconds = 0.0;
  std::size_t timed = 0;
  FrameReport mean;
  for (std::size_t i = first; i < frames.size(); ++i) {
    milliseconds += frames[i].gpuMilliseconds.value_or(0.0);
    timed += frames[i].gpuMilliseconds ? 1 : 0;
    mean.nonFiniteOutput += frames[i].nonFiniteOutput;
  }
  mean.indirect = meanErrors(frames, first, &FrameReport::indirect);
  mean.direct = meanErrors(frames, first, &FrameReport::direct);
  mean.specular = meanErrors(frames, first, &FrameReport::specular);
  for (std::size_t i = 0; i < mean.byRoughness.size(); ++i) {
    MeanFigures figures;
    for (std::size_t f = first; f < frames.size(); ++f) figures.add({frames[f].byRoughness.at(i), {}, {}});
    mean.byRoughness.at(i) = figures.mean().rmse;
  }
  if (timed > 0) {
    mean.gpuMilliseconds = milliseconds / static_cast<double>(timed);
  }
  return mean;
}

std::string reportJson(const DenoiseReport& report) {
  Json document;
  document["method"] = report.method;
  document["settings"] = settingsJson(report.settings);
  if (!report.directSettings.empty()) document["direct_settings"] = settingsJson(report.directSettings);
  document["device"] = report.device;
  document["driver"] = report.driver;
  document["software_device"] = report.softwareDevice;
  document["layout"] = report.layout;
  document["light"] = report.light;
  document["width"] = report.extent.width;
  document["height"] = report.extent.height;
  document["average"] = report.average;
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
  return jsonText(document, 2);
}

void printReport(std::ostream& stream, const DenoiseReport& report) {
  const std::vector<MeasuredLight> lights = measuredLights(report.frames);
  if (lights.empty()) printTable(stream, report, nullptr);
  for (const MeasuredLight& light : lights) {
    stream << "Errors of the " << light.name << ":\n";
    printTable(stream, report, light.errors);
    if (light.errors == &FrameReport::specular) {
      printRoughness(stream, meanReport(report.frames, 0).byRoughness);
    }
    if (const std::optional<double> noise = (meanReport(report.frames, 0).*light.errors).referenceNoise) {
      stream << "Noise of the references: RMSE " << cell(noise, 5, 0) << ", which is part of every error above.\n";
    }
  }
  if (!lights.empty()) {
    stream << "Errors are after the tone map x/(1+x), over pixels of surfaces whose albedo for the light is at least "
              "0.01; "
              "PSNR in dB against a peak of 1; SSIM with an 11x11 Gaussian window.\n";
  }
  printCounters(stream, report.frames);
  if (report.softwareDevice) {
    stream << report.device << " is a software device: its times are CPU times and do not predict those of a GPU.\n";
  }
}

}  // namespace walr
