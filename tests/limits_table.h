#pragma once

#include <span>
#include <string>

#include <gtest/gtest.h>

#include "samples/image/file_limit.h"
#include "tests/guide_table.h"

namespace walr::test {

/// Compare limits with a table of the manual, or write it.
/// @param page  in the project
inline void checkTableOfLimits(std::span<const FileLimit> limits, const std::string& page, const std::string& name) {
  std::string table = "| most | of |\n| --- | --- |\n";
  for (const FileLimit& limit : limits) {
    table += "| " + std::to_string(limit.most) + " | " + std::string(limit.of) + " |\n";
  }
  const GuideTable manual(WALR_PROJECT "/" + page, name);
  if (GuideTable::writing()) return manual.write(table);
  EXPECT_EQ(manual.text(), table) << "cmake --build build --target update_guide";
}

}  // namespace walr::test
