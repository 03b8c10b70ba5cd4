#include "bench/script_problem.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <span>
#include <vector>

#include "core/base/errors.h"
#include "core/base/random_numbers.h"
#include "core/base/whole_file.h"
#include "core/formats/npy.h"
#include "core/motion/stroke_quadrature.h"

namespace dwell::bench {
namespace {

void write_array(const std::filesystem::path& file, std::span<const double> values) {
  write_whole_file(file, npy_bytes(values));
}

void write_array(const std::filesystem::path& file, const Vector& values) {
  write_array(file, std::span(values.data(), static_cast<std::size_t>(values.size())));
}

/// Where the strokes are spread: points in pitches of the lattice, their weights, and the stroke of each.
void write_strokes(const RemovalGeometry& geometry, const std::filesystem::path& folder) {
  const Grid& grid = geometry.lattice;
  std::vector<double> stroke, u, v, weight;
  std::vector<QuadraturePoint> points;
  for (std::size_t j = 0; j < geometry.strokes.size(); ++j) {
    points.clear();
    append_stroke_quadrature(geometry.strokes[j], grid, points);
    for (const QuadraturePoint& q : points) {
      stroke.push_back(static_cast<double>(j));
      u.push_back((q.position.x - grid.origin.x) / grid.pitch_x);
      v.push_back((q.position.y - grid.origin.y) / grid.pitch_y);
      weight.push_back(q.weight);
    }
  }
  write_array(folder / "point_stroke.npy", stroke);
  write_array(folder / "point_u.npy", u);
  write_array(folder / "point_v.npy", v);
  write_array(folder / "point_weight.npy", weight);
}

void write_smoothness(const PathSmoothness& smoothness, const std::filesystem::path& folder) {
  Vector scale(smoothness.size()), linked(smoothness.size());
  for (Index j = 0; j < smoothness.size(); ++j) {
    scale[j] = smoothness.scale(j);
    linked[j] = smoothness.linked(j) ? 1.0 : 0.0;
  }
  write_array(folder / "smooth_scale.npy", scale);
  write_array(folder / "smooth_linked.npy", linked);
}

}  // namespace

void write_script_problem(Instance& instance, const ScriptLimits& limits, const std::filesystem::path& folder) {
  const DwellProblem& p = instance.problem;
  const RemovalGeometry& geometry = *p.parts.front().geometry;
  const Grid& kernel = geometry.kernel.surface.grid();
  const nlohmann::json words{{"rows", geometry.lattice.rows},
                             {"cols", geometry.lattice.cols},
                             {"kernel_rows", kernel.rows},
                             {"kernel_cols", kernel.cols},
                             {"form_terms", p.form.cols()},
                             {"points", p.points()},
                             {"pixels", p.pixels()},
                             {"alpha", p.alpha},
                             {"gamma", p.gamma},
                             {"threads", limits.threads},
                             {"max_seconds", limits.max_seconds},
                             {"target_objective", limits.target_objective},
                             {"scale_of_total", limits.scale_of_total},
                             {"scale_of_objective", limits.scale_of_objective}};
  write_whole_file(folder / "problem.json", words.dump(1) + "\n");
  write_array(folder / "kernel.npy", geometry.kernel.surface.coefficients());
  write_array(folder / "pixel.npy", std::vector<double>(geometry.pixels.begin(), geometry.pixels.end()));
  write_array(folder / "target.npy", p.target);
  const Eigen::MatrixXd form = p.form;
  write_array(folder / "form.npy", std::span(form.data(), static_cast<std::size_t>(form.size())));
  write_array(folder / "lower.npy", p.lower);
  write_strokes(geometry, folder);
  write_smoothness(p.parts.front().smoothness, folder);
  RandomNumbers random(11);
  Vector dwell(p.points()), removal;
  for (double& t : dwell) t = random.uniform();
  p.removal->apply(dwell, removal);
  write_array(folder / "check_dwell.npy", dwell);
  write_array(folder / "check_removal.npy", removal);
}

Eigen::MatrixXd read_script_array(const std::filesystem::path& file, Index rows, Index cols) {
  const MapSource source = parse_npy(read_whole_file(file), file.string());
  const Index r = source.rows, c = source.cols;
  if ((rows >= 0 && r != rows) || (cols >= 0 && c != cols)) {
    const auto size = [](Index n) { return n < 0 ? std::string("any") : std::to_string(n); };
    throw InputError(
        fmt::format("{}: {} x {} numbers; accepted: {} x {}", file.string(), r, c, size(rows), size(cols)));
  }
  Eigen::MatrixXd values(r, c);
  for (Index i = 0; i < r; ++i) {
    for (Index j = 0; j < c; ++j) {
      const double value = source.values[static_cast<std::size_t>(i * c + j)];
      if (!std::isfinite(value))
        throw InputError(fmt::format("{}: the number in row {}, column {} is not finite", file.string(), i + 1, j + 1));
      values(i, j) = value;
    }
  }
  return values;
}

}  // namespace dwell::bench
