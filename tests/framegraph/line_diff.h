#pragma once

#include <string>
#include <string_view>

namespace fg::test {

/// What has to be done to the lines of one text to get another: "- " before lines that go, "+ " before lines that come,
/// unchanged lines around them for context, "..." where such lines are left out. Empty where the texts are equal.
std::string lineDiff(std::string_view before, std::string_view after);

}  // namespace fg::test
