#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace walr::costs {

/// Parse a file and have it read.
/// @throws std::runtime_error naming the file and what is wrong with it
template <typename Read>
void readJson(const std::filesystem::path& file, Read read) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot open " + file.string());
  try {
    read(nlohmann::json::parse(stream));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace walr::costs
