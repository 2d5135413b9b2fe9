#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/functions.h"

namespace fg::test {

/// A graph of real passes drawn at random, and the same passes on the CPU in the order of declaration.
///
/// It has textures of several sizes and several versions, sampled, loaded, overwritten and updated in place; storage
/// buffers, indirect dispatches, clears by callbacks, an upload, imports, exports, histories, and passes that reach
/// nothing.
class RandomGraph {
 public:
  /// @param functions for callback passes; must outlive the graph
  RandomGraph(std::uint32_t seed, const vk::DeviceFunctions& functions);

  [[nodiscard]] const Graph& graph() const { return graph_; }
  /// Upload of one uint.
  [[nodiscard]] Buffer frame() const { return frame_; }
  /// Imports that the host fills, all R32_UINT like every texture here.
  [[nodiscard]] const std::vector<Texture>& inputs() const { return inputs_; }
  /// Imports that the graph overwrites and exports.
  [[nodiscard]] const std::vector<Texture>& outputs() const { return outputs_; }
  [[nodiscard]] const std::vector<History>& histories() const { return histories_; }
  /// Texels of an input, the same in every frame; of an output, what `runOnCpu` left there.
  [[nodiscard]] const std::vector<std::uint32_t>& texels(Texture texture) const { return values_[texture.resource]; }

  /// Run one frame on the CPU.
  void runOnCpu(std::uint32_t frameValue);
  void resetHistoryOnCpu(const History& history);

 private:
  struct Variant;
  static const std::vector<Variant>& variants();

  /// One pass as the CPU runs it.
  struct Operation {
    Extent extent;
    bool isClear = false;
    std::uint32_t seed = 0;            ///< Or the colour of a clear.
    std::vector<std::uint32_t> reads;  ///< Resources in the order in which the shader hashes them.
    /// Resources written, and what the shader adds to the hash for each.
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
  /// A resource out of a list that is not in `taken`, which it joins; kNone where there is none.
  std::uint32_t draw(const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& taken);

  void declareImports();
  void declareHistories();
  void addRandomPass();
  void addClear();
  void addMix(const Variant& variant, std::uint32_t target);
  /// Overwrite a texture by a pass with one output; for histories and exports.
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
  std::vector<std::uint32_t> writable_;  ///< Those of them that may be written again.
  std::vector<std::uint32_t> buffers_;   ///< Buffers with contents.
  std::vector<std::uint32_t> versions_;  ///< Latest version by resource.
  std::vector<Operation> operations_;
  std::vector<std::vector<std::uint32_t>> values_;  ///< Contents on the CPU by resource.
  std::uint32_t names_ = 0;
};

}  // namespace fg::test
