#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/staged_image.h"
#include "tests/vulkan/shaders.h"

/// Small graphs with known results, on 32-bit unsigned textures.
namespace fg::test {

/// Neither square nor a multiple of the work group size.
inline constexpr TextureDesc kTexture{VK_FORMAT_R32_UINT, {19, 13}};

inline Texture importOutput(Graph& graph, const std::string& name, const TextureDesc& desc = kTexture) {
  return graph.import(name, desc, vk::kOverwritable);
}

inline Texture fill(Graph& graph, const std::string& name, Texture target, std::uint32_t value) {
  auto pass = graph.compute(name, shaders::fill).constants(value);
  const Texture result = pass.store("target", target);
  pass.dispatch(graph.textureDesc(target).extent);
  return result;
}

inline Texture add(Graph& graph, const std::string& name, Texture source, Texture target, std::uint32_t value) {
  auto pass = graph.compute(name, shaders::add).sample("source", source).constants(value);
  const Texture result = pass.store("target", target);
  pass.dispatch(graph.textureDesc(target).extent);
  return result;
}

/// Arguments of an indirect dispatch of x times y work groups.
inline Buffer groupCount(Graph& graph, const std::string& name, std::uint32_t x, std::uint32_t y) {
  struct Push {
    std::uint32_t x;
    std::uint32_t y;
  };
  auto pass = graph.compute(name, shaders::groupCount).constants(Push{x, y});
  const Buffer arguments = pass.store("arguments", graph.buffer(name, {3 * sizeof(std::uint32_t)}));
  pass.dispatch({1, 1});
  return arguments;
}

/// The result of `fill`, plus `value`.
inline std::vector<std::uint32_t> filled(std::uint32_t value, Extent extent = kTexture.extent) {
  std::vector<std::uint32_t> texels;
  for (std::uint32_t y = 0; y < extent.height; ++y) {
    for (std::uint32_t x = 0; x < extent.width; ++x) texels.push_back(value + 100 * y + x);
  }
  return texels;
}

inline std::vector<std::uint32_t> constant(std::uint32_t value, Extent extent = kTexture.extent) {
  return std::vector<std::uint32_t>(static_cast<std::size_t>(extent.width) * extent.height, value);
}

/// fill -> add -> add -> ... -> "out": a chain of `length` additions of 1, through as many transients.
inline Texture chain(Graph& graph, std::uint32_t start, std::uint32_t length) {
  const Texture out = importOutput(graph, "out");
  Texture link = fill(graph, "fill", graph.texture("link0", kTexture), start);
  for (std::uint32_t i = 1; i < length; ++i) {
    const std::string number = std::to_string(i);
    link = add(graph, "add" + number, link, graph.texture("link" + number, kTexture), 1);
  }
  graph.exported(add(graph, "last", link, out, 1), vk::kReadable);
  return out;
}

/// A history that counts frames, read back as "count". Its age, which the pass gets as a push constant, is read back as
/// "age".
struct CountingGraph {
  explicit CountingGraph(const TextureDesc& desc = kTexture) {
    history = graph.history("counter", desc);
    count = importOutput(graph, "count", desc);
    age = importOutput(graph, "age", desc);
    struct Push {
      std::uint32_t unrelated = 0;
      std::uint32_t age = 12345;  // Overwritten by the executor.
    };
    auto pass = graph.compute("accumulate", shaders::accumulate)
                    .sample("previous", history.previous)
                    .constants(Push{})
                    .historyAge(history, offsetof(Push, age));
    const Texture current = pass.store("current", history.current);
    const Texture told = pass.store("toldAge", age);
    pass.dispatch(desc.extent);
    graph.exported(add(graph, "show", current, count, 0), vk::kReadable);
    graph.exported(told, vk::kReadable);
  }
  Graph graph;
  History history;
  Texture count;
  Texture age;
};

}  // namespace fg::test
