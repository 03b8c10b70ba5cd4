#include "bench/micro.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "bench/map_file.h"
#include "bench/schedule_case.h"
#include "bench/single_fft.h"
#include "core/base/random_numbers.h"
#include "core/form/polynomial_fit.h"
#include "core/numerics/fft.h"
#include "core/removal/lattice_removal.h"
#include "core/removal/scattered_removal.h"
#include "core/removal/sparse_removal.h"
#include "core/spectra/psd.h"
#include "paths/feed/constant_schedule.h"
#include "paths/feed/linear_schedule.h"
#include "paths/tours/nearest_neighbour.h"

namespace dwell::bench {
namespace {

constexpr double kMicroPitch = 1.0;
constexpr Index kLatticeStep = 4;      // a dwell point at every 4th pixel, both ways
constexpr Index kLargestSparse = 256;  // the matrix of 512 pixels would fill the memory

Grid square_grid(long size) { return Grid{size, size, kMicroPitch, kMicroPitch, {0.0, 0.0}}; }

/// The Gaussian of the scenarios: sigma = size / 50 pixels, cut at 3.5 sigma.
RemovalKernel gaussian_kernel(long size) {
  const double sigma = static_cast<double>(size) / 50.0 * kMicroPitch;
  return removal_kernel(gaussian_removal(1.0, 2.3548200450309493 * sigma, 3.5 * sigma), kMicroPitch, kMicroPitch);
}

std::vector<Index> all_pixels(const Grid& grid) {
  std::vector<Index> pixels(static_cast<std::size_t>(grid.size()));
  for (Index i = 0; i < grid.size(); ++i) pixels[static_cast<std::size_t>(i)] = i;
  return pixels;
}

/// Dwell points at every 4th pixel, moved by `jitter` pixels at most.
std::vector<Stroke> lattice_strokes(const Grid& grid, double jitter) {
  RandomNumbers random(1);
  ToolPath path;
  for (Index r = 0; r < grid.rows; r += kLatticeStep) {
    for (Index c = 0; c < grid.cols; c += kLatticeStep) {
      const Point shift{jitter * (2.0 * random.uniform() - 1.0), jitter * (2.0 * random.uniform() - 1.0)};
      path.points.push_back(grid.centre(r, c) + shift);
      path.lifted.push_back(0);
    }
  }
  return halting_strokes(path);
}

std::unique_ptr<RemovalOperator> make_operator(const std::string& kind, long size, int threads) {
  const Grid grid = square_grid(size);
  const RemovalKernel kernel = gaussian_kernel(size);
  const auto pixels = all_pixels(grid);
  if (kind == "lattice")
    return std::make_unique<LatticeRemoval>(grid, pixels, kernel, lattice_strokes(grid, 0.0), threads);
  const auto strokes = lattice_strokes(grid, 0.5);
  if (kind == "scattered") return std::make_unique<ScatteredRemoval>(grid, pixels, kernel, strokes, threads);
  return std::make_unique<SparseRemoval>(grid, pixels, kernel, strokes, threads);
}

/// What the operators pad the map to: the kernel's half size on either side, and for the lattice operator two more.
Index padded_size(const std::string& kind, long size) {
  const RemovalKernel kernel = gaussian_kernel(size);
  return good_fft_size(size + 2 * (kernel.half_rows + (kind == "lattice" ? 2 : 0)));
}

void time_operator(benchmark::State& state, const std::string& kind, bool adjoint, long size, int threads) {
  const auto removal = make_operator(kind, size, threads);
  Vector t = Vector::Ones(removal->cols()), r = Vector::Ones(removal->rows());
  for (auto _ : state) {
    if (adjoint) {
      removal->apply_adjoint(r, t);
    } else {
      removal->apply(t, r);
    }
    benchmark::ClobberMemory();
  }
}

/// The forward and the inverse transform alone, by the plans of core/numerics/fft.h: the floor under every convolution.
void time_fft_pair(benchmark::State& state, Index padded, int threads) {
  RealFft2D fft(padded, padded, threads);
  // All zero: unnormalised pairs would otherwise overflow, and a transform takes the same time whatever its input.
  std::fill(fft.real().begin(), fft.real().end(), 0.0);
  for (auto _ : state) {
    fft.forward();
    fft.inverse();
    benchmark::ClobberMemory();
  }
}

void time_single_fft_pair(benchmark::State& state, Index padded, int threads) {
  SingleFftPair fft(padded, threads);
  for (auto _ : state) {
    fft.execute();
    benchmark::ClobberMemory();
  }
}

void time_nearest_path(benchmark::State& state, long edge) {
  HeightMap map(square_grid(edge));
  RandomNumbers random(3);
  for (double& v : map.values) v = 1.0 + random.uniform();
  NearestOptions options;
  options.cell = kMicroPitch;
  for (auto _ : state) benchmark::DoNotOptimize(nearest_path(map, options).path.points.data());
}

void time_reading(benchmark::State& state, const std::string& format, long size, bool only_bytes) {
  const MapFile file(format, size);
  for (auto _ : state) {
    if (only_bytes) {
      file.read_bytes();
    } else {
      file.read_map();
    }
  }
}

/// Hills and noise on a square map without holes, or on the disc in it.
HeightMap measured_map(long size, bool disc) {
  HeightMap map(square_grid(size));
  RandomNumbers random(5);
  for (Index i = 0; i < map.grid.size(); ++i) {
    const double u = 2.0 * static_cast<double>(i % size) / static_cast<double>(size) - 1.0;
    const double v = 2.0 * static_cast<double>(i / size) / static_cast<double>(size) - 1.0;
    const double z = 100.0 * (u * u + 0.5 * u * v) + 5.0 * u * u * v + random.uniform();
    if (!disc || u * u + v * v <= 1.0) map.values[static_cast<std::size_t>(i)] = z;
  }
  return map;
}

/// The removal of 36 terms. After the first call the map no longer changes, apart from rounding; later calls take the
/// same time.
void time_form(benchmark::State& state, long size, bool disc, int threads) {
  HeightMap map = measured_map(size, disc);
  const PolynomialSpec spec = parse_polynomial_spec("zernike-noll:1-36");
  for (auto _ : state) benchmark::DoNotOptimize(remove_polynomials(map, spec, threads).condition);
}

void time_radial_psd(benchmark::State& state, long size, bool disc, int threads) {
  const HeightMap map = measured_map(size, disc);
  PsdOptions options;
  options.threads = threads;
  for (auto _ : state) benchmark::DoNotOptimize(radial_psd(areal_psd(map, options)).density.data());
}

void time_schedule(benchmark::State& state, long strokes, bool rough, bool linear, int threads) {
  const ScheduleCase c = make_schedule_case(strokes, rough);
  for (auto _ : state) {
    if (linear) {
      benchmark::DoNotOptimize(schedule_linear(c.moves, c.path, c.machine, c.dwell, threads).worst_error);
    } else {
      benchmark::DoNotOptimize(schedule_constant(c.moves, c.path, c.machine, c.dwell).worst_error);
    }
  }
}

struct Case {
  std::string name;
  long size;
  int threads;
  std::string pair;  // name of the bare transform pair to compare with; empty = none
  std::function<void(benchmark::State&)> time;
};

/// Readers of map files, and beside NPY the plain read of its bytes.
void append_reading(std::vector<Case>& cases, const std::string& format, long size) {
  cases.push_back(
      {"read-" + format, size, 1, "", [=](benchmark::State& state) { time_reading(state, format, size, false); }});
  if (format != "npy") return;
  cases.push_back(
      {"read-bytes", size, 1, "", [=](benchmark::State& state) { time_reading(state, "npy", size, true); }});
}

void append_size(std::vector<Case>& cases, long size, int threads) {
  std::vector<std::string> kinds{"lattice", "scattered"};
  if (size <= kLargestSparse) kinds.emplace_back("sparse");
  for (const std::string& kind : kinds) {
    const std::string pair = (kind == "sparse" ? "scattered" : kind) + "-fft-pair";
    if (kind != "sparse") {
      cases.push_back({pair, size, threads, "",
                       [=](benchmark::State& state) { time_fft_pair(state, padded_size(kind, size), threads); }});
    }
    if (kind == "lattice") {
      cases.push_back({pair + "-single", size, threads, pair, [=](benchmark::State& state) {
                         time_single_fft_pair(state, padded_size(kind, size), threads);
                       }});
    }
    for (const bool adjoint : {false, true}) {
      cases.push_back({kind + (adjoint ? "-adjoint" : "-apply"), size, threads, pair,
                       [=](benchmark::State& state) { time_operator(state, kind, adjoint, size, threads); }});
    }
  }
}

std::vector<Case> cases_of(const MicroOptions& options) {
  const std::vector<long> sizes =
      options.quick ? std::vector<long>{256, 512} : std::vector<long>{256, 512, 1024, 2048, 4096};
  std::vector<Case> cases;
  for (const long size : sizes) {
    for (const int threads : {1, 2}) append_size(cases, size, threads);
  }
  const long map = options.quick ? 512 : 2048;
  for (const int threads : {1, 2}) {
    for (const bool disc : {false, true}) {
      const std::string part = disc ? "-disc" : "";
      cases.push_back({"form-36-terms" + part, map, threads, "",
                       [=](benchmark::State& state) { time_form(state, map, disc, threads); }});
      cases.push_back({"radial-psd" + part, map, threads, "",
                       [=](benchmark::State& state) { time_radial_psd(state, map, disc, threads); }});
    }
  }
  const long edge = options.quick ? 300 : 1000;
  cases.push_back(
      {"nearest-path", edge * edge, 1, "", [=](benchmark::State& state) { time_nearest_path(state, edge); }});
  const long strokes = options.quick ? 20'000 : 1'000'000;
  for (const bool rough : {false, true}) {
    const std::string dwell = rough ? "-rough" : "";
    cases.push_back({"schedule-constant" + dwell, strokes, 1, "",
                     [=](benchmark::State& state) { time_schedule(state, strokes, rough, false, 1); }});
    for (const int threads : {1, 2}) {
      cases.push_back({"schedule-linear" + dwell, strokes, threads, "",
                       [=](benchmark::State& state) { time_schedule(state, strokes, rough, true, threads); }});
    }
  }
  for (const char* format : {"dat", "datx"}) append_reading(cases, format, 1024);
  append_reading(cases, "npy", options.quick ? 1024 : 4096);
  return cases;
}

constexpr const char* kLate = "late";  // counter of a repetition that had no time left and measured nothing

/// Keeps the single repetitions.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && run.iterations > 0 && !run.counters.contains(kLate))
        seconds_[run.run_name.function_name].push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
    }
  }
  const std::map<std::string, std::vector<double>>& seconds() const { return seconds_; }

 private:
  std::map<std::string, std::vector<double>> seconds_;
};

