#include "paths/lattice/cell_lattice.h"

#include "tests/paths/lattice/lattice_test_util.h"

namespace dwell {
namespace {

using test::full_map;
using test::kInf;
using test::map_from_picture;

LatticeOptions lattice_options(double pitch, std::optional<double> overrun = {}, double angle = 0.0) {
  return {pitch, overrun, angle};
}

std::string picture(const CellLattice& lattice) {
  std::string text;
  for (Index row = lattice.rows - 1; row >= 0; --row) {
    for (Index col = 0; col < lattice.cols; ++col) text += lattice.keeps(row, col) ? '#' : '.';
    text += '\n';
  }
  return text;
}

TEST(CellLattice, IsCentredOnTheValidPixelsAndAsWideAsFits) {
  const CellLattice lattice = cell_lattice(full_map(3, 10, 1.0, 1.0, {5.0, -2.0}), lattice_options(1.5, 0.75), "x");
  // 9 mm with 0.75 mm on both sides hold 8 points of pitch 1.5, 2 mm hold 3.
  EXPECT_EQ(lattice.cols, 8);
  EXPECT_EQ(lattice.rows, 3);
  EXPECT_EQ(lattice.at(0, 0), (Point{9.5 - 3.5 * 1.5, -1.0 - 1.5}));
  EXPECT_EQ(lattice.at(2, 7), (Point{9.5 + 3.5 * 1.5, -1.0 + 1.5}));
  EXPECT_EQ(lattice.at(17), lattice.at(2, 1));
}

TEST(CellLattice, OnThePixelsKeepsThePixels) {
  const std::vector<std::string> part = {"11...", "1111.", ".1.11"};
  EXPECT_EQ(picture(cell_lattice(map_from_picture(part, 2.0, {7.0, 1.0}), lattice_options(2.0), "x")),
            "##...\n####.\n.#.##\n");
}

TEST(CellLattice, OverrunClosesAHoleAndGoesAround) {
  const HeightMap map = map_from_picture({"111", "1.1", "111"});
  EXPECT_EQ(picture(cell_lattice(map, lattice_options(1.0), "x")), "###\n#.#\n###\n");
  EXPECT_EQ(picture(cell_lattice(map, lattice_options(1.0, 1.0), "x")), ".###.\n#####\n#####\n#####\n.###.\n");
}

TEST(CellLattice, FinerThanThePixelsHasNoGapsBetweenThem) {
  const CellLattice lattice = cell_lattice(full_map(3, 4, 1.0, 1.5), lattice_options(0.1), "x");
  EXPECT_EQ(lattice.rows, 31);
  EXPECT_EQ(lattice.cols, 31);
  EXPECT_EQ(lattice.kept_cells, 31 * 31);
}

TEST(CellLattice, TurnedByARightAngleIsExact) {
  const CellLattice lattice = cell_lattice(full_map(2, 5, 1.0, 1.0, {3.0, 4.0}), lattice_options(1.0, {}, -270.0), "x");
  EXPECT_EQ(lattice.rows, 5);
  EXPECT_EQ(lattice.cols, 2);
  EXPECT_EQ(lattice.at(0, 0), (Point{7.0, 4.0}));
  EXPECT_EQ(lattice.at(4, 1), (Point{3.0, 5.0}));
}

TEST(CellLattice, AgreesWithEveryPointAgainstEveryPixelAndCoversThePart) {
  for (unsigned number = 0; number < 48; ++number) {
    SCOPED_TRACE(number);
    const HeightMap map = test::random_aperture(number);
    const LatticeOptions o = lattice_options(0.3 + 0.17 * (number % 11), 0.4 * (number % 5), 13.0 * (number % 7));
    const CellLattice lattice = cell_lattice(map, o, "x");
    const test::SlowLattice slow(map, o);
    ASSERT_EQ(lattice.rows, slow.rows);
    ASSERT_EQ(lattice.cols, slow.cols);
    Index kept = 0;
    for (Index row = 0; row < lattice.rows; ++row) {
      for (Index col = 0; col < lattice.cols; ++col) {
        ASSERT_EQ(lattice.keeps(row, col), slow.kept.count({row, col}) == 1) << row << " " << col;
        ASSERT_LE(distance(lattice.at(row, col), slow.at({row, col})), 1e-11);
        kept += lattice.keeps(row, col) ? 1 : 0;
      }
    }
    EXPECT_EQ(lattice.kept_cells, kept);
    for (Index i = 0; i < map.grid.size(); ++i) {
      if (!std::isfinite(map.values[static_cast<std::size_t>(i)])) continue;
      double nearest = kInf;
      for (const test::RowCol& c : slow.kept) nearest = std::min(nearest, distance(slow.at(c), map.grid.centre(i)));
      ASSERT_LE(nearest, o.pitch / std::sqrt(2.0) * (1 + 1e-9));
    }
  }
}

TEST(CellLattice, RefusesWhatIsOutOfRange) {
  const HeightMap map = full_map(3, 5);
  const auto message = [&](LatticeOptions o) { return test::message_of([&] { cell_lattice(map, o, "random"); }); };
  EXPECT_EQ(message(lattice_options(-1.0)), "random: pitch = -1 mm; required > 0");
  EXPECT_EQ(message(lattice_options(test::kNaN)), "random: pitch = nan mm; required > 0");
  EXPECT_EQ(message(lattice_options(kInf)), "random: pitch = inf mm; required finite");
  EXPECT_EQ(message(lattice_options(1.0, -0.5)), "random: overrun = -0.5 mm; required >= 0");
  EXPECT_EQ(message(lattice_options(1.0, kInf)), "random: overrun = inf mm; required finite");
  EXPECT_EQ(message(lattice_options(1.0, 0.0, kInf)), "random: angle = inf degrees; required finite");
  EXPECT_EQ(message(lattice_options(1e-4)),
            "random: pitch = 0.0001 mm makes a lattice of 20001 x 40001 points, 8e+08 in all; at most 5e+07 accepted, "
            "make pitch larger");
  EXPECT_EQ(message(lattice_options(1e-300)),
            "random: pitch = 1e-300 mm makes a lattice of 2e+300 x 4e+300 points, inf in all; at most 5e+07 accepted, "
            "make pitch larger");
  HeightMap empty = map;
  std::fill(empty.values.begin(), empty.values.end(), test::kNaN);
  EXPECT_EQ(test::message_of([&] { cell_lattice(empty, lattice_options(1.0), "peano"); }),
            "peano: the map has no finite pixel; at least one is required");
}

}  // namespace
}  // namespace dwell
