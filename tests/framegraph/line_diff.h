#pragma once

#include <string>
#include <string_view>

namespace fg::test {

/// Line-by-line difference of two texts: "- " marks removed lines and "+ " added ones. Unchanged lines around them are
/// shown as context; "..." replaces further unchanged lines. Empty if the texts are equal.
std::string lineDiff(std::string_view before, std::string_view after);

}  // namespace fg::test
