#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/functions.h"

namespace fg::test {

/// A random graph of real passes, which can also be run on the CPU in the order of declaration.
///
/// It has textures of several sizes and versions, which are sampled, loaded, overwritten and updated in place. It also
/// has storage buffers, indirect dispatches, clears by callbacks, an upload, imports, exports, histories, and passes
/// without effect.
class RandomGraph {
 public:
  /// @param functions for callback passes; must outlive the graph
  RandomGraph(std::uint32_t seed, const vk::DeviceFunctions& functions);

  [[nodiscard]] const Graph& graph() const { return graph_; }
  /// Upload buffer of one uint.
  [[nodiscard]] Buffer frame() const { return frame_; }
  /// Imports that the host fills, all R32_UINT like every texture here.
  [[nodiscard]] const std::vector<Texture>& inputs() const { return inputs_; }
  /// Imports that the graph overwrites and exports.
  [[nodiscard]] const std::vector<Texture>& outputs() const { return outputs_; }
  [[nodiscard]] const std::vector<History>& histories() const { return histories_; }
  /// Texels of an input, which are the same in every frame, or of an output after `runOnCpu`.
  [[nodiscard]] const std::vector<std::uint32_t>& texels(Texture texture) const { return values_[texture.resource]; }

  /// Run one frame on the CPU.
  void runOnCpu(std::uint32_t frameValue);
  void resetHistoryOnCpu(const History& history);

 private:
  struct Variant;
  static const std::vector<Variant>& variants();

  /// One pass for execution on the CPU.
  struct Operation {
    Extent extent;
    bool isClear = false;
    std::uint32_t seed = 0;            ///< Seed of the hash, or colour of a clear.
    std::vector<std::uint32_t> reads;  ///< Resources in the order in which the shader hashes them.
    /// Resources written, each with the number that the shader adds to the hash.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> writes;
  };

  std::uint32_t below(std::uint32_t limit) { return random_() % limit; }
  bool chance(std::uint32_t oneIn) { return below(oneIn) == 0; }
  Extent randomExtent();
  [[nodiscard]] std::string nextName(const char* kind) { return kind + std::to_string(names_++); }
  std::uint32_t newTexture(Extent extent);
  [[nodiscard]] Texture latest(std::uint32_t resource) const;
  [[nodiscard]] Extent extentOf(std::uint32_t resource) const;
  void remember(ResourceVersion version);
  /// Draw a resource from a list that is not in `taken`, and add it there; kNone if there is none.
  std::uint32_t draw(const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& taken);

  void declareImports();
  void declareHistories();
  void addRandomPass();
  void addClear();
  void addMix(const Variant& variant, std::uint32_t target);
  /// Overwrite a texture through a pass with one output. For histories and exports.
  void finish(std::uint32_t target);
  [[nodiscard]] std::uint32_t read(std::uint32_t resource, std::uint32_t x, std::uint32_t y, std::uint32_t index) const;
  void run(const Operation& operation);

  const vk::DeviceFunctions* functions_;
  std::mt19937 random_;
  Graph graph_;
  Buffer frame_;
  std::vector<Texture> inputs_;
  std::vector<Texture> outputs_;
  std::vector<History> histories_;
  std::vector<std::uint32_t> readable_;  ///< Textures with contents.
  std::vector<std::uint32_t> writable_;  ///< Those of `readable_` that may be written again.
  std::vector<std::uint32_t> buffers_;   ///< Buffers with contents.
  std::vector<std::uint32_t> versions_;  ///< Indexed by resource: latest version.
  std::vector<Operation> operations_;
  std::vector<std::vector<std::uint32_t>> values_;  ///< Indexed by resource: contents on the CPU.
  std::uint32_t names_ = 0;
};

}  // namespace fg::test