std::string label(const std::string& name, long size, int threads) {
  return fmt::format("{}/{}/threads:{}", name, size, threads);
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v.empty() ? 0.0 : 0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]);
}

std::vector<MicroResult> results_of(const std::vector<Case>& cases,
                                    const std::map<std::string, std::vector<double>>& seconds) {
  std::vector<MicroResult> results;
  for (const Case& c : cases) {
    const auto found = seconds.find(label(c.name, c.size, c.threads));
    if (found == seconds.end()) continue;
    const auto& s = found->second;
    MicroResult r{c.name,
                  c.size,
                  c.threads,
                  static_cast<int>(s.size()),
                  median(s),
                  *std::min_element(s.begin(), s.end()),
                  *std::max_element(s.begin(), s.end()),
                  0.0};
    const auto pair = seconds.find(label(c.pair, c.size, c.threads));
    if (pair != seconds.end()) r.over_fft = r.fastest / *std::min_element(pair->second.begin(), pair->second.end());
    results.push_back(r);
  }
  return results;
}

}  // namespace

std::vector<MicroResult> run_micro(const MicroOptions& options, const Budget& budget, double share) {
  const std::vector<Case> cases = cases_of(options);
  for (const Case& c : cases) {
    const auto in_time = [time = c.time, &budget, share](benchmark::State& state) {
      if (budget.left(share) > 0.0) {
        time(state);
      } else {
        // Not SkipWithError: with interleaved repetitions Google Benchmark 1.7 aborts on it.
        for (auto _ : state) benchmark::ClobberMemory();
        state.counters[kLate] = 1.0;
      }
    };
    auto* registered = benchmark::RegisterBenchmark(label(c.name, c.size, c.threads).c_str(), in_time);
    registered->UseRealTime()->Unit(benchmark::kMillisecond)->Repetitions(options.repetitions);
    registered->MinTime(options.quick ? 0.02 : 0.05);
  }
  std::vector<std::string> arguments{"dwell-bench", "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  return results_of(cases, collector.seconds());
}

}  // namespace dwell::bench
