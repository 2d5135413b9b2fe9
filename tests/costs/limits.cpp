#include "tests/costs/limits.h"

namespace walr::costs {
namespace {

constexpr std::uint64_t kLeastWaves = 3;

std::string where(const MethodCosts& method, const PassCosts& pass) {
  return method.name.text() + ", " + pass.pass + ": ";
}

}  // namespace

std::vector<std::string> violations(const std::vector<MethodCosts>& methods) {
  std::vector<std::string> found;
  for (const MethodCosts& method : methods) {
    for (const PassCosts& pass : method.passes) {
      const auto require = [&](bool within, const std::string& what) {
        if (!within) found.push_back(where(method, pass) + what);
      };
      const CompiledShader& compiled = pass.compiled;
      require(compiled.spills == 0, std::to_string(compiled.spills) + " spilled registers, and not 0");
      require(compiled.scratchBytes == 0,
              std::to_string(compiled.scratchBytes) + " bytes of scratch memory, and not 0");
      require(compiled.waves >= kLeastWaves,
              std::to_string(compiled.waves) + " waves a SIMD, and not " + std::to_string(kLeastWaves) + " at least");
    }
  }
  return found;
}

std::vector<std::string> unknownLoops(const std::vector<MethodCosts>& methods) {
  std::vector<std::string> found;
  for (const MethodCosts& method : methods) {
    for (const PassCosts& pass : method.passes) {
      if (pass.wave) continue;
      found.push_back(where(method, pass) + pass.shader + " has " + std::to_string(pass.loops) +
                      " loops; write the rounds of each into trip_counts.json");
    }
  }
  return found;
}

}  // namespace walr::costs
