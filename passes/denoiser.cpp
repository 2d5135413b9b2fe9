#include "passes/denoiser.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "passes/accumulate.h"
#include "passes/pass_through.h"
#include "passes/walr.h"

namespace walr {
namespace {

/// A method made of a settings struct and the function that adds its passes.
template <typename Settings, auto kAdd>
class DenoiserOf final : public Denoiser {
 public:
  void visitSettings(SettingVisitor& visitor) override { settings_.visit(visitor); }
  fg::Texture add(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output) override {
    checkSettings();
    return kAdd(graph, inputs, output, settings_);
  }

 private:
  Settings settings_;
};

template <typename Settings, auto kAdd>
std::unique_ptr<Denoiser> make() {
  return std::make_unique<DenoiserOf<Settings, kAdd>>();
}

struct NoSettings {
  void visit(SettingVisitor& /*visitor*/) {}
};

fg::Texture addNone(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const NoSettings& /*none*/) {
  return addPassThrough(graph, inputs.lighting, output);
}

struct Method {
  std::string_view name;
  std::unique_ptr<Denoiser> (*make)();
};

constexpr std::array kMethods{
    Method{"walr", make<WalrSettings, addWalr>},
    Method{"accumulate", make<AccumulateSettings, addAccumulate>},
    Method{"none", make<NoSettings, addNone>},
};

}  // namespace

std::vector<std::string> denoiserNames() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) names.emplace_back(method.name);
  return names;
}

std::unique_ptr<Denoiser> makeDenoiser(std::string_view method) {
  const auto* found = std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return m.name == method; });
  if (found == kMethods.end()) {
    std::string known;
    for (const Method& m : kMethods) known.append(known.empty() ? "" : ", ").append(m.name);
    throw std::invalid_argument("there is no method \"" + std::string(method) + "\"; known methods: " + known);
  }
  return found->make();
}

}  // namespace walr
