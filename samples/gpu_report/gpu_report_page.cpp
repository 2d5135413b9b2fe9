#include "samples/gpu_report/gpu_report_page.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "samples/estimate/shader_figures.h"

namespace walr {
namespace {

constexpr fg::Extent kPassesExtent{1920, 1080};
constexpr double kGiga = 1e-9;
constexpr double kMebi = 1.0 / (1U << 20U);

using Row = std::vector<std::string>;

std::string fixed(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

std::string fixed(const std::optional<double>& value, int decimals, double scale = 1.0) {
  return value ? fixed(*value * scale, decimals) : "-";
}

/// "0.123 (0.120 to 0.130)".
std::string withRange(const Spread& spread) {
  return fixed(spread.median, 4) + " (" + fixed(spread.p5, 4) + " to " + fixed(spread.p95, 4) + ")";
}

std::string line(const Row& row) {
  std::string text = "|";
  for (const std::string& cell : row) text += " " + cell + " |";
  return text + "\n";
}

std::string table(const Row& header, const std::vector<Row>& rows) {
  std::string text = line(header) + line(Row(header.size(), "---"));
  for (const Row& row : rows) text += line(row);
  return text + "\n";
}

/// Measured time in units of an estimate.
std::string ratio(double milliseconds, const std::optional<double>& microseconds) {
  return microseconds && *microseconds > 0.0 ? fixed(1e3 * milliseconds / *microseconds, 2) : "-";
}

std::string deviceSection(const GpuReport& report, const std::string& command) {
  const ReportedDevice& device = report.device;
  std::ostringstream text;
  text << "# " << device.name << "\n\n"
       << "Driver " << device.driver << ", Vulkan " << device.apiVersion << ". Program of commit "
       << report.build.commit << ", " << report.build.compiler << ", " << report.build.buildType << ". "
       << fixed(report.seconds, 0) << " s.\n\n    " << command << "\n\n";
  if (device.software) {
    text << "**The device is a CPU implementation of Vulkan: its times do not predict those of a GPU.**\n\n";
  }
  if (report.quick) text << "**A run with `--quick`: too short for its times to mean anything.**\n\n";
  if (device.timestampNanoseconds > 0.0) {
    text << "* Timer: resolution " << device.timestampNanoseconds << " ns";
    if (report.bandwidth.emptyPassMilliseconds) {
      text << "; an empty pass takes " << fixed(1e3 * report.bandwidth.emptyPassMilliseconds->median, 2) << " us";
    }
    text << ".\n";
  } else {
    text << "* The device's queue has no timestamps, so there are no times.\n";
  }
  const char* separator = "* Memory: ";
  for (const ReportedDevice::Heap& heap : device.heaps) {
    text << separator << fixed(static_cast<double>(heap.bytes) * kMebi, 0) << " MiB of the "
         << (heap.deviceLocal ? "device" : "host");
    separator = ", ";
  }
  text << ".\n* Clocks";
  if (report.clockSource.empty()) {
    text << " are not known: " << report.whyNoClocks << ".\n\n";
    return text.str();
  }
  text << " by " << report.clockSource << ", core and memory in MHz: ";
  separator = "";
  for (const ClockReading& reading : report.clocks) {
    text << separator << reading.when << " " << fixed(reading.clocks.coreMegahertz, 0) << " and "
         << fixed(reading.clocks.memoryMegahertz, 0);
    separator = "; ";
  }
  text << ".\n\n";
  return text.str();
}

std::string validationSection(const ValidationRun& run) {
  std::string text = "## Validation\n\n";
  if (!run.layer) return text + "Nothing was validated: " + run.whyNot + ".\n\n";
  text += std::to_string(run.methods.size()) +
          " methods and presets ran under the Khronos validation layer with synchronization validation: " +
          (run.messages.empty() ? "no message" : "**" + std::to_string(run.messages.size()) + " messages**") + ".\n\n";
  for (const fg::vk::Message& message : run.messages) text += "    " + message.id + ": " + message.text + "\n\n";
  return text;
}

std::string bandwidthSection(const Bandwidth& bandwidth) {
  std::string text = "## Memory and texture units\n\n";
  if (!bandwidth.whyNot.empty()) text += bandwidth.whyNot + ".\n\n";
  if (bandwidth.probes.empty()) return text;
  std::vector<Row> rows;
  for (const BandwidthProbe& probe : bandwidth.probes) {
    rows.push_back({probe.name, withRange(probe.milliseconds), fixed(probe.bytesPerSecond, 1, kGiga),
                    fixed(probe.fetchesPerSecond, 2, kGiga), fixed(probe.secondsPerFetch, 0, 1.0 / kGiga),
                    probe.description});
  }
  return text + "Buffer and texture of " + fixed(static_cast<double>(bandwidth.bytes) * kMebi, 1) +
         " MiB. Times: median (5 to 95 %).\n\n" +
         table({"probe", "ms", "GB/s", "billion fetches/s", "ns a fetch", "what it does"}, rows);
}

std::string modelNote(const GpuReport& report) {
  if (!report.machines) return "There are no estimates: " + report.whyNoMachine + ".\n\n";
  const Machine& peak = report.machines->peak;
  const Machine& attainable = report.machines->attainable;
  return "**Estimates** are for " + peak.gpu +
         ", by a static model, and no measurements: for each pass the largest of what its bytes, instructions, "
         "fetches and waits take. Instructions are those that " +
         shaderFigures().driver + " makes for " + shaderFigures().family +
         ". Peak rates: " + fixed(peak.bytesPerSecond * kGiga, 0) + " GB/s, " + fixed(peak.texelsPerSecond * kGiga, 0) +
         " billion fetches/s. At measured rates: " + fixed(attainable.bytesPerSecond * kGiga, 1) +
         " GB/s (the fastest probe), " + fixed(attainable.texelsPerSecond * kGiga, 2) +
         " billion fetches/s (cached).\n\n";
}

std::string timesTable(const ContentMethodTimes& times) {
  std::vector<Row> rows;
  for (const MethodTimes& method : times.methods) {
    if (!method.timing.milliseconds) {
      rows.push_back({"`" + method.variant + "`", method.whyNot, "-", "-", "-", "-"});
      continue;
    }
    const auto estimate = method.estimatedMicroseconds();
    double bytes = 0.0;
    for (const PassModel& model : method.models) bytes += model.bytes;
    const double median = method.timing.milliseconds->median;
    rows.push_back({"`" + method.variant + "`",
                    withRange(*method.timing.milliseconds) + (method.unsteady() ? " **unsteady**" : ""),
                    std::to_string(method.timing.frames), fixed(estimate, 1), ratio(median, estimate),
                    fixed(bytes * kGiga / (median * 1e-3), 1)});
  }
  return "### " + std::to_string(times.extent.width) + " x " + std::to_string(times.extent.height) + ", " +
         times.content + "\n\n" + (times.description.empty() ? "" : "Frames: " + times.description + ".\n\n") +
         table({"method", "ms, median (5 to 95 %)", "frames", "ESTIMATE, us", "measured / estimate", "plan's GB/s"},
               rows);
}

std::string passesTable(const MethodTimes& method) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < method.timing.passes.size(); ++i) {
    const PassSpread& pass = method.timing.passes[i];
    const PassModel& model = method.models.at(i);
    const auto largest = [](const std::optional<Bounds>& bounds) {
      return bounds ? std::optional(bounds->largest()) : std::nullopt;
    };
    rows.push_back({pass.name, withRange(pass.milliseconds), fixed(model.bytes * 1e-6, 1),
                    fixed(largest(model.peak), 1), model.peak ? std::string(model.peak->nameOfLargest()) : "-",
                    ratio(pass.milliseconds.median, largest(model.peak)), fixed(largest(model.attainable), 1),
                    ratio(pass.milliseconds.median, largest(model.attainable))});
  }
  return "### `" + method.variant + "`\n\n" +
         table({"pass", "ms, median (5 to 95 %)", "MB", "ESTIMATE, us", "bound by", "measured / estimate",
                "ESTIMATE at measured rates, us", "measured / that"},
               rows);
}

/// The content whose passes the page lists: the last timed at 1080p, or the last timed of all; null if there is none.
const ContentMethodTimes* passesContent(const GpuReport& report) {
  const ContentMethodTimes* shown = nullptr;
  for (const ContentMethodTimes& times : report.times) {
    const bool timed = std::ranges::any_of(
        times.methods, [](const MethodTimes& method) { return method.timing.milliseconds.has_value(); });
    if (timed && (shown == nullptr || shown->extent != kPassesExtent || times.extent == kPassesExtent)) shown = &times;
  }
  return shown;
}

std::string timesSections(const GpuReport& report) {
  std::string text =
      "## Times\n\nBy GPU timestamps, on two frames in alternation that lie in device memory, after a "
      "warm-up. **Plan's GB/s**: bytes of the plan, each texel once a pass, over the measured time. **Unsteady**: the "
      "95 % quantile is more than " +
      fixed(kSteady, 1) +
      " times the median; clock rates changed, or another program used the device, so measure again.\n\n" +
      modelNote(report);
  for (const ContentMethodTimes& times : report.times) text += timesTable(times);
  const ContentMethodTimes* const shown = passesContent(report);
  if (shown == nullptr) return text;
  text += "## Passes at " + std::to_string(shown->extent.width) + " x " + std::to_string(shown->extent.height) + ", " +
          shown->content + "\n\nThe JSON holds those of the other sizes.\n\n";
  for (const MethodTimes& method : shown->methods) {
    if (!method.timing.passes.empty()) text += passesTable(method);
  }
  return text;
}

std::string resultsSection(const GpuReport& report) {
  std::string text = "## Results\n\n";
  text += report.reference.empty() ? "Compared with the truth only: " + report.whyNoReference + ".\n\n"
                                   : "Compared with " + report.reference + ".\n\n";
  std::vector<Row> rows;
  for (const Agreement& agreement : report.agreements) {
    const std::string verdict = !agreement.whyNot.empty() ? agreement.whyNot
                                : agreement.nonFinite > 0 ? std::to_string(agreement.nonFinite) + " non-finite values"
                                : agreement.suspicious()  ? "**differs**"
                                                          : "";
    rows.push_back({"`" + agreement.variant + "`", agreement.sequence, fixed(agreement.rmse, 5),
                    fixed(agreement.referenceRmse, 5), fixed(agreement.rmsDifference, 6),
                    fixed(agreement.largestDifference, 4), fixed(agreement.differingShare, 2, 100.0), verdict});
  }
  return text +
         "After the tone map x / (1 + x), of the last frame of a short sequence. **RMSE**: against the known truth. "
         "**Differs**: by more than a tenth of the method's own RMSE in the root mean square, or non-finite. **Pixels "
         "that differ**: by more than 1/255.\n\n" +
         table({"method", "sequence", "RMSE", "RMSE of the reference", "RMS difference", "largest difference",
                "pixels that differ, %", "note"},
               rows);
}

}  // namespace

std::string gpuReportPage(const GpuReport& report, const std::string& command) {
  return deviceSection(report, command) + validationSection(report.validation) + bandwidthSection(report.bandwidth) +
         timesSections(report) + resultsSection(report);
}

}  // namespace walr
