#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/executor.h"

namespace walr::host {

/// Reloads shaders while a program runs: when a source changes, it is compiled with the command of the build, and the
/// next frame uses it. Histories are kept. For developers: see the CMake option WALR_RELOAD_SHADERS.
class ShaderReloader {
 public:
  /// @param commands  the build's list of commands, one line a shader; see `walr_add_shaders`
  /// @param built     the folder of the sources in these commands
  /// @param sources   the folder that is watched and compiled in its place; may be the same
  /// @param messages  receives a line for every shader that is reloaded, and the compiler's errors; must outlive this
  /// @throws std::runtime_error naming a list of commands that cannot be read, or a folder without shaders
  ShaderReloader(const std::filesystem::path& commands, const std::filesystem::path& built,
                 const std::filesystem::path& sources, std::ostream& messages);
  ~ShaderReloader();
  ShaderReloader(const ShaderReloader&) = delete;
  ShaderReloader& operator=(const ShaderReloader&) = delete;

  /// Look for changes and reload the shaders that they change. A shader that does not compile, or that has other
  /// bindings or constants than the program knows, stays as it is. Call it between frames.
  /// @param graph  that the executor runs
  /// @returns number of shaders that the executor got
  std::size_t poll(const fg::GraphDesc& graph, fg::vk::Executor& executor);

 private:
  using Words = std::vector<std::uint32_t>;
  using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
  struct Command {
    std::string line;  ///< Without the output.
    Words words;       ///< Compiled last.
  };

  [[nodiscard]] Times times() const;
  [[nodiscard]] bool reload(const fg::Shader& shader, Command& command, fg::vk::Executor& executor);

  std::filesystem::path sources_;
  std::ostream& messages_;
  std::filesystem::path output_;                          ///< Of the compiler.
  std::map<std::string, Command, std::less<>> commands_;  ///< By shader.
  Times times_;                                           ///< Of the sources compiled last.
};

}  // namespace walr::host
