#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace walr {

/// A document as the text of a file, with a line end. Names that are not UTF-8, as those of files may be, get
/// replacement characters.
template <typename Json>
std::string jsonText(const Json& document, int indent) {
  return document.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace walr
