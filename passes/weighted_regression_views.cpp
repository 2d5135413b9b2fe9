#include "passes/weighted_regression_views.h"

#include <array>
#include <charconv>
#include <stdexcept>
#include <string>

#include "passes/text.h"

namespace walr {
namespace {

struct Quantity {
  std::string_view name;
  std::string_view description;
};

/// In the order of `kView` of atrous.comp.
constexpr std::array kQuantities{
    Quantity{"edges",
             "Step of the nearest edge on the eight traces (one past the last: none), taps replaced, taps lost"},
    Quantity{"samples", "Sample count W, relative variance of a sample, 1 where a pixel has no finite sample"},
    Quantity{"pivots", "Smaller pivot of the solve before regularisation, ridge or floor, 1 where that outweighs it"},
    Quantity{"feature-mean", "Mean of the two features, and 0"},
    Quantity{"feature-covariance", "Covariances uu, uv, vv of the features"},
    Quantity{"colour-mean", "Mean of the colour"},
    Quantity{"covariance-u", "Covariances of the colour with the first feature"},
    Quantity{"covariance-v", "Covariances of the colour with the second feature"},
    Quantity{"slope-u", "Coefficients of the first feature in the fit"},
    Quantity{"slope-v", "Coefficients of the second feature in the fit"},
    Quantity{"clamped", "1 in each channel where the fit is below 0 or beyond the largest half"},
};

std::string knownNames() {
  std::vector<std::string> names;
  for (const Quantity& quantity : kQuantities) names.emplace_back(quantity.name);
  return join(names);
}

}  // namespace

std::vector<ViewInfo> weightedRegressionViews() {
  std::vector<ViewInfo> views;
  for (const Quantity& quantity : kQuantities)
    views.push_back({std::string(quantity.name), std::string(quantity.description)});
  return views;
}

RegressionView parseRegressionView(std::string_view name, std::uint32_t iterations) {
  RegressionView view{.iteration = iterations - 1};
  const std::string_view quantity = name.substr(0, name.find('.'));
  while (view.quantity < kQuantities.size() && kQuantities.at(view.quantity).name != quantity) ++view.quantity;
  if (view.quantity == kQuantities.size()) {
    throw std::invalid_argument("there is no view \"" + std::string(name) + "\"; known views: " + knownNames());
  }
  if (quantity.size() == name.size()) return view;
  const std::string_view number = name.substr(quantity.size() + 1);
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), view.iteration);
  const bool whole = error == std::errc() && end == number.data() + number.size();
  if (!whole || view.iteration >= iterations) {
    throw std::invalid_argument("view \"" + std::string(name) +
                                "\" asks for an iteration that there is not; after the " + "dot comes 0 to " +
                                std::to_string(iterations - 1));
  }
  return view;
}

}  // namespace walr
