#include "runs/figure/campaign_part.h"

#include "runs/base/exact_json.h"

namespace dwell {

template <class Visit>
void each_field(CampaignSample& sample, const Visit& visit) {
  visit("sample", sample.number), visit("rms_nm", sample.left), visit("dwell_s", sample.seconds);
  visit("ended", sample.fault);
}

SweepPart campaign_part(const CampaignQuestion& question, const CampaignSource& source, const Shard& shard,
                        const std::vector<CampaignSample>& samples) {
  SweepPart part{kCampaignsCommand, shard, static_cast<std::size_t>(question.samples), {}};
  part.asked = {{"run", question.run},
                {"uncertainty", question.unsure},
                {"runs", question.runs},
                {"samples", question.samples},
                {"seed", question.seed},
                {"learns", question.learns},
                {"before_rms_nm", question.before},
                {"options", source.options},
                {"inputs", source.inputs}};
  for (const CampaignSample& sample : samples) part.results.push_back(exact_json(sample));
  return part;
}

MergedCampaigns merged_campaigns(const MergedParts& parts) {
  const nlohmann::ordered_json& asked = parts.asked;
  MergedCampaigns merged;
  merged.question = {asked.at("run"),  asked.at("uncertainty"), asked.at("runs"),         asked.at("samples"),
                     asked.at("seed"), asked.at("learns"),      asked.at("before_rms_nm")};
  for (const nlohmann::ordered_json& result : parts.results) read_exact(result, merged.samples.emplace_back());
  return merged;
}

}  // namespace dwell
