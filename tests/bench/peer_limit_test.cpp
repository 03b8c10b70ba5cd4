#include "bench/peer_limit.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/bench/made_up_run.h"

namespace dwell::bench {
namespace {

using ::testing::HasSubstr;

TEST(PeerLimit, IsTwelveTimesAutoButNotUnderAFloor) {
  EXPECT_DOUBLE_EQ(peer_limit(2.0), 24.0);
  EXPECT_DOUBLE_EQ(peer_limit(0.05), 0.6);
  EXPECT_DOUBLE_EQ(peer_limit(0.001), kLeastPeerSeconds);
}

TEST(PeerLimit, SaysOfWhomTheClockStoppedHowLongItHad) {
  Json run = never(solve("b-512", "lbfgsb", 2), "time limit");
  EXPECT_FALSE(not_there(run));  // it had no limit of that kind
  run["times_given"] = 12.0;
  EXPECT_EQ(not_there(run), "not there at 12 x");
  run["times_given"] = 569.1;
  EXPECT_EQ(not_there(run), "not there at 569 x");
}

TEST(PeerLimit, DoesNotSayItOfWhoArrivedOrEndedByItself) {
  Json run = solve("b-512", "lbfgsb", 2);
  run["times_given"] = 12.0;
  EXPECT_FALSE(not_there(run));
  Json stalled = never(run, "stalled");
  EXPECT_FALSE(not_there(stalled));
  EXPECT_FALSE(not_there({{"times_given", 12.0}, {"failed", "no Python"}}));
  EXPECT_EQ(not_there({{"times_given", 12.0}, {"late", "ended"}}), "not there at 12 x");
}

TEST(PeerLimit, SaysOfWhomItIsTooLargeForHowLargeItIs) {
  EXPECT_EQ(why_not_taken(77284, 1048576, 5000), "too large: its matrix of 1048576 x 77284 numbers takes 604 GiB");
  EXPECT_THAT(why_not_taken(32768, 0, 20000), HasSubstr("32768 x 32768 numbers takes 8 GiB"));
  // What would fit is not called too large.
  EXPECT_THAT(why_not_taken(2678, 0, 500), HasSubstr("not meant for it: takes at most 500 dwell points"));
}

}  // namespace
}  // namespace dwell::bench
