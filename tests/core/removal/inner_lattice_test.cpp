#include "core/removal/inner_lattice.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/removal/removal_geometry.h"

namespace dwell {
namespace {

TEST(InnerLattice, HoldsTheCentresOfThePixels) {
  const Grid map{4, 5, 0.6, 0.4, {-3.0, 2.0}};
  const std::vector<Index> pixels{0, 3, 7, 19};
  const InnerLattice inner = divide_pixels(map, pixels, {3, 2});
  EXPECT_EQ(inner.grid, (Grid{7, 13, 0.6 / 3.0, 0.2, {-3.0, 2.0}}));
  ASSERT_EQ(inner.pixels.size(), pixels.size());
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    EXPECT_LT(distance(inner.grid.centre(inner.pixels[k]), map.centre(pixels[k])), 1e-12);
  }
  EXPECT_EQ(divide_pixels(map, pixels, {}).grid, map);
  EXPECT_EQ(divide_pixels(map, pixels, {}).pixels, pixels);
  EXPECT_THROW(divide_pixels(Grid{50000, 50000, 1.0, 1.0, {}}, {}, {2, 2}), std::length_error);
}

// On any lattice, the operator gives what its kernel says at the pixels; here for a stroke off the nodes.
TEST(InnerLattice, OperatorTakesTheKernelAtThePixels) {
  const Grid map{20, 24, 0.5, 0.7, {1.0, -4.0}};
  std::vector<Index> pixels;
  for (Index i = 3; i < map.size(); i += 2) pixels.push_back(i);
  const RemovalFunction tif = gaussian_removal(3.0, 2.5, 3.1);
  const std::vector<Stroke> strokes{{{5.13, 2.21}, {5.13, 2.21}, {5.13, 2.21}}, {{9.0, 0.3}, {9.0, 0.3}, {9.0, 0.3}}};
  const Vector t = Vector::Constant(2, 2.0);
  for (const PixelDivision division : {PixelDivision{1, 1}, PixelDivision{2, 3}, PixelDivision{4, 1}}) {
    const RemovalKernel kernel = pixel_kernel(tif, map.pitch_x, map.pitch_y, division);
    const auto removal = make_removal_operator(removal_geometry(map, pixels, kernel, strokes, 2));
    Vector removed, back;
    removal->apply(t, removed);
    ASSERT_EQ(removed.size(), static_cast<Index>(pixels.size()));
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const Point p = map.centre(pixels[k]);
      const double expected = 2.0 * (kernel.rate(p - strokes[0].via) + kernel.rate(p - strokes[1].via));
      EXPECT_NEAR(removed[static_cast<Index>(k)], expected, 1e-10);
    }
    const Vector r = Vector::LinSpaced(removed.size(), -1.0, 2.0);
    removal->apply_adjoint(r, back);
    EXPECT_NEAR(back.dot(t), r.dot(removed), 1e-9 * r.norm() * removed.norm());
  }
}

}  // namespace
}  // namespace dwell
