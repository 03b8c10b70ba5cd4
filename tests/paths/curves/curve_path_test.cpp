#include <numeric>

#include "paths/lattice/hilbert.h"
#include "paths/lattice/peano.h"
#include "tests/paths/lattice/lattice_test_util.h"

namespace dwell {
namespace {

using test::full_map;
using test::map_from_picture;
using test::RowCol;

/// Hilbert's curve by the bits of the distance along it (Warren, Hacker's Delight, 16-1; as in every textbook).
RowCol hilbert_point(long side, long d) {
  long x = 0, y = 0;
  for (long s = 1; s < side; s *= 2, d /= 4) {
    const long rx = (d / 2) & 1, ry = (d ^ rx) & 1;
    if (ry == 0) {
      if (rx == 1) {
        x = s - 1 - x;
        y = s - 1 - y;
      }
      std::swap(x, y);
    }
    x += s * rx;
    y += s * ry;
  }
  return {y, x};
}

/// Peano's curve by the ternary digits t1 t2 ... of the distance along it (Peano 1890): digit j of the column is
/// t(2j-1), mirrored if t2 + t4 + ... + t(2j-2) is odd; digit j of the row t(2j), mirrored if t1 + t3 + ... + t(2j-1)
/// is.
RowCol peano_point(long side, long d) {
  long row = 0, col = 0, sum_of_rows = 0, sum_of_cols = 0;
  for (long unit = side * side; unit > 1; unit /= 9) {
    const long first = d / (unit / 3) % 3, second = d / (unit / 9) % 3;
    col = 3 * col + (sum_of_rows % 2 == 0 ? first : 2 - first);
    sum_of_cols += first;
    row = 3 * row + (sum_of_cols % 2 == 0 ? second : 2 - second);
    sum_of_rows += second;
  }
  return {row, col};
}

struct Curve {
  const char* name;
  long base;
  RowCol (*point)(long side, long d);
  ToolPath (*path)(const HeightMap& map, const LatticeOptions& lattice, GapMove gaps);
};

const Curve kHilbert{"hilbert", 2, hilbert_point,
                     [](const HeightMap& map, const LatticeOptions& lattice, GapMove gaps) {
                       return hilbert_path(map, {lattice, gaps});
                     }};
const Curve kPeano{"peano", 3, peano_point, [](const HeightMap& map, const LatticeOptions& lattice, GapMove gaps) {
                     return peano_path(map, {lattice, gaps});
                   }};

class CurvePath : public ::testing::TestWithParam<Curve> {};

TEST_P(CurvePath, IsTheTextbooksWithoutThePointsOutside) {
  for (unsigned number = 0; number < 48; ++number) {
    SCOPED_TRACE(number);
    const HeightMap map = test::random_aperture(number);
    const LatticeOptions o{0.4 + 0.13 * (number % 9), 0.5 * (number % 4), 17.0 * (number % 5)};
    const test::SlowLattice lattice(map, o);
    const std::vector<RowCol> order = test::visited_once(GetParam().path(map, o, GapMove::Link), lattice);
    long side = 1;
    while (side < std::max(lattice.rows, lattice.cols)) side *= GetParam().base;
    std::vector<RowCol> expected;
    for (long d = 0; d < side * side; ++d) {
      const RowCol c = GetParam().point(side, d);
      if (lattice.kept.count(c) == 1) expected.push_back(c);
    }
    ASSERT_EQ(order, expected);
  }
}

TEST_P(CurvePath, FillsAWholeSquareInStepsOfOnePitch) {
  const long side = GetParam().base == 2 ? 64 : 81;
  const ToolPath path = GetParam().path(full_map(side, side, 0.5, 0.5, {3.0, -40.0}), {0.5, {}, 0.0}, GapMove::Link);
  ASSERT_EQ(path.size(), static_cast<std::size_t>(side * side));
  EXPECT_EQ(path.kind, GetParam().name);
  EXPECT_EQ(path.points.front(), (Point{3.0, -40.0}));
  const double far = 0.5 * static_cast<double>(side - 1);
  EXPECT_EQ(path.points.back(), (Point{3.0 + far, GetParam().base == 2 ? -40.0 : -40.0 + far}));
  for (std::size_t j = 1; j < path.size(); ++j) ASSERT_EQ(distance(path.points[j - 1], path.points[j]), 0.5) << j;
  EXPECT_EQ(std::accumulate(path.lifted.begin(), path.lifted.end(), 0), 1);
  EXPECT_TRUE(path.notes.empty());
}

/// Gaps are linked where a short straight move stays within reach of the pixels, else lifted.
TEST_P(CurvePath, LinksOnlyOverThePart) {
  Index linked = 0, lifted = 0;
  for (unsigned number = 0; number < 48; ++number) {
    SCOPED_TRACE(number);
    const HeightMap map = test::random_aperture(number);
    const LatticeOptions o{0.4 + 0.13 * (number % 9), 0.5 * (number % 4), 17.0 * (number % 5)};
    const test::SlowLattice lattice(map, o);
    const ToolPath path = GetParam().path(map, o, GapMove::Link);
    const ToolPath lifting = GetParam().path(map, o, GapMove::Lift);
    ASSERT_EQ(path.points, lifting.points);
    ASSERT_TRUE(path.lifted[0] == 1 && lifting.lifted[0] == 1);
    Index linked_here = 0, lifted_here = 0;
    for (std::size_t j = 1; j < path.size(); ++j) {
      const Point a = path.points[j - 1], b = path.points[j];
      const bool gap = !test::neighbours(lattice.cell(a), lattice.cell(b));
      ASSERT_EQ(lifting.lifted[j] != 0, gap);
      if (!gap) {
        ASSERT_EQ(path.lifted[j], 0);
        continue;
      }
      ++(path.lifted[j] != 0 ? lifted_here : linked_here);
      if (path.lifted[j] == 0) {
        ASSERT_LE(distance(a, b), 8.0 * o.pitch * (1 + 1e-12));
      }
      double farthest = 0.0;
      for (int k = 0; k <= 256; ++k) {
        farthest = std::max(farthest, test::brute_force_distance(map, a + (k / 256.0) * (b - a)));
      }
      // Looked at every eighth of a pitch, the distance is off by a sixteenth at most.
      if (path.lifted[j] == 0) {
        ASSERT_LE(farthest, lattice.reach + o.pitch / 16 + 1e-9);
      }
      if (path.lifted[j] != 0 && distance(a, b) <= 8.0 * o.pitch) {
        ASSERT_GT(farthest, lattice.reach - 0.02 * o.pitch);
      }
    }
    linked += linked_here;
    lifted += lifted_here;
    if (linked_here + lifted_here > 0) {
      const std::string note = "points outside the part break the curve in " +
                               std::to_string(linked_here + lifted_here) + " places; " + std::to_string(linked_here) +
                               " are linked by a straight move over the part, at " + std::to_string(lifted_here) +
                               " the tool is lifted";
      ASSERT_EQ(path.notes, std::vector<std::string>{note});
    } else {
      ASSERT_TRUE(path.notes.empty());
    }
  }
  EXPECT_GT(linked, 100);
  EXPECT_GT(lifted, 100);
}

TEST_P(CurvePath, SinglePixel) {
  const ToolPath path = GetParam().path(map_from_picture({"..", ".1"}), {1.0, {}, 0.0}, GapMove::Link);
  EXPECT_EQ(path.points, (std::vector<Point>{{1.0, 0.0}}));
  EXPECT_EQ(path.lifted, (std::vector<char>{1}));
}

TEST_P(CurvePath, NamesItselfInMessages) {
  const std::string message = test::message_of([&] { GetParam().path(full_map(2, 3), {0.0, {}, 0.0}, GapMove::Link); });
  EXPECT_EQ(message, std::string(GetParam().name) + ": pitch = 0 mm; required > 0");
}

INSTANTIATE_TEST_SUITE_P(Both, CurvePath, ::testing::Values(kHilbert, kPeano),
                         [](const auto& curve) { return curve.param.name; });

TEST(CurveOptions, AreParsed) {
  const HilbertOptions hilbert =
      parse_hilbert_options(parse_spec_text("hilbert:pitch=2,overrun=3,angle=-10,gaps=lift", "path"));
  EXPECT_EQ(hilbert.lattice.pitch, 2.0);
  EXPECT_EQ(hilbert.lattice.overrun, 3.0);
  EXPECT_EQ(hilbert.lattice.angle_deg, -10.0);
  EXPECT_EQ(hilbert.gaps, GapMove::Lift);
  const PeanoOptions peano = parse_peano_options(parse_spec_text("peano:pitch=0.5", "path"));
  EXPECT_EQ(peano.lattice.pitch, 0.5);
  EXPECT_FALSE(peano.lattice.overrun.has_value());
  EXPECT_EQ(peano.lattice.angle_deg, 0.0);
  EXPECT_EQ(peano.gaps, GapMove::Link);
  EXPECT_EQ(test::message_of([] { parse_peano_options(parse_spec_text("peano:pitch=1,seed=2", "path")); }),
            "path \"peano:pitch=1,seed=2\": unknown key \"seed\"; accepted for peano: pitch, overrun, angle, gaps");
  EXPECT_EQ(test::message_of([] { parse_hilbert_options(parse_spec_text("hilbert:pitch=1,gaps=jump", "path")); }),
            "path \"hilbert:pitch=1,gaps=jump\": gaps = \"jump\"; accepted: link, lift");
}

}  // namespace
}  // namespace dwell
