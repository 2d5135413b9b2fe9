#pragma once

#include <functional>
#include <vector>

#include "tests/passes/host_textures.h"
#include "tests/passes/reference/lobe_filter.h"
#include "tests/vulkan/test_device.h"

namespace walr::test {

/// Passes on a device that read guides and RGBA16F textures and write one texture, which is read as halves.
class FilterRun {
 public:
  /// Adds the passes to a graph and returns their result. The inputs have the order in which `run` takes them.
  using Add = std::function<fg::Texture(fg::Graph& graph, fg::Buffer frame, const Guides& guides,
                                        const std::vector<fg::Texture>& inputs)>;

  /// @param inputSizes of the textures that the passes read
  /// @param occlusion  whether the guides include ambient occlusion
  /// @param reflectors given for specular light: they stand in `Guides::features`
  FilterRun(const fg::test::TestDevice& device, glm::ivec2 size, const std::vector<glm::ivec2>& inputSizes,
            const Add& add, bool occlusion = false, const reference::Image<reference::Reflector>& reflectors = {});
  /// The same with inputs that all have the size of the guides.
  FilterRun(const fg::test::TestDevice& device, glm::ivec2 size, std::size_t inputCount, const Add& add,
            bool occlusion = false, const reference::Image<reference::Reflector>& reflectors = {});

  /// The result for these guides and inputs. Only the constants of the frame are used.
  reference::Image<glm::dvec4> run(const reference::HostFrame& frame, const reference::Image<reference::Guide>& guides,
                                   const std::vector<reference::Image<glm::dvec4>>& inputs);

 private:
  fg::Graph graph_;
  fg::Buffer frame_;
  Guides guides_;
  reference::Image<reference::Reflector> reflectors_;
  std::vector<fg::Texture> inputs_;
  fg::Texture output_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

}  // namespace walr::test
