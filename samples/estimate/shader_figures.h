#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/estimate/wave_counts.h"

namespace walr {

/// What a compiler for AMD GPUs made of one pipeline.
struct ShaderFigures {
  std::string shader;                         ///< `fg::Shader::name`.
  std::vector<std::uint32_t> specialization;  ///< `fg::ComputeDispatch::specialization`.
  std::uint64_t waves = 0;                    ///< Waves of 64 threads that a SIMD holds at a time.
  std::optional<WaveCounts> wave;             ///< Nothing where the rounds of the shader's loops are not known.

  friend bool operator==(const ShaderFigures&, const ShaderFigures&) = default;
};

/// Estimated costs of a method at its default settings on one machine.
struct MethodEstimate {
  std::string variant;  ///< As `allMethods` of the benchmark names it, and "specular" or "both" for these lights.
  std::optional<double> cyclesPerPixel;
  double megabytes = 0.0;        ///< That the passes of a frame read and write.
  double memoryMegabytes = 0.0;  ///< Of histories and transient textures.
  std::optional<double> microseconds;
};

/// The static figures of all pipelines that the methods run at default settings: shader_figures.json. `shader_costs`,
/// a program beside the tests, writes it (`cmake --build build --target update_costs`). Programs that estimate GPU
/// times hold it embedded, because the compiler that it comes from need not be there when they run.
struct FigureTable {
  std::string driver;  ///< "Mesa 22.3.6".
  std::string family;  ///< "NAVI21".
  std::vector<ShaderFigures> shaders;
  std::string machine;  ///< That the estimates are for.
  fg::Extent extent;    ///< The same.
  /// Sums over the passes of each method, for scripts that cannot compute them.
  std::vector<MethodEstimate> estimates;

  /// The figures of a pipeline; null if it is none of the table's.
  [[nodiscard]] const ShaderFigures* find(const fg::ComputeDispatch& dispatch) const;
};

/// The table that is embedded in the program.
const FigureTable& shaderFigures();

/// @throws std::runtime_error naming the file and what is wrong with it
FigureTable readFigures(const std::filesystem::path& file);
/// One line per pipeline and method, so that a change of one shows as such.
std::string figuresJson(const FigureTable& table);

}  // namespace walr
