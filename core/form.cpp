#include "core/form.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/errors.h"
#include "core/number_text.h"

namespace dwell {
namespace {

/// Coordinates of the pixels, centred on their weighted centroid and scaled to at most 1, so that the columns of
/// the basis are of one size and rounding in a far origin does not reach them.
struct LocalCoordinates {
  Eigen::VectorXd x, y;
};

LocalCoordinates local_coordinates(const Grid& grid, const std::vector<Index>& pixels, const Eigen::VectorXd& weights) {
  const auto m = static_cast<Index>(pixels.size());
  LocalCoordinates local{Eigen::VectorXd(m), Eigen::VectorXd(m)};
  const Index reference = pixels.front();
  for (Index i = 0; i < m; ++i) {
    const Index pixel = pixels[static_cast<std::size_t>(i)];
    local.x[i] = grid.pitch_x * static_cast<double>(pixel % grid.cols - reference % grid.cols);
    local.y[i] = grid.pitch_y * static_cast<double>(pixel / grid.cols - reference / grid.cols);
  }
  const Eigen::VectorXd squared = weights.array().square();
  const double total = squared.sum();
  local.x.array() -= squared.dot(local.x) / total;
  local.y.array() -= squared.dot(local.y) / total;
  const double extent = std::max(local.x.cwiseAbs().maxCoeff(), local.y.cwiseAbs().maxCoeff());
  if (extent > 0.0) {
    local.x /= extent;
    local.y /= extent;
  }
  return local;
}

Eigen::VectorXd weight_vector(const std::vector<Index>& pixels, const std::vector<double>& weights) {
  if (weights.empty()) return Eigen::VectorXd::Ones(static_cast<Index>(pixels.size()));
  if (weights.size() != pixels.size()) {
    throw std::invalid_argument(
        fmt::format("form_basis: {} weights for {} pixels; one a pixel, or none", weights.size(), pixels.size()));
  }
  return Eigen::VectorXd::Map(weights.data(), static_cast<Index>(weights.size()));
}

}  // namespace

FormTerms parse_form_terms(const std::string& text) {
  FormTerms terms;
  if (trim(text) == "none") return terms;
  for (const std::string_view field : split(text, ',')) {
    const std::string_view word = trim(field);
    if (word == "piston") {
      terms.piston = true;
    } else if (word == "tilt") {
      terms.tilt = true;
    } else if (word == "power") {
      terms.power = true;
    } else {
      throw InputError(
          fmt::format("form term '{}' in '{}' is unknown; accepted: piston, tilt, power separated by "
                      "commas, or none alone",
                      word, text));
    }
  }
  return terms;
}

std::string to_string(const FormTerms& terms) {
  std::string text;
  const auto add = [&](bool present, const char* word) {
    if (present) text += (text.empty() ? "" : ",") + std::string(word);
  };
  add(terms.piston, "piston");
  add(terms.tilt, "tilt");
  add(terms.power, "power");
  return text.empty() ? "none" : text;
}

Eigen::MatrixXd form_basis(const Grid& grid, const std::vector<Index>& pixels, const FormTerms& terms,
                           const std::vector<double>& weights) {
  const Eigen::VectorXd w = weight_vector(pixels, weights);
  const auto m = static_cast<Index>(pixels.size());
  const double size = w.norm();
  if (!std::isfinite(size)) throw std::invalid_argument("form_basis: weights must be finite");
  if (!terms.any() || !(size > 0.0)) return Eigen::MatrixXd(m, 0);

  const LocalCoordinates local = local_coordinates(grid, pixels, w);
  Eigen::MatrixXd basis(m, 4);
  Index rank = 0;
  const auto add = [&](const Eigen::VectorXd& column) {
    Eigen::VectorXd v = w.cwiseProduct(column);
    remove_form(basis.leftCols(rank), v);
    // The columns are of size ||w|| at most; what the others leave of a dependent one is rounding.
    const double norm = v.norm();
    if (norm > 1e-9 * size) basis.col(rank++) = v / norm;
  };
  if (terms.piston) add(Eigen::VectorXd::Ones(m));
  if (terms.tilt) add(local.x);
  if (terms.tilt) add(local.y);
  if (terms.power) add(local.x.array().square() + local.y.array().square());
  basis.conservativeResize(Eigen::NoChange, rank);
  return basis;
}

void remove_form(const Eigen::MatrixXd& basis, Eigen::Ref<Eigen::VectorXd> v) {
  // Twice is enough (Giraud et al. 2005): the second pass takes out what rounding in the first left behind.
  for (int pass = 0; pass < 2; ++pass) v -= basis * (basis.transpose() * v);
}

}  // namespace dwell
