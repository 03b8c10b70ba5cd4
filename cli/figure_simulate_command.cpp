#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/named_option.h"
#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "core/form/map_statistics.h"
#include "runs/base/json_blocks.h"
#include "runs/figure/campaign_report.h"
#include "runs/figure/campaign_start.h"
#include "runs/figure/store/figure_state.h"

namespace dwell::cli {
namespace {

struct CampaignArguments {
  std::string folder, uncertainty;
  int runs = 3, samples = 20;
  unsigned seed = 1;
  bool no_learning = false;
  JsonOption json;
};

void check_counts(const CampaignArguments& a) {
  constexpr int kMostRuns = 20, kMostSamples = 100000;
  if (a.runs < 1 || a.runs > kMostRuns)
    throw InputError(fmt::format("--runs {}: required from 1 to {}", a.runs, kMostRuns));
  if (a.samples < 1 || a.samples > kMostSamples)
    throw InputError(fmt::format("--samples {}: required from 1 to {}", a.samples, kMostSamples));
}

int run_campaigns(const CampaignArguments& a) {
  check_counts(a);
  a.json.check({}, a.folder);
  CampaignQuestion question{a.folder, {}, a.runs, a.samples, a.seed, !a.no_learning, 0.0};
  if (!a.uncertainty.empty())
    question.unsure = of_option("--uncertainty", [&a] { return parse_uncertainty_spec(a.uncertainty); });
  const Progress progress = terminal_progress();
  const RunFolder run(a.folder);
  const CampaignStart start = campaign_start(figure_state(run).options, progress);
  question.before = map_statistics(start.surface, start.form, start.threads).rms_about_zero();
  CampaignLearning learning;
  learning.learns = question.learns;
  const CampaignStudy study =
      study_campaigns(start, question.unsure, learning, a.runs, 1, a.samples + 1, a.seed, progress);
  finish_progress();
  a.json.deliver(json_text(campaign_json(question, study)), campaign_text(question, study));
  return kDone;
}

}  // namespace

void add_figure_simulate_command(CLI::App& figure, int& exit_code) {
  CLI::App* command = figure.add_subcommand(
      "simulate", "what the next runs would leave if tool, machine and instrument were off by so much: many campaigns");
  auto a = std::make_shared<CampaignArguments>();
  command->add_option("run", a->folder, "folder of the run; it is not changed")->type_name("RUN")->required();
  command->add_option("--runs", a->runs, "runs of each campaign (default 3)")->type_name("N");
  command->add_option("--samples", a->samples, "campaigns (default 20)")->type_name("N");
  command->add_option("--seed", a->seed, "of the random numbers (default 1)")->type_name("N");
  command
      ->add_option("--uncertainty", a->uncertainty,
                   "standard deviations, each with its unit: tif-rate=15%,tif-width=5%,position=20um,offset=0.3mm,"
                   "rotation=0.2deg,metrology=0.2nm,drift=2%")
      ->type_name("WHAT=SIZE,...");
  command->add_flag("--no-learning", a->no_learning, "plan every run as the first, for comparison");
  a->json.add_to(*command);
  command->footer(
      "Example:\n  dwell figure simulate mirror/ --runs 3 --samples 100 \\\n"
      "                        --uncertainty tif-rate=15%,tif-width=5%,offset=0.3mm,metrology=0.2nm");
  command->callback([a, &exit_code] { exit_code = run_campaigns(*a); });
}

}  // namespace dwell::cli
