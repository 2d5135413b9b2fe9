#include "samples/estimate/machine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "samples/estimate/embedded_files.h"
#include "samples/estimate/json_file.h"

namespace walr {
namespace {

constexpr double kMicroseconds = 1e6;

Machine machineOf(const nlohmann::json& json) {
  const double processors = json.at("processors");
  const double clock = json.at("clock_ghz").get<double>() * 1e9;
  return {.name = json.at("name"),
          .gpu = json.at("gpu"),
          .deviceName = json.at("device_name"),
          .simds = processors * json.at("simds_per_processor").get<double>(),
          .threadsPerWave = json.at("threads_per_wave"),
          .cyclesPerSecond = clock,
          .cyclesPerInstruction = json.at("cycles_per_instruction"),
          .cyclesPerMultiplication = json.at("cycles_per_multiplication"),
          .latencyCyclesPerInstruction = json.at("latency_cycles_per_instruction"),
          .texelsPerSecond = processors * clock * json.at("texels_per_clock_and_processor").get<double>(),
          .fetchLatency = json.at("fetch_latency_us").get<double>() / kMicroseconds,
          .bytesPerSecond = json.at("memory_gb_per_s").get<double>() * 1e9};
}

double instructionCycles(const WaveCounts& wave, double instruction, double multiplication) {
  return instruction * (wave.vector - wave.multiplications) + multiplication * wave.multiplications;
}

}  // namespace

const std::vector<Machine>& machines() {
  static const std::vector<Machine> kMachines = [] {
    std::vector<Machine> read;
    readJsonText("machines.json", kMachinesJson, [&](const nlohmann::json& json) {
      for (const nlohmann::json& entry : json.at("machines")) read.push_back(machineOf(entry));
    });
    return read;
  }();
  return kMachines;
}

const Machine& machineNamed(std::string_view name) {
  const auto found = std::ranges::find(machines(), name, &Machine::name);
  if (found != machines().end()) return *found;
  std::string known;
  for (const Machine& machine : machines()) known += (known.empty() ? "" : ", ") + machine.name;
  throw std::invalid_argument("there is no machine '" + std::string(name) +
                              "' in samples/estimate/machines.json; there are: " + known);
}

const Machine* machineOfDevice(std::string_view vulkanName) {
  const auto found = std::ranges::find_if(machines(), [&](const Machine& machine) {
    return vulkanName.find(machine.deviceName) != std::string_view::npos;
  });
  return found == machines().end() ? nullptr : &*found;
}

double Bounds::largest() const {
  return std::max({bytes, instructions, fetches, latency, slots});
}

std::string_view Bounds::nameOfLargest() const {
  if (largest() == bytes) return "bytes";
  if (largest() == instructions) return "instructions";
  return largest() == fetches ? "fetches" : "latency";
}

Bounds boundsOn(const Machine& machine, const WaveCounts& wave, double threads, double waves, double bytes) {
  const double cycles = instructionCycles(wave, machine.cyclesPerInstruction, machine.cyclesPerMultiplication);
  const double machineWaves = threads / machine.threadsPerWave;
  const double rounds = machineWaves / (machine.simds * waves);
  const double alone =
      wave.waits * machine.fetchLatency + machine.latencyCyclesPerInstruction * wave.vector / machine.cyclesPerSecond;
  return {.bytes = kMicroseconds * bytes / machine.bytesPerSecond,
          .instructions = kMicroseconds * cycles * machineWaves / (machine.simds * machine.cyclesPerSecond),
          .fetches = kMicroseconds * wave.fetches * threads / machine.texelsPerSecond,
          .latency = kMicroseconds * alone * std::ceil(rounds),
          .slots = kMicroseconds * alone * rounds};
}

Bounds sideBySide(const Bounds& a, const Bounds& b) {
  return {.bytes = a.bytes + b.bytes,
          .instructions = a.instructions + b.instructions,
          .fetches = a.fetches + b.fetches,
          .latency = std::max(a.latency, b.latency),
          .slots = a.slots + b.slots};
}

double simdCycles(const WaveCounts& wave) {
  return std::max(instructionCycles(wave, 2.0, 8.0), 8.0 * wave.transcendentals);
}

}  // namespace walr
