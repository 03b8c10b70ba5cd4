#pragma once

#include <span>

#include "core/base/grid.h"
#include "core/base/progress.h"

namespace dwell {

/// What a solve cost and how exact it is.
struct LaplaceSummary {
  Index unknowns = 0;
  int iterations = 0;
  double residual = 0.0;  // |b - A x| / |b|, of the difference from the mean of the values held
};

/// Solves Laplace's equation on the pixels marked in `unknown`, whose values it sets: five-point differences, so that
/// every unknown is the mean of its four neighbours, weighted by 1 / pitch^2 of their direction. Neighbours that are
/// finite and not unknown hold their value (Dirichlet); those that are neither, and the map's edge, let nothing through
/// (Neumann: they are left out of the mean). `values` and `unknown` hold one entry a pixel; every connected set of
/// unknowns must have a neighbour that holds a value. Deterministic.
/// Conjugate gradients to a residual of 1e-11, preconditioned by a multigrid V-cycle: symmetric Gauss-Seidel, bilinear
/// transfer between the unknowns, Galerkin coarse grids (Trottenberg, Oosterlee, Schueller 2001, sections 2 and 7.8),
/// the coarsest solved directly. Cost O(unknowns) an iteration, some tens of iterations. Throws std::runtime_error if
/// 500 iterations do not reach it.
LaplaceSummary solve_laplace(const Grid& grid, std::span<const unsigned char> unknown, std::span<double> values,
                             const Progress& progress = {});

}  // namespace dwell
