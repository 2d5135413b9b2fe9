#pragma once

#include <string>

#include "passes/conventions/inputs.h"
#include "passes/guides/prepare_guides.h"
#include "tests/passes/reference/guides.h"
#include "tests/vulkan/graph_run.h"

/// A host's textures on the GPU, filled from and read back to the double-precision images of the tests.
namespace walr::test {

/// Import the inputs that every host provides.
/// @param specularMotion whether also this optional one
DenoiserInputs importInputs(fg::Graph& graph, glm::ivec2 size, const InputConventions& conventions = {},
                            bool specularMotion = false);
/// Import object numbers, an optional input.
fg::Texture importObjectIds(fg::Graph& graph, glm::ivec2 size);
/// Upload a host's frame before the next frame runs.
void upload(fg::test::GraphRun& run, const DenoiserInputs& inputs, const reference::HostFrame& frame);

/// Ambient occlusion with a radius that suits the small images of the tests.
inline constexpr AmbientOcclusionSettings kOcclusionInSmallImages{.radius = 0.25F, .rings = 8};
/// Import guides of this frame and the previous one, in place of those that `prepare guides` would write.
/// @param occlusion whether ambient occlusion is one of them, which decides how all of them are packed
Guides importGuides(fg::Graph& graph, glm::ivec2 size, bool occlusion = false);
/// Upload this frame's guides before the next frame runs. Their values must be exact in the packed form that is read.
void upload(fg::test::GraphRun& run, const Guides& guides, const reference::Image<reference::Guide>& values);
/// Upload the previous frame's guides, for passes with a history.
void uploadPrevious(fg::test::GraphRun& run, const Guides& guides, const reference::Image<reference::Guide>& values);

/// Import an RGBA16F texture, for passes that read no other input of a host.
fg::Texture importHalves(fg::Graph& graph, const std::string& name, glm::ivec2 size);
/// Upload it before the next frame runs; values are rounded to halves.
void upload(fg::test::GraphRun& run, fg::Texture texture, const reference::Image<glm::dvec4>& values);

/// The image with alpha 0.
reference::Image<glm::dvec4> withAlpha(const reference::Image<glm::dvec3>& image);

/// Import an RGBA16F texture for a denoiser's result.
fg::Texture importOutput(fg::Graph& graph, glm::ivec2 size);
/// Copy a texture of halves with one to four channels to one that `readHalves` can read.
fg::Texture copyOut(fg::Graph& graph, const std::string& name, fg::Texture texture);
/// Read an output of the last frame.
reference::Image<glm::dvec4> readHalves(const fg::test::GraphRun& run, fg::Texture output, glm::ivec2 size);

}  // namespace walr::test
