#include "samples/command_line/light_rate.h"

#include <map>

namespace walr {
namespace {

/// Values of `--light-rate`.
const std::map<std::string, LightPattern>& lightRates() {
  static const std::map<std::string, LightPattern> kRates{
      {"1", {}}, {"1/2", {.columns = 2}}, {"1/4", {.columns = 2, .rows = 2}}, {"1/9", {.columns = 3, .rows = 3}}};
  return kRates;
}

}  // namespace

void addLightRate(CLI::App& command, LightPattern& light, const std::string& description) {
  command
      .add_option_function<std::string>(
          "--light-rate", [&light](const std::string& rate) { light = lightRates().at(rate); }, description)
      ->check(CLI::IsMember(lightRates()))
      ->type_name("")
      ->default_str("1");
}

}  // namespace walr
