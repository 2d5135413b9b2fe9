#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samples/bench/frame_errors.h"
#include "samples/bench/timing.h"

namespace walr {

/// What came of one variant on one sequence.
struct RunRecord {
  std::string variant;
  std::vector<FrameErrors> frames;
  bool reproducible = true;  ///< Every repetition gave the same bits.
  Timing timing;
};

/// @throws nlohmann::json::exception from `recordFromJson` where something is missing
nlohmann::ordered_json toJson(const RunRecord& record);
RunRecord recordFromJson(const nlohmann::ordered_json& json);

/// Finished runs on disk, each with a key that says what it was made from: an interrupted benchmark goes on where it
/// was, and a run whose key has changed is made again.
class RunStore {
 public:
  /// @param folder  made when the first run is written
  explicit RunStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The run, if it is there with this key. Files that cannot be understood count as missing.
  [[nodiscard]] std::optional<RunRecord> find(const std::string& sequence, const std::string& variant,
                                              const std::string& key) const;
  /// @throws OutputError
  void save(const std::string& sequence, const RunRecord& record, const std::string& key) const;

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& sequence, const std::string& variant) const;

  std::filesystem::path folder_;
};

}  // namespace walr
