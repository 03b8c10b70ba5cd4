#include "bench/field_method.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "bench/child.h"
#include "bench/json_access.h"
#include "bench/scenario_list.h"
#include "bench/scratch_folder.h"
#include "bench/script_problem.h"
#include "bench/solver_list.h"
#include "bench/solver_tables.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "core/formats/npy.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr int kThreads = 2;
constexpr double kLongest = 600.0;  // [s]

/// The lattice of a scenario's dwell points, in whole pixels of the map from its first.
struct DwellLattice {
  Index first_row = 0, first_col = 0, step = 1, rows = 0, cols = 0;
  std::vector<std::size_t> node;  // of each dwell point
};

DwellLattice dwell_lattice(const Grid& grid, const std::vector<Point>& points) {
  std::vector<Index> row, col;
  for (const Point& p : points) {
    row.push_back(std::lround((p.y - grid.origin.y) / grid.pitch_y));
    col.push_back(std::lround((p.x - grid.origin.x) / grid.pitch_x));
  }
  DwellLattice lattice;
  lattice.first_row = *std::min_element(row.begin(), row.end());
  lattice.first_col = *std::min_element(col.begin(), col.end());
  Index step = 0, last_row = 0, last_col = 0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    row[j] -= lattice.first_row;
    col[j] -= lattice.first_col;
    step = std::gcd(step, std::gcd(row[j], col[j]));
    last_row = std::max(last_row, row[j]);
    last_col = std::max(last_col, col[j]);
  }
  lattice.step = std::max<Index>(step, 1);
  lattice.rows = last_row / lattice.step + 1;
  lattice.cols = last_col / lattice.step + 1;
  for (std::size_t j = 0; j < points.size(); ++j)
    lattice.node.push_back(static_cast<std::size_t>(row[j] / lattice.step * lattice.cols + col[j] / lattice.step));
  return lattice;
}

