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

/// Results of one variant on one sequence.
struct RunRecord {
  std::string variant;
  std::vector<FrameErrors> frames;
  bool reproducible = true;  ///< All repetitions gave bit-identical results.
  Timing timing;
};

/// @throws nlohmann::json::exception from `recordFromJson` if a member is missing
nlohmann::ordered_json toJson(const RunRecord& record);
RunRecord recordFromJson(const nlohmann::ordered_json& json);

/// Finished runs on disk, so that an interrupted benchmark can be resumed. Each has a key of everything that it depends
/// on; a run whose key has changed is repeated.
class RunStore {
 public:
  /// @param folder  created when the first run is written
  explicit RunStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The stored run with this key, if there is one. Unreadable files count as missing.
  [[nodiscard]] std::optional<RunRecord> find(const std::string& sequence, const std::string& variant,
                                              const std::string& key) const;
  /// @throws OutputError
  void save(const std::string& sequence, const RunRecord& record, const std::string& key) const;

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& sequence, const std::string& variant) const;

  std::filesystem::path folder_;
};

}  // namespace walr
