#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/costs/listing.h"

namespace walr::costs {

/// Rounds of loops in shaders: read from trip_counts.json, which says where they come from.
class TripCounts {
 public:
  /// @throws std::runtime_error naming the file
  explicit TripCounts(const std::filesystem::path& file);

  /// Nothing where the shader has another number of loops than
  /// the file says: the compiler has unrolled one, or the shader has changed.
  [[nodiscard]] std::optional<LoopCounts> of(std::string_view shader, std::size_t loops) const;

 private:
  struct Entry {
    std::string shader;
    std::vector<std::vector<double>> rounds;
    double divergent = 1.0;
  };
  std::vector<Entry> entries_;
};

}  // namespace walr::costs
