#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace fg::test {

/// What the error of this type says that a call throws; empty where it throws none.
template <typename Error = std::invalid_argument, typename Call>
std::string errorText(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

inline void expectContains(const std::string& text, std::initializer_list<std::string_view> parts) {
  for (const std::string_view part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in: \"" << text << '"';
  }
}

/// A call must throw an error of this type that says all of these parts.
template <typename Error = std::invalid_argument, typename Call>
void expectError(Call call, std::initializer_list<std::string_view> parts) {
  expectContains(errorText<Error>(call), parts);
}

}  // namespace fg::test
