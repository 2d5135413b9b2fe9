#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace walr {

/// Create the directory if it does not exist, and check that files can be created in it.
/// @throws OutputError
void prepareOutputDirectory(const std::filesystem::path& directory);

/// Check, before the work for it begins, that a file can be written.
/// @throws OutputError
void prepareOutputFile(const std::filesystem::path& path);

/// Write a file completely or not at all: the bytes go to a temporary file in the same directory, which is then
/// renamed. An existing file is replaced, also where the path is a symbolic link to it. What is no regular file, such
/// as a pipe or /dev/stdout, is written to directly.
/// @throws OutputError; the temporary file is removed
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
/// The same for a text.
void writeFileAtomically(const std::filesystem::path& path, std::string_view text);

}  // namespace walr
