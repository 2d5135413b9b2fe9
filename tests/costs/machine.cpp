#include "tests/costs/machine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/costs/json_file.h"

namespace walr::costs {
namespace {

constexpr double kMicroseconds = 1e6;

Machine machineOf(const nlohmann::json& json) {
  const double processors = json.at("processors");
  const double clock = json.at("clock_ghz").get<double>() * 1e9;
  return {.name = json.at("name"),
          .gpu = json.at("gpu"),
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

Machine readMachine(const std::filesystem::path& file, std::string_view name) {
  std::string known;
  Machine found;
  readJson(file, [&](const nlohmann::json& json) {
    for (const nlohmann::json& entry : json.at("machines")) {
      const Machine machine = machineOf(entry);
      known += (known.empty() ? "" : ", ") + machine.name;
      if (machine.name == name) found = machine;
    }
  });
  if (found.name.empty()) {
    throw std::runtime_error("there is no machine '" + std::string(name) + "' in " + file.string() +
                             "; there are: " + known);
  }
  return found;
}

double Bounds::largest() const {
  return std::max({bytes, instructions, fetches, latency});
}

Bounds boundsOn(const Machine& machine, const WaveCounts& wave, double threads, double waves, double bytes) {
  const double cycles = instructionCycles(wave, machine.cyclesPerInstruction, machine.cyclesPerMultiplication);
  const double machineWaves = threads / machine.threadsPerWave;
  const double rounds = std::ceil(machineWaves / (machine.simds * waves));
  const double alone =
      wave.waits * machine.fetchLatency + machine.latencyCyclesPerInstruction * wave.vector / machine.cyclesPerSecond;
  return {.bytes = kMicroseconds * bytes / machine.bytesPerSecond,
          .instructions = kMicroseconds * cycles * machineWaves / (machine.simds * machine.cyclesPerSecond),
          .fetches = kMicroseconds * wave.fetches * threads / machine.texelsPerSecond,
          .latency = kMicroseconds * alone * rounds};
}

double simdCycles(const WaveCounts& wave) {
  return std::max(instructionCycles(wave, 2.0, 8.0), 8.0 * wave.transcendentals);
}

}  // namespace walr::costs
