#pragma once

#include <filesystem>
#include <iostream>
#include <optional>

namespace walr::render::test {

/// A file or folder of the data set beside the project; nothing, said on the console, where the data set is absent.
inline std::optional<std::filesystem::path> sharedData(const std::filesystem::path& relative) {
  const std::filesystem::path path = std::filesystem::path(WALR_SHARED_DATA) / relative;
  if (!std::filesystem::exists(path)) {
    std::cout << "not checked: there is no " << relative << " in the data set beside the project\n";
    return std::nullopt;
  }
  return path;
}

}  // namespace walr::render::test
