#pragma once

#include <string>

#include "passes/inputs.h"
#include "passes/prepare_guides.h"
#include "tests/passes/reference/guides.h"
#include "tests/vulkan/graph_run.h"

/// The textures of a host between the pictures of the tests, in double precision, and the GPU.
namespace walr::test {

/// Import all that every host has.
DenoiserInputs importInputs(fg::Graph& graph, glm::ivec2 size, const InputConventions& conventions = {});
/// Import object numbers, which a host may have, too.
fg::Texture importObjectIds(fg::Graph& graph, glm::ivec2 size);
/// Have the next frame upload a host's frame.
void upload(fg::test::GraphRun& run, const DenoiserInputs& inputs, const reference::HostFrame& frame);

/// How far occluders are looked for in the small pictures of the tests.
inline constexpr AmbientOcclusionSettings kOcclusionInSmallPictures{.radius = 0.25F, .steps = 8};
/// Import guides of this frame and the last, as if the first stage had made them.
Guides importGuides(fg::Graph& graph, glm::ivec2 size);
/// Have the next frame upload this frame's guides, which must hold values that the packed form that is read keeps
/// exactly.
void upload(fg::test::GraphRun& run, const Guides& guides, const reference::Image<reference::Guide>& values);
/// The same for the last frame's, for passes with a history.
void uploadPrevious(fg::test::GraphRun& run, const Guides& guides, const reference::Image<reference::Guide>& values);

/// Import an RGBA16F texture, for passes that read nothing else of a host.
fg::Texture importHalves(fg::Graph& graph, const std::string& name, glm::ivec2 size);
/// Have the next frame upload it; values are rounded to halves.
void upload(fg::test::GraphRun& run, fg::Texture texture, const reference::Image<glm::dvec4>& values);

/// A picture with alpha 0.
reference::Image<glm::dvec4> withAlpha(const reference::Image<glm::dvec3>& image);

/// An RGBA16F texture of the host for a denoiser's result.
fg::Texture importOutput(fg::Graph& graph, glm::ivec2 size);
/// Copy a texture of halves, of one to four channels, to one that `readHalves` can read.
fg::Texture copyOut(fg::Graph& graph, const std::string& name, fg::Texture texture);
/// An output as the last frame left it.
reference::Image<glm::dvec4> readHalves(const fg::test::GraphRun& run, fg::Texture output, glm::ivec2 size);

}  // namespace walr::test
