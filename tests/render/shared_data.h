#pragma once

#include <filesystem>
#include <iostream>
#include <optional>

namespace walr::render::test {

/// The path of a file or folder of the data set beside the project. If it is absent: nullopt, and a line on the
/// console.
inline std::optional<std::filesystem::path> sharedData(const std::filesystem::path& relative) {
  const std::filesystem::path path = std::filesystem::path(WALR_SHARED_DATA) / relative;
  if (!std::filesystem::exists(path)) {
    std::cout << "not checked: the data set beside the project has no " << relative << '\n';
    return std::nullopt;
  }
  return path;
}

}  // namespace walr::render::test
