#include "bench/faults.h"

#include <gmock/gmock.h>

#include "tests/bench/made_up_run.h"

namespace dwell::bench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Json peer_of(const Json& own, double applications) {
  Json peer = own;
  peer["solver"] = "lbfgsb";
  peer["reached"] = reached(applications, 0.1);
  for (const char* what : {"objective", "residual"}) {
    for (Json& slot : peer["reached"][what]) slot["coarse_pairs"] = 0.0;
  }
  return peer;
}

TEST(Faults, AreNoneWhereAutoIsThereWithTheLeastWork) {
  const Json own = solve("b-512", "auto", 2);  // 10 + 15 pairs
  EXPECT_THAT(faults_of(results({own})), IsEmpty());
  EXPECT_THAT(faults_of(results({own, peer_of(own, 50)})), IsEmpty());
}

TEST(Faults, CountWorkAndNotSeconds) {
  Json own = solve("b-512", "auto", 2);
  EXPECT_THAT(faults_of(results({own, peer_of(own, 48)})), ElementsAre(HasSubstr("lbfgsb came within 1 % in 24.0")));
  own["reached"]["objective"][1]["seconds"] = 1e3;  // slower than the peer, with as much work
  EXPECT_THAT(faults_of(results({own, peer_of(own, 50)})), IsEmpty());
  // On a handful of points the start decides, not the method.
  own["points"] = 324;
  EXPECT_THAT(faults_of(results({own, peer_of(own, 48)})), IsEmpty());
}

TEST(Faults, NameWhatIsMissing) {
  const Json own = solve("b-512", "auto", 2);
  EXPECT_THAT(faults_of(results({never(own, "time limit")})), ElementsAre(HasSubstr("did not come within 1 %")));
  Json all = results({own});
  all["results"] = Json::array();
  EXPECT_THAT(faults_of(all), ElementsAre(HasSubstr("did not come within 1 %")));
  all = results({own});
  all["scenarios"][0]["reference"]["settled"] = false;
  EXPECT_THAT(faults_of(all), ElementsAre(HasSubstr("no settled reference")));
  all["scenarios"][0]["reference"] = nullptr;
  EXPECT_THAT(faults_of(all), ElementsAre(HasSubstr("no settled reference")));
}

}  // namespace
}  // namespace dwell::bench
