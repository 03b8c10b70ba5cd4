#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/progress.h"
#include "core/form/form_polynomials.h"
#include "core/map/height_map.h"
#include "core/motion/program.h"
#include "core/tif/removal_kernel.h"
#include "runs/plan/part.h"
#include "runs/plan/sampled_uncertainty.h"

namespace dwell {

/// What may be otherwise than a plan takes it to be.
enum class UncertainCause { Rate, Width, Position, Offset, Rotation, Metrology };
inline constexpr std::size_t kUncertainCauses = 6;

/// Its key in the grammar of an uncertainty: "tif-rate", "position", ...
const char* name_of(UncertainCause cause);

/// What a program leaves in one drawn truth, form terms removed.
struct ProgramSample {
  int number = 0;    // 1, 2, ...
  double rms = 0.0;  // about zero [nm]
  double pv = 0.0;   // [nm]

  friend bool operator==(const ProgramSample&, const ProgramSample&) = default;
};

/// Samples of one program, and where on the part they differ.
struct ProgramSamples {
  std::vector<ProgramSample> samples;
  HeightMap deviation;  // RMS over the samples of what they leave otherwise than is thought, form terms removed [nm]
};

/// What a motion leaves of a part if tool, machine and map are otherwise than thought. `left` is what is left if all is
/// as it is thought, form terms removed [nm]; a truth changes that by the difference of two simulations on the lattice
/// of `kernel`, so that the lattice's own error enters only as far as the truth is off. All must outlive it.
///
/// The rate scales what is removed, and the noise of the map is added to what is left: both are exact without a
/// simulation. The width changes the tool; offset, rotation (about the middle of the map) and the errors of the ends of
/// moves change the motion: these are simulated. Drawn factors of rate and width are at least 0.05.
class ProgramSampler {
 public:
  /// Cost: a simulation.
  ProgramSampler(const Part& part, const Program& motion, const RemovalKernel& kernel, const HeightMap& left,
                 const UncertaintySpec& unsure, unsigned seed);
  ProgramSampler(const ProgramSampler&) = delete;
  ProgramSampler& operator=(const ProgramSampler&) = delete;

  /// Mean square that is left if all is as it is thought [nm^2].
  double nominal_square() const { return nominal_square_; }

  /// Samples first, first + 1, ... below `end`. Every one is drawn on its own from the seed and its number, so that any
  /// of them can be made anywhere. Throws Interrupted, and InputError for a drawn tool that is too narrow for the
  /// pixels. Cost: at most a simulation a sample.
  ProgramSamples sample(int first, int end, const Progress& progress = {}) const;

  /// What each cause alone adds to the mean square that is left, in expectation [nm^2], by its place in UncertainCause;
  /// 0 for what is not uncertain. Rate and metrology by their closed forms; width, rotation and offset (in x and in y)
  /// by the three-point Gauss-Hermite rule, which is exact for polynomials of degree five; the errors of the ends,
  /// which are many, by pairs of samples of opposite sign. May be below zero. Throws as sample(). Cost: at most 24
  /// simulations.
  std::array<double, kUncertainCauses> alone(const Progress& progress = {}) const;

 private:
  struct Truth;
  Truth drawn(int number) const;
  std::vector<double> changed(const Truth& truth) const;
  double square_in(const Truth& truth) const;
  double added_by_pair(const Truth& one, const Truth& other) const;

  const Part& part_;
  const Program& motion_;
  const RemovalKernel& kernel_;
  const HeightMap& left_;
  UncertaintySpec unsure_;
  unsigned seed_;
  std::vector<Index> pixels_;
  FormPolynomials form_;  // refers to pixels_
  HeightMap removal_;     // of the motion as it is thought, on the lattice
  double nominal_square_ = 0.0;
};

}  // namespace dwell
