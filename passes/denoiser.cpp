#include "passes/denoiser.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "passes/pass_through.h"
#include "passes/walr.h"

namespace walr {
namespace {

fg::Texture addAccumulate(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output) {
  const Guides guides = addPrepareGuides(graph, inputs);
  return addPassThrough(graph, addTemporalAccumulation(graph, inputs, guides), output);
}

fg::Texture addNone(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output) {
  return addPassThrough(graph, inputs.lighting, output);
}

fg::Texture addDefaultWalr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output) {
  return addWalr(graph, inputs, output);
}

struct Denoiser {
  std::string_view name;
  fg::Texture (*add)(fg::Graph&, const DenoiserInputs&, fg::Texture);
};

constexpr std::array kDenoisers{
    Denoiser{"walr", addDefaultWalr},
    Denoiser{"accumulate", addAccumulate},
    Denoiser{"none", addNone},
};

}  // namespace

std::vector<std::string> denoiserNames() {
  std::vector<std::string> names;
  for (const Denoiser& denoiser : kDenoisers) names.emplace_back(denoiser.name);
  return names;
}

fg::Texture addDenoiser(fg::Graph& graph, std::string_view method, const DenoiserInputs& inputs, fg::Texture output) {
  const auto* found =
      std::find_if(kDenoisers.begin(), kDenoisers.end(), [&](const Denoiser& d) { return d.name == method; });
  if (found == kDenoisers.end()) {
    std::string known;
    for (const Denoiser& denoiser : kDenoisers) known.append(known.empty() ? "" : ", ").append(denoiser.name);
    throw std::invalid_argument("there is no method \"" + std::string(method) + "\"; known methods: " + known);
  }
  return found->add(graph, inputs, output);
}

}  // namespace walr
