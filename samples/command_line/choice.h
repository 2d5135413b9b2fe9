#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace walr {

/// Add an option that takes one of some words. Help and errors list them.
/// @param target   receives the value of the word; must outlive the parsing
/// @param choices  words and their values
/// @param initial  the word for the value that `target` has; empty: none
template <typename Target, typename Value>
CLI::Option* addChoice(CLI::App& command, const std::string& name, Target& target,
                       std::vector<std::pair<std::string, Value>> choices, const std::string& initial,
                       const std::string& description) {
  std::vector<std::string> words;
  std::string text;
  for (const auto& [word, value] : choices) {
    words.push_back(word);
    text += (text.empty() ? "" : "|") + word;
  }
  if (!initial.empty()) text += "=" + initial;
  const auto take = [&target, choices = std::move(choices)](const std::string& word) {
    target = std::ranges::find(choices, word, [](const auto& choice) { return choice.first; })->second;
  };
  return command.add_option_function<std::string>(name, take, description)
      ->check(CLI::IsMember(words))
      ->option_text(text);
}

}  // namespace walr
