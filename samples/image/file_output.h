#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace walr {

/// Make the directory if need be, and check that files can be made in it.
/// @throws OutputError
void prepareOutputDirectory(const std::filesystem::path& directory);

/// Write a whole file, or nothing: the bytes go to a temporary name in the same directory which is then renamed.
/// Existing files are replaced.
/// @throws OutputError, with the temporary file removed
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace walr
