#include "samples/gpu_report/gpu_report_json.h"

#include <nlohmann/json.hpp>

#include "samples/bench/or_null.h"
#include "samples/estimate/shader_figures.h"
#include "samples/json_text.h"

namespace walr {
namespace {

using Json = nlohmann::ordered_json;

Json textOrNull(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json spreadOrNull(const std::optional<Spread>& value) {
  return value ? toJson(*value) : Json();
}

Json deviceJson(const ReportedDevice& device) {
  Json heaps = Json::array();
  for (const ReportedDevice::Heap& heap : device.heaps) {
    heaps.push_back({{"bytes", heap.bytes}, {"device_local", heap.deviceLocal}});
  }
  return {{"name", device.name},
          {"driver", device.driver},
          {"software", device.software},
          {"api_version", device.apiVersion},
          {"vendor_id", device.vendorId},
          {"device_id", device.deviceId},
          {"timestamp_ns", device.timestampNanoseconds > 0.0 ? Json(device.timestampNanoseconds) : Json()},
          {"heaps", std::move(heaps)}};
}

Json clocksJson(const GpuReport& report) {
  Json readings = Json::array();
  for (const ClockReading& reading : report.clocks) {
    readings.push_back({{"when", reading.when},
                        {"core_mhz", orNull(reading.clocks.coreMegahertz)},
                        {"memory_mhz", orNull(reading.clocks.memoryMegahertz)}});
  }
  return {{"source", textOrNull(report.clockSource)},
          {"missing_because", textOrNull(report.whyNoClocks)},
          {"readings", std::move(readings)}};
}

Json validationJson(const ValidationRun& run) {
  Json messages = Json::array();
  for (const fg::vk::Message& message : run.messages) {
    messages.push_back({{"severity", message.severity == fg::vk::Message::Severity::Error ? "error" : "warning"},
                        {"id", message.id},
                        {"text", message.text}});
  }
  return {{"layer", run.layer},
          {"missing_because", textOrNull(run.whyNot)},
          {"methods", run.methods},
          {"messages", std::move(messages)}};
}

Json bandwidthJson(const Bandwidth& bandwidth) {
  Json probes = Json::array();
  for (const BandwidthProbe& probe : bandwidth.probes) {
    probes.push_back({{"name", probe.name},
                      {"description", probe.description},
                      {"milliseconds", toJson(probe.milliseconds)},
                      {"bytes_per_second", orNull(probe.bytesPerSecond)},
                      {"fetches_per_second", orNull(probe.fetchesPerSecond)},
                      {"seconds_per_fetch", orNull(probe.secondsPerFetch)}});
  }
  return {{"bytes", bandwidth.bytes},
          {"empty_pass_ms", spreadOrNull(bandwidth.emptyPassMilliseconds)},
          {"probes", std::move(probes)},
          {"note", textOrNull(bandwidth.whyNot)}};
}

Json modelJson(const GpuReport& report) {
  Json json = {{"machine", Json()},
               {"gpu", Json()},
               {"missing_because", textOrNull(report.whyNoMachine)},
               {"compiler", shaderFigures().driver},
               {"family", shaderFigures().family},
               {"peak", Json()},
               {"attainable", Json()}};
  if (!report.machines) return json;
  const auto rates = [](const Machine& machine) {
    return Json{{"bytes_per_second", machine.bytesPerSecond}, {"fetches_per_second", machine.texelsPerSecond}};
  };
  json["machine"] = report.machines->peak.name;
  json["gpu"] = report.machines->peak.gpu;
  json["peak"] = rates(report.machines->peak);
  json["attainable"] = rates(report.machines->attainable);
  return json;
}

Json boundsJson(const std::optional<Bounds>& bounds) {
  if (!bounds) return {};
  return {{"microseconds", bounds->largest()},    {"bound_by", bounds->nameOfLargest()}, {"bytes", bounds->bytes},
          {"instructions", bounds->instructions}, {"fetches", bounds->fetches},          {"latency", bounds->latency}};
}

Json methodJson(const MethodTimes& method) {
  Json passes = Json::array();
  for (std::size_t i = 0; i < method.timing.passes.size(); ++i) {
    const PassSpread& pass = method.timing.passes[i];
    const PassModel& model = method.models.at(i);
    passes.push_back({{"name", pass.name},
                      {"milliseconds", toJson(pass.milliseconds)},
                      {"bytes", model.bytes},
                      {"estimate", boundsJson(model.peak)},
                      {"attainable_estimate", boundsJson(model.attainable)}});
  }
  return {{"variant", method.variant},
          {"warm_up_frames", method.warmUpFrames},
          {"timed_frames", method.timing.frames},
          {"milliseconds", spreadOrNull(method.timing.milliseconds)},
          {"estimated_microseconds", orNull(method.estimatedMicroseconds())},
          {"passes", std::move(passes)},
          {"why_not", textOrNull(method.whyNot)}};
}

Json timesJson(const ContentMethodTimes& times) {
  Json methods = Json::array();
  for (const MethodTimes& method : times.methods) methods.push_back(methodJson(method));
  return {{"content", times.content},
          {"description", times.description},
          {"width", times.extent.width},
          {"height", times.extent.height},
          {"methods", std::move(methods)}};
}

Json agreementJson(const Agreement& agreement) {
  return {{"variant", agreement.variant},
          {"sequence", agreement.sequence},
          {"hash", textOrNull(agreement.hash)},
          {"non_finite", agreement.nonFinite},
          {"rmse", orNull(agreement.rmse)},
          {"reference_rmse", orNull(agreement.referenceRmse)},
          {"rms_difference", orNull(agreement.rmsDifference)},
          {"largest_difference", orNull(agreement.largestDifference)},
          {"differing_share", orNull(agreement.differingShare)},
          {"suspicious", agreement.suspicious()},
          {"why_not", textOrNull(agreement.whyNot)}};
}

}  // namespace

std::string gpuReportJson(const GpuReport& report, const std::string& command) {
  Json document = {{"schema", 1},
                   {"command", command},
                   {"commit", report.build.commit},
                   {"compiler", report.build.compiler},
                   {"build_type", report.build.buildType},
                   {"quick", report.quick},
                   {"seconds", report.seconds},
                   {"device", deviceJson(report.device)},
                   {"clocks", clocksJson(report)},
                   {"validation", validationJson(report.validation)},
                   {"bandwidth", bandwidthJson(report.bandwidth)},
                   {"model", modelJson(report)}};
  document["times"] = Json::array();
  for (const ContentMethodTimes& times : report.times) document["times"].push_back(timesJson(times));
  Json agreements = Json::array();
  for (const Agreement& agreement : report.agreements) agreements.push_back(agreementJson(agreement));
  document["results"] = {{"reference", textOrNull(report.reference)},
                         {"missing_because", textOrNull(report.whyNoReference)},
                         {"agreements", std::move(agreements)}};
  return jsonText(document, 1);
}

}  // namespace walr