/// The mean height about a pixel, of those within half a step; NaN if none is known.
double mean_about(const HeightMap& map, Index row, Index col, Index half) {
  double sum = 0.0;
  int count = 0;
  for (Index r = std::max<Index>(row - half, 0); r <= std::min(row + half, map.grid.rows - 1); ++r) {
    for (Index c = std::max<Index>(col - half, 0); c <= std::min(col + half, map.grid.cols - 1); ++c) {
      if (!std::isfinite(map.at(r, c))) continue;
      sum += map.at(r, c);
      ++count;
    }
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

void write(const std::filesystem::path& file, const std::vector<double>& values) {
  write_whole_file(file, npy_bytes(std::span(values.data(), values.size())));
}

/// Surface and tool on the lattice of the dwell points.
void write_field_problem(const Parts& parts, const RemovalKernel& kernel, const DwellLattice& lattice,
                         const std::filesystem::path& folder) {
  const HeightMap& whole = parts.whole.values.empty() ? parts.map : parts.whole;
  const Grid& grid = parts.map.grid;
  std::vector<double> heights, counted, allowed(static_cast<std::size_t>(lattice.rows * lattice.cols), 0.0);
  for (Index i = 0; i < lattice.rows; ++i) {
    for (Index j = 0; j < lattice.cols; ++j) {
      const Index row = lattice.first_row + i * lattice.step, col = lattice.first_col + j * lattice.step;
      const bool inside = row >= 0 && row < grid.rows && col >= 0 && col < grid.cols;
      heights.push_back(inside ? mean_about(whole, row, col, lattice.step / 2)
                               : std::numeric_limits<double>::quiet_NaN());
      counted.push_back(inside && std::isfinite(parts.map.at(row, col)) ? 1.0 : 0.0);
    }
  }
  for (const std::size_t node : lattice.node) allowed[node] = 1.0;
  const double hx = grid.pitch_x * static_cast<double>(lattice.step),
               hy = grid.pitch_y * static_cast<double>(lattice.step);
  const Index half_rows = kernel.half_rows / lattice.step + 1, half_cols = kernel.half_cols / lattice.step + 1;
  std::vector<double> rates;
  for (Index i = -half_rows; i <= half_rows; ++i) {
    for (Index j = -half_cols; j <= half_cols; ++j)
      rates.push_back(kernel.rate({static_cast<double>(j) * hx, static_cast<double>(i) * hy}));
  }
  const Json words{{"rows", lattice.rows},
                   {"cols", lattice.cols},
                   {"kernel_rows", 2 * half_rows + 1},
                   {"kernel_cols", 2 * half_cols + 1},
                   {"threads", kThreads}};
  write_whole_file(folder / "field.json", words.dump(1) + "\n");
  write(folder / "heights.npy", heights);
  write(folder / "counted.npy", counted);
  write(folder / "allowed.npy", allowed);
  write(folder / "kernel.npy", rates);
}

Json run_scenario(const Scenario& scenario) {
  const ScratchFolder scratch;
  Instance instance = make_instance(scenario, kThreads);
  DwellLattice lattice;
  {
    const Parts parts = scenario.make();
    lattice = dwell_lattice(parts.map.grid, parts.path.points);
    write_field_problem(parts, instance.problem.parts.front().geometry->kernel, lattice, scratch.path());
  }
  const std::filesystem::path words = scratch.path() / "words.txt",
                              script = find_bench_solver("scipy-lbfgsb").script.parent_path() / "rifta.py";
  const ChildRun child =
      run_program(kPython, {"-B", script.string(), scratch.path().string()}, {kThreads, kLongest, words, false});
  if (child.end == ChildEnd::Killed) return {{"failed", fmt::format("not done after {:.0f} s", kLongest)}};
  if (child.end != ChildEnd::Done) return {{"failed", "rifta.py: " + last_line_of(words)}};
  Json result = Json::parse(read_whole_file(scratch.path() / "end.json"));
  const Eigen::MatrixXd map = read_script_array(scratch.path() / "answer.npy", lattice.rows, lattice.cols);
  Vector dwell(instance.problem.points());
  for (Index j = 0; j < dwell.size(); ++j) {
    const auto node = static_cast<Index>(lattice.node[static_cast<std::size_t>(j)]);
    dwell[j] = map(node / lattice.cols, node % lattice.cols);
  }
  if (!(dwell.minCoeff() >= 0.0)) return {{"failed", "rifta.py: a dwell below zero"}};
  Vector residual;
  DwellObjective(instance.problem).residual(dwell, residual);
  result["residual_rms"] = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
  result["total_dwell"] = dwell.sum();
  result["before_rms"] =
      std::sqrt(instance.problem.target.squaredNorm() / static_cast<double>(instance.problem.pixels()));
  return result;
}

bool wanted(const SuiteOptions& options, const Scenario& s) {
  if (!s.lattice) return false;
  const auto& names = options.scenarios;
  if (names.empty()) return options.extent != Extent::Quick || s.quick;
  return std::find(names.begin(), names.end(), s.name) != names.end();
}

}  // namespace

Json run_field_method(const SuiteOptions& options, const Budget& budget, Measurements& measurements) {
  const std::optional<std::string> missing = why_no_scripts();
  if (missing) fmt::print("\n  THE FIELD'S METHOD IS NOT RUN: {}\n\n", *missing);
  Json all = Json::array();
  for (const Scenario& s : scenarios(options.data)) {
    if (!wanted(options, s)) continue;
    Json result;
    if (missing) {
      result = {{"skipped", *missing}};
    } else if (!budget.endless() && budget.left() < 5.0) {
      result = {{"skipped", "no time left"}};
    } else {
      result = measurements.take("field/" + s.name, [&] { return run_scenario(s); });
    }
    result["scenario"] = s.name;
    const std::string outcome = result.contains("residual_rms")
                                    ? fmt::format("{:.4g} nm, {:.5g} s in {:.2f} s", number(result, "residual_rms"),
                                                  number(result, "total_dwell"), number(result, "seconds"))
                                : result.contains("failed") ? text_of(result, "failed")
                                                            : "skipped: " + text_of(result, "skipped");
    fmt::print("{:7.1f} s  {:18} field's method: {}\n", budget.spent(), s.name, outcome);
    std::fflush(stdout);
    all.push_back(std::move(result));
  }
  return all;
}

std::string field_table(const Json& all) {
  std::string text =
      "| scenario | before nm | field's method: RMS nm | total s | s to compute | `auto`: RMS nm | total s | s to "
      "compute "
      "|\n|---|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Json& r : list_of(all, "field")) {
    const std::string name = text_of(r, "scenario");
    text += fmt::format("| {} |", name);
    if (r.contains("residual_rms")) {
      text += fmt::format(" {:.4g} | {:.4g} | {:.5g} | {:.3g} |", number(r, "before_rms"), number(r, "residual_rms"),
                          number(r, "total_dwell"), number(r, "seconds"));
    } else {
      const char* why = r.contains("failed") ? "failed" : "skipped";
      text += fmt::format(" {}: {} | | | |", why, text_of(r, why));
    }
    const Json run = find_run(all, name, "auto", 2);
    if (!run.is_null() && run.contains("certificate")) {
      text += fmt::format(" {:.4g} | {:.5g} | {:.3g} |\n", number(run.at("certificate"), "residual_rms"),
                          number(run, "total_dwell"), number(run.at("whole"), "seconds"));
    } else {
      text += " not run | | |\n";
    }
  }
  return text;
}

}  // namespace dwell::bench
