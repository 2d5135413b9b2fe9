#include "samples/bench/bench.h"

#include <algorithm>
#include <map>
#include <optional>
#include <ostream>
#include <span>

#include "samples/bench/batch.h"
#include "samples/denoise/packed_frame.h"
#include "samples/denoise/progress.h"
#include "samples/errors.h"
#include "samples/image/file_output.h"
#include "samples/image/fingerprint.h"

namespace walr {
namespace {

/// Key of what all runs on a sequence depend on: program, device, repetitions, sequence.
std::string sequenceKey(const GpuDevice& device, const NamedSequence& sequence, const BenchOptions& options) {
  Fingerprint key;
  key.addFile("/proc/self/exe").add(device.name()).add(device.driver()).add(std::to_string(options.repetitions));
  key.add(options.allPictures ? "all pictures" : "few pictures");
  const InputConventions& conventions = sequence.sequence.denoiserLayout().conventions;
  key.add(std::to_string(static_cast<int>(conventions.motionDepth)));
  key.add(conventions.specular ? "specular" : "diffuse");
  key.add(std::to_string(conventions.light.columns) + " x " + std::to_string(conventions.light.rows));
  for (const Sequence::Entry& entry : sequence.sequence.entries()) {
    key.addFile(entry.file);
    for (const std::filesystem::path& beside : {entry.reference, entry.specular}) {
      if (!beside.empty()) key.addFile(beside);
    }
    key.add(entry.resetHistory ? "reset" : "carried");
    // A frame's number chooses its random numbers.
    key.add(std::to_string(entry.number));
    key.add(std::as_bytes(std::span(&entry.lightOffset, 1)));
    // The part of cameras.json that affects results.
    key.add(std::as_bytes(std::span(&entry.camera.jitter, 1)));
    for (const glm::mat4* matrix : {&entry.camera.view, &entry.camera.previousView, &entry.camera.projection}) {
      key.add(std::as_bytes(std::span(matrix, 1)));
    }
  }
  return key.text();
}

/// @param base  key of everything else that the run depends on
std::string runKey(const std::string& base, const Variant& variant) {
  Fingerprint key;
  key.add(base).add(variant.method);
  for (const auto& [name, value] : settingsOf(variant)) key.add(name).add(value);
  return key.text();
}

/// The missing runs of one sequence.
struct Work {
  const NamedSequence* sequence;
  std::string key;
  std::vector<std::vector<Variant>> batches;  ///< Each with the baseline first.
};

std::vector<std::vector<Variant>> batchesOf(const std::vector<Variant>& missing, const Variant& baseline,
                                            std::size_t size) {
  std::vector<std::vector<Variant>> batches;
  for (const Variant& variant : missing) {
    if (variant == baseline) continue;
    if (batches.empty() || batches.back().size() >= std::max<std::size_t>(size, 2)) batches.push_back({baseline});
    batches.back().push_back(variant);
  }
  if (batches.empty() && !missing.empty()) batches.push_back({baseline});
  return batches;
}

std::map<std::string, std::vector<PlanCosts>> allCosts(const std::vector<NamedSequence>& sequences,
                                                       const std::vector<Variant>& variants) {
  std::vector<fg::Extent> extents;
  const auto addOnce = [&](fg::Extent extent) {
    if (std::ranges::find(extents, extent) == extents.end()) extents.push_back(extent);
  };
  for (const NamedSequence& sequence : sequences) addOnce(sequence.sequence.extent());
  const std::size_t required = extents.size();
  std::ranges::for_each(kCommonExtents, addOnce);
  const InputConventions conventions =
      sequences.empty() ? InputConventions{} : sequences.front().sequence.denoiserLayout().conventions;
  std::map<std::string, std::vector<PlanCosts>> costs;
  for (const Variant& variant : variants) {
    for (std::size_t i = 0; i < extents.size(); ++i) {
      try {
        costs[variant.name].push_back(planCosts(variant, extents[i], conventions));
      } catch (const std::invalid_argument&) {  // Some settings do not support the largest images.
        if (i < required) throw;
      }
    }
  }
  return costs;
}

}  // namespace

std::vector<NamedSequence> openSequences(const std::vector<std::filesystem::path>& folders,
                                         const SequenceOptions& options) {
  std::vector<NamedSequence> sequences;
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path whole = std::filesystem::weakly_canonical(folder);
    NamedSequence named{whole.filename().string(), folder, Sequence(folder, options)};
    if (std::ranges::all_of(named.sequence.entries(), [](const auto& entry) { return entry.reference.empty(); })) {
      throw InputError(
          folder.string() +
          ": no frame has a reference (ref_FFFF.exr), so no errors can be measured. "
          "Render references for some frames, or use 'walr denoise --json', which reports times without them");
    }
    checkCameras(named.sequence);
    if (std::ranges::find(sequences, named.name, &NamedSequence::name) != sequences.end()) {
      throw InputError("two sequences have the name '" + named.name +
                       "': the report identifies sequences by the names of their folders, so rename one");
    }
    const NamedSequence& first = sequences.empty() ? named : sequences.front();
    if (named.sequence.denoiserLayout().conventions.light != first.sequence.denoiserLayout().conventions.light) {
      throw InputError("the sequences '" + first.name + "' and '" + named.name +
                       "' differ in the pixels that have a sample of light, and so in what methods cost: compare "
                       "methods on each alone");
    }
    sequences.push_back(std::move(named));
  }
  return sequences;
}

