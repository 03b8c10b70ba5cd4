#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/grid.h"
#include "core/motion/tool_path.h"
#include "core/removal/removal_geometry.h"
#include "core/removal/removal_operator.h"
#include "solvers/matched/spline_gram.h"

namespace dwell {

/// Which part of a stroke is spread: its dwell point alone, or all of its length.
enum class StrokePart { Via, Whole };

/// Strokes on a lattice much coarser than they are long: every stroke stands on the 4 x 4 nodes about it with its cubic
/// B-spline weights, as the mean over points at most a quarter of the pitch apart (Whole) or at its dwell point (Via).
/// Positions are rounded to 1/2048 of the pitch. What the exact operator does with exact averages (ScatteredRemoval)
/// serves a Hessian that is itself good to a percent at a tenth of the memory. Memory: 8 bytes a point, 4 a stroke.
class SplineSpreading {
 public:
  /// A stroke that does not have a node of the lattice before and two behind it, both ways, is moved to where it has.
  SplineSpreading(const Grid& lattice, const std::vector<Stroke>& strokes, StrokePart part, int threads);

  Index strokes() const { return static_cast<Index>(begin_.size()) - 1; }
  const Grid& lattice() const { return lattice_; }

  /// nodes = sum_j t_j w_j. Cost 16 multiply-adds a point.
  void spread(const Eigen::Ref<const Vector>& t, Vector& nodes);
  /// t_j = w_j'nodes. Cost 16 multiply-adds a point.
  void gather(const Eigen::Ref<const Vector>& nodes, Eigen::Ref<Vector> t) const;
  /// The same into a vector that is given its size.
  void gather(const Eigen::Ref<const Vector>& nodes, Vector& t) const {
    t.resize(strokes());
    gather(nodes, Eigen::Ref<Vector>(t));
  }
  /// Calls visit(node) for the 16 nodes on which the first point of stroke j stands.
  template <class Visit>
  void for_nodes(Index j, const Visit& visit) const {
    const Place& at = places_[static_cast<std::size_t>(begin_[static_cast<std::size_t>(j)])];
    for (Index r = 0; r < 4; ++r) {
      for (Index c = 0; c < 4; ++c) visit(at.first + r * lattice_.cols + c);
    }
  }

 private:
  static constexpr int kPhases = 2048;
  struct Place {
    std::int32_t first;  // node of the smallest row and column
    std::uint16_t x, y;  // phases
  };

  void append(Point p);
  void spread_range(const double* dwell, Index from, Index to, double* nodes) const;
  void gather_range(const double* nodes, Index from, Index to, double* t) const;

  Grid lattice_;
  std::vector<std::int32_t> begin_;  // of each stroke's places
  std::vector<Place> places_;
  std::vector<std::array<float, 4>> weights_;  // by phase
  std::vector<Vector> partial_;                // by thread but the first
  int threads_;
};

/// A lattice that has the map's lines at every factor-th pixel and holds every stroke, as far as the removal function
/// reaches the map from there: what lies farther off, SplineSpreading moves to where nothing is felt.
struct DwellLattice {
  Grid lattice;
  Index first_row = 0, first_col = 0;  // of the lattice's first node, in its pitches from the map's origin
};
DwellLattice dwell_lattice(const RemovalGeometry& geometry, CoarseFactor factor);

}  // namespace dwell
