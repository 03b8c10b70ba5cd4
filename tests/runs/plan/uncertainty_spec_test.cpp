#include "runs/plan/uncertainty_spec.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"

namespace dwell {
namespace {

TEST(UncertaintySpec, ReadsEveryNumberInItsUnit) {
  const UncertaintySpec spec = parse_uncertainty_spec(
      "tif-rate=15%, tif-width=5%,position=20um,offset=0.3mm,rotation=10mrad,metrology=200pm,drift=2 %");
  EXPECT_DOUBLE_EQ(spec.tif_rate, 0.15);
  EXPECT_DOUBLE_EQ(spec.tif_width, 0.05);
  EXPECT_DOUBLE_EQ(spec.position, 0.02);
  EXPECT_DOUBLE_EQ(spec.offset, 0.3);
  EXPECT_NEAR(spec.rotation, 0.5729578, 1e-7);
  EXPECT_DOUBLE_EQ(spec.metrology, 0.2);
  EXPECT_DOUBLE_EQ(spec.drift, 0.02);
  EXPECT_EQ(parse_uncertainty_spec(to_string(spec)), spec);
}

TEST(UncertaintySpec, RefusesWhatItCannotRead) {
  for (const char* text : {"tif-rate=0.15", "tif-rate=15", "position=20", "rotation=0.2", "metrology=1um", "size=3mm",
                           "offset=-1mm", "tif-rate=nan%", "tif-rate=1%,tif-rate=2%", "", "offset", "offset=1e9mm"}) {
    EXPECT_THROW(parse_uncertainty_spec(text), InputError) << text;
  }
}

}  // namespace
}  // namespace dwell
