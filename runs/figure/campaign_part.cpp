#include "runs/figure/campaign_part.h"

namespace dwell {

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
  for (const CampaignSample& sample : samples) {
    nlohmann::ordered_json left = nlohmann::ordered_json::array(), seconds = left;
    for (const double value : sample.left) left.push_back(exact_json(value));
    for (const double value : sample.seconds) seconds.push_back(exact_json(value));
    part.results.push_back({{"rms_nm", left}, {"dwell_s", seconds}, {"ended", sample.fault}});
  }
  return part;
}

MergedCampaigns merged_campaigns(const MergedParts& parts) {
  const nlohmann::ordered_json& asked = parts.asked;
  MergedCampaigns merged;
  merged.question = {asked.at("run"),  asked.at("uncertainty"), asked.at("runs"),         asked.at("samples"),
                     asked.at("seed"), asked.at("learns"),      asked.at("before_rms_nm")};
  for (const nlohmann::ordered_json& result : parts.results) {
    CampaignSample& sample = merged.samples.emplace_back();
    sample.number = static_cast<int>(merged.samples.size());
    for (const auto& value : result.at("rms_nm")) sample.left.push_back(exact_number(value));
    for (const auto& value : result.at("dwell_s")) sample.seconds.push_back(exact_number(value));
    sample.fault = result.at("ended");
  }
  return merged;
}

}  // namespace dwell