std::filesystem::path pictureFolder(const std::filesystem::path& output, const std::string& sequence) {
  return output / "pictures" / sequence;
}

BenchReport bench(const GpuDevice& device, const std::vector<NamedSequence>& sequences, const BenchOptions& options,
                  std::ostream& log, bool terminal) {
  BenchReport report;
  report.build = buildInfo();
  report.specular = !sequences.empty() && judgedLight(sequences.front().sequence) == Light::Specular;
  report.repetitions = options.repetitions;
  report.variants = options.variants;
  for (const Variant& variant : options.variants) report.settings[variant.name] = settingsOf(variant);
  report.costs = allCosts(sequences, options.variants);
  const fg::vk::DeviceContext& context = device.device().context();
  report.device = {device.name(), device.driver(), device.isSoftware(),
                   context.timestampBits > 0 ? context.properties.limits.timestampPeriod : 0.0};

  const RunStore store(options.output / "runs");
  std::vector<Work> work;
  std::size_t frames = 0;
  for (const NamedSequence& sequence : sequences) {
    Work todo{&sequence, sequenceKey(device, sequence, options), {}};
    std::vector<Variant> missing;
    for (const Variant& variant : options.variants) {
      if (!store.find(sequence.name, variant.name, runKey(todo.key, variant))) missing.push_back(variant);
    }
    log << sequence.name << ": " << options.variants.size() - missing.size() << " of " << options.variants.size()
        << " variants have been run already" << std::endl;
    if (const std::string assumption = sequence.sequence.assumption(); !assumption.empty()) {
      log << sequence.name << ": " << assumption << std::endl;
    }
    todo.batches = batchesOf(missing, options.variants.front(), options.batch);
    frames += todo.batches.size() * sequence.sequence.entries().size() * (options.repetitions + 1);
    work.push_back(std::move(todo));
  }

  std::optional<Progress> progress;
  if (frames > 0) progress.emplace(log, terminal, "frame", frames, Progress::Clock::now());
  for (const Work& todo : work) {
    const Sequence& sequence = todo.sequence->sequence;
    SequenceReport& result = report.sequences.emplace_back();
    result.name = todo.sequence->name;
    result.layout = sequence.layout().layout->name;
    result.extent = sequence.extent();
    result.frames = survey(sequence);
    result.pictureFrames = options.allPictures ? judgedFrames(result.frames) : pictureFrames(result.frames);
    BatchOptions batch{.repetitions = options.repetitions,
                       .pictureFrames = result.pictureFrames,
                       .pictures = pictureFolder(options.output, result.name),
                       .frameDone = [&] { progress->advance(Progress::Clock::now()); }};
    prepareOutputDirectory(batch.pictures);
    for (const std::vector<Variant>& variants : todo.batches) {
      const std::vector<RunRecord> records = runBatch(device, sequence, variants, batch);
      for (std::size_t i = 0; i < records.size(); ++i)
        store.save(result.name, records[i], runKey(todo.key, variants[i]));
    }
    for (const Variant& variant : options.variants) {
      result.runs.push_back(store.find(result.name, variant.name, runKey(todo.key, variant)).value());
    }
  }
  progress.reset();
  if (options.response) report.responses = responses(device, options.variants);
  if (options.hardCases) {
    report.numerics = numerics(device, numericsSettings());
    report.methodHardCases = methodHardCases(device, options.variants);
  }
  return report;
}

}  // namespace walr
