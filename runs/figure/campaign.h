#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/tif/removal_function.h"
#include "paths/path_catalogue.h"
#include "runs/figure/tool_lesson.h"
#include "runs/plan/dwell_options.h"

namespace dwell {

/// How a shop's truth differs from what it thinks, for a simulated campaign.
struct CampaignTruth {
  double rate = 1.0, width = 1.0;  // of the tool, over what is thought
  Point shift;                     // where the machine removes, against where it is told to [mm]
  double degrees = 0.0;            // turned about the middle of the map
  double drift = 0.0;              // standard deviation by which the rate changes from run to run, as a share
  double noise = 0.0;              // of a measurement, a pixel, standard deviation [nm]
  double position = 0.0;           // of every end of a move, in x and in y, standard deviation [mm]
};

/// What the runs of a campaign learn.
struct CampaignLearning {
  bool learns = true;  // else every run is planned as the first
  LessonPolicy policy;
};

/// A run of a campaign: what was thought, what came of it.
struct CampaignRun {
  double before = 0.0;     // RMS of the true surface, form terms removed [nm]
  double predicted = 0.0;  // what the plan thought would be left [nm]
  double after = 0.0;      // what is left in truth [nm]
  double seconds = 0.0;    // of dwell
  std::optional<ToolLesson> lesson;
};

struct Campaign {
  std::vector<CampaignRun> runs;
  std::string fault;  // an orientation error that ended it; else empty
};

/// What a campaign starts from.
struct CampaignStart {
  HeightMap surface;    // in truth [nm], NaN outside the part
  RemovalFunction tif;  // as it is thought
  FormTerms form;
  PathSpec path;
  DwellOptions options;
  int threads = 1;
};

/// Simulates measure, plan, polish, measure ... for so many runs: each plan is for the measured surface and what is
/// known of the tool by then, each run removes what the truth makes of its program, exactly as simulate() does, and
/// each measurement teaches what learn_from() takes over. Deterministic for a seed. Throws Interrupted, and InputError
/// as the plans do. Cost: a plan and seven simulations a run.
Campaign simulate_campaign(const CampaignStart& start, const CampaignTruth& truth, const CampaignLearning& learning,
                           int runs, unsigned seed, const Progress& progress = {});

}  // namespace dwell
