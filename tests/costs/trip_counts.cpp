#include "tests/costs/trip_counts.h"

#include <algorithm>

#include "samples/estimate/json_file.h"

namespace walr::costs {
namespace {

/// "atrous" stands for "atrous" and "atrous.raw16", not for "atrous_view".
bool standsFor(std::string_view entry, std::string_view shader) {
  return shader.starts_with(entry) && (shader.size() == entry.size() || shader[entry.size()] == '.');
}

}  // namespace

TripCounts::TripCounts(const std::filesystem::path& file) {
  readJson(file, [&](const nlohmann::json& json) {
    for (const nlohmann::json& shader : json.at("shaders")) {
      entries_.push_back({shader.at("shader"), shader.at("rounds"), shader.value("divergent", 1.0)});
    }
  });
}

std::optional<LoopCounts> TripCounts::of(std::string_view shader, std::size_t loops) const {
  if (loops == 0) return LoopCounts();
  const Entry* entry = nullptr;
  for (const Entry& candidate : entries_) {
    const bool longer = entry == nullptr || candidate.shader.size() > entry->shader.size();
    if (longer && standsFor(candidate.shader, shader)) entry = &candidate;
  }
  if (entry == nullptr) return std::nullopt;
  const auto found = std::ranges::find(entry->rounds, loops, &std::vector<double>::size);
  if (found == entry->rounds.end()) return std::nullopt;
  return LoopCounts{*found, entry->divergent};
}

}  // namespace walr::costs
