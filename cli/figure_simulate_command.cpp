#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/named_option.h"
#include "cli/places.h"
#include "cli/progress_line.h"
#include "cli/result_folder.h"
#include "cli/shard_option.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "core/form/map_statistics.h"
#include "runs/base/json_blocks.h"
#include "runs/figure/campaign_part.h"
#include "runs/figure/campaign_report.h"
#include "runs/figure/campaign_source.h"
#include "runs/figure/store/figure_state.h"

namespace dwell::cli {
namespace {

struct CampaignArguments {
  std::string run, uncertainty, out;
  int runs = 3, samples = 20;
  unsigned seed = 1;
  bool no_learning = false;
  ShardOption shard;
  ResultFolder folder;
  JsonOption json;
};

void check_counts(const CampaignArguments& a) {
  constexpr int kMostRuns = 20, kMostSamples = 100000;
  if (a.runs < 1 || a.runs > kMostRuns)
    throw InputError(fmt::format("--runs {}: required from 1 to {}", a.runs, kMostRuns));
  if (a.samples < 1 || a.samples > kMostSamples)
    throw InputError(fmt::format("--samples {}: required from 1 to {}", a.samples, kMostSamples));
}

CampaignQuestion question_of(const CampaignArguments& a) {
  CampaignQuestion question{a.run, "", a.runs, a.samples, a.seed, !a.no_learning, 0.0};
  if (!a.uncertainty.empty())
    question.unsure = of_option("--uncertainty", [&a] { return to_string(parse_uncertainty_spec(a.uncertainty)); });
  return question;
}

/// Campaigns that were simulated, and what they were made of.
struct DoneCampaigns {
  CampaignQuestion question;
  CampaignSource source;
  std::vector<CampaignSample> samples;
};

DoneCampaigns do_campaigns(const CampaignArguments& a, CampaignQuestion question, const Shard& shard) {
  const UncertaintySpec unsure = a.uncertainty.empty() ? UncertaintySpec{} : parse_uncertainty_spec(a.uncertainty);
  const Progress progress = terminal_progress();
  const RunFolder run(a.run);
  CampaignSource source = campaign_source(figure_state(run).options, progress);
  const CampaignStart& start = source.start;
  question.before = map_statistics(start.surface, start.form, start.threads).rms_about_zero();
  CampaignLearning learning;
  learning.learns = question.learns;
  std::vector<CampaignSample> samples = study_campaigns(
      start, unsure, learning, a.runs, shard.tasks_of(static_cast<std::size_t>(a.samples)), a.seed, progress);
  return {std::move(question), std::move(source), std::move(samples)};
}

int run_campaigns(const CampaignArguments& a) {
  check_counts(a);
  const std::optional<Shard> shard = a.shard.shard();
  if (shard.has_value() == a.out.empty())
    throw InputError("--shard, --out: the folder is that of a shard's part; required both or neither");
  a.json.check({}, a.run);
  a.json.check({}, a.out);
  CampaignQuestion question = question_of(a);
  if (shard) {
    if (lies_in(a.out, a.run)) throw InputError(fmt::format("--out '{}': lies in the run; required another", a.out));
    OutputFolder part = make_part_folder(a.folder, a.out, *shard, {});
    const DoneCampaigns done = do_campaigns(a, std::move(question), *shard);
    return deliver_part(campaign_part(done.question, done.source, *shard, done.samples), part, a.out, a.json);
  }
  const DoneCampaigns done = do_campaigns(a, std::move(question), {});
  finish_progress();
  a.json.deliver(json_text(campaign_json(done.question, done.samples)), campaign_text(done.question, done.samples));
  return kDone;
}

}  // namespace

void add_figure_simulate_command(CLI::App& figure, int& exit_code) {
  CLI::App* command = figure.add_subcommand(
      "simulate", "what the next runs would leave if tool, machine and instrument were off by so much: many campaigns");
  auto a = std::make_shared<CampaignArguments>();
  command->add_option("run", a->run, "folder of the run; it is not changed")->type_name("RUN")->required();
  command->add_option("--runs", a->runs, "runs of each campaign (default 3)")->type_name("N");
  command->add_option("--samples", a->samples, "campaigns (default 20)")->type_name("N");
  command->add_option("--seed", a->seed, "of the random numbers (default 1)")->type_name("N");
  command
      ->add_option("--uncertainty", a->uncertainty,
                   "standard deviations, each with its unit: tif-rate=15%,tif-width=5%,position=20um,offset=0.3mm,"
                   "rotation=0.2deg,metrology=0.2nm,drift=2%")
      ->type_name("WHAT=SIZE,...");
  command->add_flag("--no-learning", a->no_learning, "plan every run as the first, for comparison");
  a->shard.add_to(*command, "campaigns");
  command->add_option("--out", a->out, "with --shard: folder of the part")->type_name("FOLDER");
  a->folder.add_to(*command);
  a->json.add_to(*command);
  command->footer(
      "Example:\n  dwell figure simulate mirror/ --runs 3 --samples 100 \\\n"
      "                        --uncertainty tif-rate=15%,tif-width=5%,offset=0.3mm,metrology=0.2nm");
  command->callback([a, &exit_code] { exit_code = run_campaigns(*a); });
}

}  // namespace dwell::cli
