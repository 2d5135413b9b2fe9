#pragma once

#include <string>

namespace walr {

/// A word as a POSIX shell takes it: in quotes if it has characters that the shell may interpret.
std::string shellWord(const std::string& word);

}  // namespace walr
