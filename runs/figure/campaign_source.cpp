#include "runs/figure/campaign_source.h"

#include "core/base/errors.h"
#include "runs/base/inputs_json.h"
#include "runs/job/job.h"
#include "runs/job/program_style.h"
#include "runs/plan/pitch_choice.h"
#include "runs/reports/options_json.h"

namespace dwell {

CampaignSource campaign_source(const JobOptions& options, const Progress& progress) {
  if (options.motion != Motion::Moving)
    throw InputError("--motion stop: campaigns are simulated with a moving tool; required moving");
  if (!options.keep_out.empty())
    throw InputError("--keep-out: campaigns are simulated on the whole path; required none");
  if (pitch_is_searched(options.path))
    throw InputError("--path: campaigns are simulated on one path; required a pitch");
  const Job job = load_job(without_program_style(options), progress);
  return {{job.part->map, job.part->tif, job.part->form, job.options.path, dwell_options(job), job.part->threads},
          options_json(job),
          inputs_json(job.inputs)};
}

}  // namespace dwell
