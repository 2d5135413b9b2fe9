#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace walr {

/// Parse JSON and have it read.
/// @param name of the text, for errors
/// @throws std::runtime_error with the name and what is wrong
template <typename Read>
void readJsonText(const std::string& name, std::string_view text, Read read) {
  try {
    read(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

/// The same of a file.
/// @throws std::runtime_error naming the file and what is wrong with it
template <typename Read>
void readJson(const std::filesystem::path& file, Read read) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot open " + file.string());
  readJsonText(file.string(), std::string(std::istreambuf_iterator<char>(stream), {}), read);
}

}  // namespace walr
