#include "tests/framegraph/line_diff.h"

#include <gtest/gtest.h>

namespace fg::test {
namespace {

TEST(LineDiff, OfEqualTextsIsEmpty) {
  EXPECT_EQ(lineDiff("", ""), "");
  EXPECT_EQ(lineDiff("a\nb\n", "a\nb\n"), "");
}

TEST(LineDiff, ShowsChangedLinesWithContext) {
  EXPECT_EQ(lineDiff("1\n2\n3\n4\n5\n6\n7\n8\n9\n", "1\n2\n3\n4\nfive\n6\n7\n8\n9\n"),
            "...\n  3\n  4\n- 5\n+ five\n  6\n  7\n...\n");
}

TEST(LineDiff, ShowsAddedAndRemovedLines) {
  EXPECT_EQ(lineDiff("a\nb\n", "b\nc\n"), "- a\n  b\n+ c\n");
  EXPECT_EQ(lineDiff("", "a\n"), "+ a\n");
  EXPECT_EQ(lineDiff("a\n", ""), "- a\n");
}

TEST(LineDiff, ReportsAMissingEndOfLine) {
  EXPECT_FALSE(lineDiff("a\n", "a").empty());
}

}  // namespace
}  // namespace fg::test
