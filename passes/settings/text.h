#pragma once

#include <string>

namespace walr {

/// Names separated by commas, for messages and listings.
template <typename Names>
std::string join(const Names& names) {
  std::string text;
  for (const auto& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

}  // namespace walr
