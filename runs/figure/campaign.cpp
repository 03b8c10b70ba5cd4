#include "runs/figure/campaign.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/grid_limit.h"
#include "core/base/random_numbers.h"
#include "core/form/map_statistics.h"
#include "core/numerics/plane_transform.h"
#include "core/removal/simulate.h"
#include "core/tif/removal_kernel.h"
#include "core/tif/scaled_removal.h"
#include "paths/feed/execution.h"
#include "runs/figure/tool_removal.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/machine_program.h"
#include "runs/plan/moved_program.h"
#include "runs/plan/part.h"

namespace dwell {
namespace {

class CampaignShop {
 public:
  CampaignShop(const CampaignStart& start, const CampaignTruth& truth, unsigned seed)
      : start_(start),
        truth_(truth),
        random_(seed),
        surface_(start.surface),
        misplaced_(similarity(middle_of(start.surface.grid), truth.shift, truth.degrees, 1.0)) {}

  const HeightMap& surface() const { return surface_; }
  double rms() const { return map_statistics(surface_, start_.form, start_.threads).rms_about_zero(); }

  HeightMap measured() {
    HeightMap map = surface_;
    for (double& height : map.values) {
      if (std::isfinite(height)) height += truth_.noise * random_.normal();
    }
    return map;
  }

  void polish(const Program& motion) {
    const double rate = truth_.rate * (1.0 + truth_.drift * random_.normal());
    const RemovalFunction tool = scaled_removal(start_.tif, rate, truth_.width);
    const RemovalKernel kernel = pixel_kernel(tool, surface_.grid.pitch_x, surface_.grid.pitch_y);
    const Program as_run = moved_program(jittered_program(motion, truth_.position, random_), misplaced_);
    surface_ = surface_after(surface_, simulate(as_run, surface_, kernel, start_.threads));
  }

 private:
  const CampaignStart& start_;
  const CampaignTruth& truth_;
  RandomNumbers random_;
  HeightMap surface_;
  PlaneTransform misplaced_;
};

HeightMap difference_of(const HeightMap& a, const HeightMap& b) {
  HeightMap difference = a;
  for (std::size_t i = 0; i < a.values.size(); ++i) difference.values[i] -= b.values[i];
  return difference;
}

}  // namespace

Campaign simulate_campaign(const CampaignStart& start, const CampaignTruth& truth, const CampaignLearning& learning,
                           int runs, unsigned seed, const Progress& progress) {
  Campaign campaign;
  CampaignShop shop(start, truth, seed);
  RemovalFunction known = start.tif;
  PlaneTransform commanded;  // from where removal is meant to where the machine is told to go
  HeightMap measured = shop.measured();
  for (int run = 1; run <= runs; ++run) {
    const Progress here = progress.of_part(fmt::format("run {}", run));
    CampaignRun result;
    result.before = shop.rms();
    const Part part = make_part(measured, known, start.form, start.threads, here);
    const double max_feed = start.options.machine.feed_limits().max_feed;
    const LaidPath laid = lay_path(part, start.path, Motion::Moving, max_feed, here);
    const DwellPlan dwell = find_dwell(part, laid, start.options, here);
    const MachineProgram program = make_machine_program(laid, dwell, start.options.machine, here);
    const bool of_speeds = dwell.motion && dwell.motion->program;
    Program motion = of_speeds ? *dwell.motion->program : program_of(program.table);
    if (start.options.machine.machine) motion = execute(motion, *start.options.machine.machine, here).motion;
    result.predicted = dwell.motion ? dwell.motion->executed() : dwell.residual.rms_about_zero();
    result.seconds = dwell.seconds.sum();
    shop.polish(moved_program(motion, commanded));
    result.after = shop.rms();
    HeightMap next = shop.measured();
    if (learning.learns) {
      const PredictedRemoval predicted =
          ToolRemoval(part, part.kernel).predict(motion, kRegisteredWidths, known.fwhm, here);
      RemovalRegistrationOptions options;
      options.correlated_mm = known.fwhm;
      const RemovalRegistration found =
          register_removal(predicted, difference_of(measured, next), options, start.threads, here);
      result.lesson = learn_from(found, known.fwhm, learning.policy);
      campaign.fault = result.lesson->orientation_fault;
      known = scaled_removal(known, result.lesson->rate, result.lesson->width);
      const PlaneTransform off = similarity(found.about, result.lesson->shift, result.lesson->degrees, 1.0);
      commanded = composed(commanded, off.inverse());
    }
    measured = std::move(next);
    campaign.runs.push_back(std::move(result));
    if (!campaign.fault.empty()) break;
  }
  return campaign;
}

}  // namespace dwell
