#include "tests/costs/listing.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace walr::costs {
namespace {

/// Frequencies of the blocks of a listing.
std::vector<double> frequencies(const char* assembly, const LoopCounts& loops = {}) {
  return blockFrequencies(Listing(assembly), loops);
}

TEST(Listing, CountsInstructionsByKind) {
  const Listing listing(
      "BB0:\n"
      "\ts_load_dwordx8 s[8:15], s[2:3], null                        ; f40c0201 fa000000\n"
      "\timage_load v0, v[2:3], s[8:15] dmask:0x1                    ; f0003108 00020002\n"
      "\timage_load v1, v[4:5], s[8:15] dmask:0x1                    ; f0003108 00020002\n"
      "\ts_waitcnt vmcnt(1)                                          ; bf8c3f71\n"
      "\tv_mul_lo_u32 v0, v0, v0                                     ; d5690000\n"
      "\ts_waitcnt vmcnt(0)                                          ; bf8c3f70\n"
      "\tv_rcp_f32_e32 v1, v1                                        ; 7e025501\n"
      "\timage_store v0, v[2:3], s[8:15] dmask:0x1                   ; f0203108 00020002\n"
      "\ts_endpgm                                                    ; bf810000\n");
  const auto frequency = blockFrequencies(listing, {});
  const WaveCounts counts = countWave(listing, frequency);
  EXPECT_EQ(counts.vector, 2.0);
  EXPECT_EQ(counts.multiplications, 1.0);
  EXPECT_EQ(counts.transcendentals, 1.0);
  EXPECT_EQ(counts.fetches, 3.0);
  EXPECT_EQ(counts.waits, 1.0) << "both waits are for the fetches that were issued together";
  EXPECT_EQ(fetchInstructions(listing), 3U);
  EXPECT_EQ(branchInstructions(listing), 0U);
}

TEST(Listing, RunsNestedLoopsByTheProductOfTheirTripCounts) {
  constexpr const char* kNested =
      "BB0:\n\tv_mov_b32 v0, 0 ; 0\n"
      "BB2:\n\ts_cbranch_scc0 BB9 ; 0\n"
      "BB4:\n\tv_mov_b32 v1, 0 ; 0\n\ts_cbranch_scc0 BB7 ; 0\n"
      "BB5:\n\tv_mov_b32 v2, 0 ; 0\n\ts_branch BB4 ; 0\n"
      "BB7:\n\ts_branch BB2 ; 0\n"
      "BB9:\n\ts_endpgm ; 0\n";
  EXPECT_EQ(Listing(kNested).loops().size(), 2U);
  EXPECT_EQ(frequencies(kNested, {{5, 3}}), (std::vector<double>{1, 5, 15, 15, 5, 1}));
  EXPECT_EQ(frequencies(kNested, {{0, 3}}), (std::vector<double>{1, 0, 0, 0, 0, 1}));
}

TEST(Listing, RunsBothSidesOfADivergentBranch) {
  EXPECT_EQ(frequencies("BB0:\n\ts_cbranch_execz BB2 ; 0\n"
                        "BB1:\n\tv_mov_b32 v1, 0 ; 0\n"
                        "BB2:\n\ts_cbranch_execz BB4 ; 0\n"
                        "BB3:\n\tv_mov_b32 v1, 1 ; 0\n"
                        "BB4:\n\ts_endpgm ; 0\n"),
            (std::vector<double>{1, 1, 1, 1, 1}));
}

TEST(Listing, RunsADivergentSideInsideALoopInAShareOfTheRounds) {
  EXPECT_EQ(frequencies("BB0:\n\tv_mov_b32 v1, 0 ; 0\n"
                        "BB1:\n\ts_cbranch_scc0 BB4 ; 0\n\ts_cbranch_execz BB3 ; 0\n"
                        "BB2:\n\tv_mov_b32 v1, 1 ; 0\n"
                        "BB3:\n\ts_branch BB1 ; 0\n"
                        "BB4:\n\ts_endpgm ; 0\n",
                        {{8}, 0.25}),
            (std::vector<double>{1, 8, 2, 8, 1}));
}

TEST(Listing, CountsATreeOfUniformBranchesByItsDepth) {
  EXPECT_EQ(frequencies("BB0:\n\ts_cbranch_scc0 BB4 ; 0\n"
                        "BB1:\n\ts_cbranch_scc0 BB3 ; 0\n"
                        "BB2:\n\ts_branch BB5 ; 0\n"
                        "BB3:\n\ts_branch BB5 ; 0\n"
                        "BB4:\n\tv_mov_b32 v1, 1 ; 0\n"
                        "BB5:\n\ts_endpgm ; 0\n"),
            (std::vector<double>{1, 0.5, 0.25, 0.25, 0.5, 1}));
}

TEST(Listing, RunsTheOnlySideOfAUniformBranch) {
  EXPECT_EQ(frequencies("BB0:\n\ts_cbranch_scc0 BB2 ; 0\n"
                        "BB1:\n\tv_mov_b32 v1, 1 ; 0\n"
                        "BB2:\n\ts_endpgm ; 0\n"),
            (std::vector<double>{1, 1, 1}));
}

TEST(Listing, WantsATripCountPerLoop) {
  const Listing loop("BB0:\n\tv_mov_b32 v1, 1 ; 0\n\ts_cbranch_scc1 BB0 ; 0\nBB1:\n\ts_endpgm ; 0\n");
  EXPECT_THROW(blockFrequencies(loop, {}), std::invalid_argument);
  EXPECT_EQ(blockFrequencies(loop, {{4}}), (std::vector<double>{4, 1}));
}

TEST(Listing, NamesAJumpToNowhere) {
  EXPECT_THROW(Listing("BB0:\n\ts_branch BB7 ; 0\n"), std::runtime_error);
}

}  // namespace
}  // namespace walr::costs
