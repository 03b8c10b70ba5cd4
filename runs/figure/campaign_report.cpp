#include "runs/figure/campaign_report.h"

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "runs/base/json_blocks.h"

namespace dwell {

std::string campaign_text(const CampaignQuestion& question, const CampaignStudy& study) {
  std::string text =
      fmt::format("campaigns {} of {} each, seed {}: {}{}\n", counted(study.left.size(), "sample"),
                  counted(static_cast<std::size_t>(question.runs), "run"), question.seed,
                  question.unsure == UncertaintySpec{} ? "nothing uncertain" : to_string(question.unsure),
                  question.learns ? "" : ", without learning");
  text += fmt::format("before    {:.4g} nm RMS\n", question.before);
  int run = 0;
  for (const CampaignSpread& s : spreads_of(study, question.runs)) {
    ++run;
    if (s.samples == 0) {
      text += fmt::format("run {:<5} no campaign came so far\n", run);
      continue;
    }
    text += fmt::format("run {:<5} leaves {:.4g} nm RMS (5 to 95 %: {:.4g} to {:.4g}; most {:.4g}), dwell {}, {}\n",
                        run, s.median, s.fifth, s.ninety_fifth, s.most, duration_text(s.seconds),
                        counted(static_cast<std::size_t>(s.samples), "campaign"));
  }
  for (const std::string& fault : study.faults) text += fmt::format("ended     {}\n", fault);
  return text;
}

nlohmann::ordered_json campaign_json(const CampaignQuestion& question, const CampaignStudy& study) {
  nlohmann::ordered_json json = json_of_command("figure simulate");
  json["run"] = question.run;
  json["uncertainty"] = to_string(question.unsure);
  json["seed"] = question.seed;
  json["learns"] = question.learns;
  json["before_rms_nm"] = question.before;
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  for (const CampaignSpread& s : spreads_of(study, question.runs)) {
    runs.push_back({{"campaigns", s.samples},
                    {"median_rms_nm", s.median},
                    {"p5_rms_nm", s.fifth},
                    {"p95_rms_nm", s.ninety_fifth},
                    {"least_rms_nm", s.least},
                    {"most_rms_nm", s.most},
                    {"dwell_s", s.seconds}});
  }
  json["runs"] = std::move(runs);
  nlohmann::ordered_json samples = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < study.left.size(); ++k)
    samples.push_back(
        {{"sample", study.first + static_cast<int>(k)}, {"rms_nm", study.left[k]}, {"dwell_s", study.seconds[k]}});
  json["samples"] = std::move(samples);
  json["ended"] = study.faults;
  return json;
}

}  // namespace dwell
