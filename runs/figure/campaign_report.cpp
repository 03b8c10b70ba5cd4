#include "runs/figure/campaign_report.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "runs/base/json_blocks.h"

namespace dwell {
namespace {

/// Errors of orientation that ended campaigns, a sentence each.
std::vector<std::string> faults_of(const std::vector<CampaignSample>& samples) {
  std::vector<std::string> faults;
  for (const CampaignSample& s : samples) {
    if (!s.fault.empty()) faults.push_back(fmt::format("campaign {}: {}", s.number, s.fault));
  }
  return faults;
}

}  // namespace

std::string campaign_text(const CampaignQuestion& question, const std::vector<CampaignSample>& samples) {
  std::string text = fmt::format("campaigns {} of {} each, seed {}: {}{}\n", counted(samples.size(), "sample"),
                                 counted(static_cast<std::size_t>(question.runs), "run"), question.seed,
                                 question.unsure.empty() ? "nothing uncertain" : question.unsure,
                                 question.learns ? "" : ", without learning");
  text += fmt::format("before    {:.4g} nm RMS\n", question.before);
  int run = 0;
  for (const CampaignSpread& s : spreads_of(samples, question.runs)) {
    ++run;
    if (s.samples == 0) {
      text += fmt::format("run {:<5} no campaign came so far\n", run);
      continue;
    }
    text += fmt::format("run {:<5} leaves {:.4g} nm RMS (5 to 95 %: {:.4g} to {:.4g}; most {:.4g}), dwell {}, {}\n",
                        run, s.median, s.fifth, s.ninety_fifth, s.most, duration_text(s.seconds),
                        counted(static_cast<std::size_t>(s.samples), "campaign"));
  }
  for (const std::string& fault : faults_of(samples)) text += fmt::format("ended     {}\n", fault);
  return text;
}

nlohmann::ordered_json campaign_json(const CampaignQuestion& question, const std::vector<CampaignSample>& samples) {
  nlohmann::ordered_json json = json_of_command("figure simulate");
  json["run"] = question.run;
  json["uncertainty"] = question.unsure;
  json["seed"] = question.seed;
  json["learns"] = question.learns;
  json["before_rms_nm"] = question.before;
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  for (const CampaignSpread& s : spreads_of(samples, question.runs)) {
    runs.push_back({{"campaigns", s.samples},
                    {"median_rms_nm", s.median},
                    {"p5_rms_nm", s.fifth},
                    {"p95_rms_nm", s.ninety_fifth},
                    {"least_rms_nm", s.least},
                    {"most_rms_nm", s.most},
                    {"dwell_s", s.seconds}});
  }
  json["runs"] = std::move(runs);
  nlohmann::ordered_json each = nlohmann::ordered_json::array();
  for (const CampaignSample& s : samples)
    each.push_back({{"sample", s.number}, {"rms_nm", s.left}, {"dwell_s", s.seconds}});
  json["samples"] = std::move(each);
  json["ended"] = faults_of(samples);
  return json;
}

}  // namespace dwell
