#include "core/form/polynomial_basis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.h"

namespace dwell {
namespace {

using Kind = PolynomialSpec::Kind;

struct ValidPixels {
  Index row0, row1, col0, col1;  // first and last
  Point centroid;                // [mm]
};

ValidPixels valid_pixels_of(const HeightMap& map) {
  const Grid& g = map.grid;
  ValidPixels v{g.rows, -1, g.cols, -1, {}};
  double count = 0.0, sum_row = 0.0, sum_col = 0.0;
  for (Index row = 0; row < g.rows; ++row) {
    for (Index col = 0; col < g.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      v.row0 = std::min(v.row0, row), v.row1 = row;
      v.col0 = std::min(v.col0, col), v.col1 = std::max(v.col1, col);
      count += 1.0, sum_row += static_cast<double>(row), sum_col += static_cast<double>(col);
    }
  }
  if (v.row1 < 0) throw InputError("map has no finite pixel; a form needs at least one");
  v.centroid = {g.origin.x + g.pitch_x * sum_col / count, g.origin.y + g.pitch_y * sum_row / count};
  return v;
}

/// Distance to the farthest valid pixel's centre. Only the first and the last valid pixel of a row can be the farthest.
double farthest(const HeightMap& map, const ValidPixels& v, Point centre) {
  double square = 0.0;
  for (Index row = v.row0; row <= v.row1; ++row) {
    Index first = v.col0, last = v.col1;
    while (first <= last && !std::isfinite(map.at(row, first))) ++first;
    while (last > first && !std::isfinite(map.at(row, last))) --last;
    if (first > last) continue;
    const double dy = map.grid.y(row) - centre.y;
    for (const Index col : {first, last}) {
      const double dx = map.grid.x(col) - centre.x;
      square = std::max(square, dx * dx + dy * dy);
    }
  }
  return std::sqrt(square);
}

PolynomialDomain domain_of(const HeightMap& map, const PolynomialSpec& spec) {
  const ValidPixels v = valid_pixels_of(map);
  const Grid& g = map.grid;
  PolynomialDomain d;
  d.x0 = g.x(v.col0) - 0.5 * g.pitch_x, d.x1 = g.x(v.col1) + 0.5 * g.pitch_x;
  d.y0 = g.y(v.row0) - 0.5 * g.pitch_y, d.y1 = g.y(v.row1) + 0.5 * g.pitch_y;
  d.centre =
      spec.kind == Kind::Terms ? v.centroid : spec.centre.value_or(Point{0.5 * (d.x0 + d.x1), 0.5 * (d.y0 + d.y1)});
  d.radius = spec.radius ? *spec.radius : farthest(map, v, d.centre);
  if (!(d.radius > 0.0)) d.radius = 0.5 * std::max(g.pitch_x, g.pitch_y);  // one pixel
  return d;
}

double legendre(int degree, double x) {
  double before = 0.0, now = 1.0;
  for (int k = 0; k < degree; ++k) before = std::exchange(now, ((2 * k + 1) * x * now - k * before) / (k + 1));
  return std::sqrt(2.0 * degree + 1.0) * now;
}

double chebyshev(int degree, double x) {
  double before = x, now = 1.0;  // T_(-1) = T_1
  for (int k = 0; k < degree; ++k) before = std::exchange(now, 2.0 * x * now - before);
  return now;
}

void add_terms(PolynomialBasis& basis, const FormTerms& terms) {
  const PolynomialDomain d = basis.domain;
  const auto add = [&](bool wanted, const char* name, double (*value)(double, double)) {
    if (!wanted) return;
    basis.polynomials.push_back(
        {name, [d, value](Point p) { return value((p.x - d.centre.x) / d.radius, (p.y - d.centre.y) / d.radius); }});
  };
  add(terms.piston, "piston", [](double, double) { return 1.0; });
  add(terms.tilt, "tilt x", [](double x, double) { return x; });
  add(terms.tilt, "tilt y", [](double, double y) { return y; });
  add(terms.power, "power", [](double x, double y) { return x * x + y * y; });
  add(terms.astigmatism, "astigmatism 0", [](double x, double y) { return x * x - y * y; });
  add(terms.astigmatism, "astigmatism 45", [](double x, double y) { return 2.0 * x * y; });
  basis.normalisation = "unit edge value on the circle";
  basis.degree_total = terms.power || terms.astigmatism ? 2 : terms.tilt ? 1 : 0;
  basis.degree_x = basis.degree_y = basis.degree_total;
}

void add_zernikes(PolynomialBasis& basis, const PolynomialSpec& spec) {
  const bool edge = spec.ordering == ZernikeOrdering::Fringe;
  const PolynomialDomain d = basis.domain;
  for (int number = spec.first; number <= spec.last; ++number) {
    const ZernikeIndex index = zernike_index(spec.ordering, number);
    const Zernike zernike(index, spec.obscuration,
                          edge ? Zernike::Normalisation::UnitEdge : Zernike::Normalisation::UnitRms);
    basis.polynomials.push_back({fmt::format("Z{} {}", number, zernike_name(index)), [d, zernike](Point p) {
                                   return zernike((p.x - d.centre.x) / d.radius, (p.y - d.centre.y) / d.radius);
                                 }});
    basis.degree_total = std::max(basis.degree_total, index.n);
  }
  basis.normalisation = edge ? "unit edge value on the circle"
                             : (spec.obscuration > 0.0 ? "unit RMS over the annulus" : "unit RMS over the circle");
  basis.degree_x = basis.degree_y = basis.degree_total;
}

void add_products(PolynomialBasis& basis, const PolynomialSpec& spec) {
  const bool is_legendre = spec.kind == Kind::Legendre;
  double (*const value)(int, double) = is_legendre ? legendre : chebyshev;
  const PolynomialDomain d = basis.domain;
  basis.degree_x = spec.degree_x, basis.degree_y = spec.degree_y;
  basis.degree_total = spec.total ? spec.degree_x : spec.degree_x + spec.degree_y;
  for (int sum = 0; sum <= basis.degree_total; ++sum) {
    for (int j = std::max(0, sum - spec.degree_x); j <= std::min(sum, spec.degree_y); ++j) {
      const int i = sum - j;
      basis.polynomials.push_back(
          {fmt::format("{}{}(x) {}{}(y)", is_legendre ? 'L' : 'T', i, is_legendre ? 'L' : 'T', j), [=](Point p) {
             return value(i, (2.0 * p.x - d.x0 - d.x1) / (d.x1 - d.x0)) *
                    value(j, (2.0 * p.y - d.y0 - d.y1) / (d.y1 - d.y0));
           }});
    }
  }
  basis.normalisation = is_legendre ? "unit RMS over the rectangle" : "unit edge value on the rectangle";
}

}  // namespace

PolynomialBasis polynomial_basis(const HeightMap& map, const PolynomialSpec& spec) {
  PolynomialBasis basis;
  basis.domain = domain_of(map, spec);
  if (spec.kind == Kind::Terms) {
    add_terms(basis, spec.terms);
  } else if (spec.kind == Kind::Zernike) {
    add_zernikes(basis, spec);
  } else {
    add_products(basis, spec);
  }
  return basis;
}

}  // namespace dwell
