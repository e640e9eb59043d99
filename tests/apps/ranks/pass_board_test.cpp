// Tests who renders which pass.

#include "apps/ranks/pass_board.h"

#include <gtest/gtest.h>

namespace kaustik::app {
namespace {

using render::PassSet;

TEST(PassBoard, HandsOutEachPassOnceInAscendingOrder) {
  PassBoard board(PassSet(2, 5), false);
  EXPECT_EQ(board.hand_out(1), 2u);
  EXPECT_EQ(board.hand_out(0), 3u);
  EXPECT_EQ(board.hand_out(1), 4u);
  EXPECT_EQ(board.hand_out(0), std::nullopt);
  EXPECT_FALSE(board.complete());
  board.added(PassSet(2, 5));
  EXPECT_TRUE(board.complete());
}

TEST(PassBoard, PassesOfALostRankAreHandedOutFirst) {
  PassBoard board(PassSet(0, 4), false);
  EXPECT_EQ(board.hand_out(1), 0u);
  EXPECT_EQ(board.hand_out(2), 1u);
  board.rendered(1, 0);
  EXPECT_EQ(board.lose(1), PassSet(0, 1));  // rendered, but never sent
  EXPECT_FALSE(board.next_fetch());
  EXPECT_EQ(board.hand_out(2), 0u);
  board.rendered(1, 0);  // the rank lives after all, and comes too late
  EXPECT_FALSE(board.next_fetch());
  EXPECT_EQ(board.hand_out(2), 2u);
}

TEST(PassBoard, SumsAreAskedOfTheRankThatHasHeldThemForTheLongestTime) {
  PassBoard board(PassSet(0, 8), false);
  EXPECT_EQ(board.hand_out(1), 0u);
  EXPECT_EQ(board.hand_out(2), 1u);
  EXPECT_EQ(board.hand_out(3), 2u);
  EXPECT_FALSE(board.next_fetch());
  board.rendered(2, 1);
  board.rendered(1, 0);
  EXPECT_EQ(board.hand_out(2), 3u);
  board.rendered(2, 3);
  ASSERT_TRUE(board.next_fetch());
  EXPECT_EQ(board.next_fetch()->rank, 2);
  EXPECT_EQ(board.next_fetch()->passes, PassSet::parse("1:2,3:4"));
  board.added(board.next_fetch()->passes);
  EXPECT_EQ(board.next_fetch()->rank, 1);
}

TEST(PassBoard, InOrderOnlyTheLowestMissingPassIsAskedFor) {
  PassBoard board(PassSet(0, 3), true);
  for (int rank = 1; rank <= 3; ++rank) board.hand_out(rank);
  board.rendered(2, 1);
  board.rendered(3, 2);
  EXPECT_FALSE(board.next_fetch());  // pass 0 is still rendered
  board.lose(1);
  EXPECT_FALSE(board.next_fetch());  // and now nobody has it
  EXPECT_EQ(board.hand_out(3), 0u);
  board.rendered(3, 0);
  ASSERT_TRUE(board.next_fetch());
  EXPECT_EQ(board.next_fetch()->rank, 3);
  EXPECT_EQ(board.next_fetch()->passes, PassSet(0, 1));
  board.added(PassSet(0, 1));
  EXPECT_EQ(board.next_fetch()->rank, 2);
}

TEST(PassBoard, InOrderAFullRankOnlyGetsThePassThatAllWaitFor) {
  PassBoard board(PassSet(0, 9), true);
  EXPECT_EQ(board.hand_out(1), 0u);
  for (uint64_t pass = 1; pass <= kMostKept; ++pass) {
    EXPECT_EQ(board.hand_out(2), pass);
    board.rendered(2, pass);
  }
  EXPECT_EQ(board.hand_out(2), std::nullopt);  // full
  EXPECT_EQ(board.hand_out(3), kMostKept + 1);
  board.lose(1);
  EXPECT_EQ(board.hand_out(2), 0u);
}

TEST(PassBoard, ClosedItForgetsWhatNobodyHas) {
  PassBoard board(PassSet(0, 9), true);
  EXPECT_EQ(board.hand_out(1), 0u);
  EXPECT_EQ(board.hand_out(2), 1u);
  board.rendered(2, 1);
  board.close();
  EXPECT_EQ(board.hand_out(2), std::nullopt);
  EXPECT_FALSE(board.next_fetch());  // pass 0 is still rendered
  board.lose(1);
  ASSERT_TRUE(board.next_fetch());
  EXPECT_EQ(board.next_fetch()->passes, PassSet(1, 2));
  board.added(PassSet(1, 2));
  EXPECT_TRUE(board.complete());
}

}  // namespace
}  // namespace kaustik::app
