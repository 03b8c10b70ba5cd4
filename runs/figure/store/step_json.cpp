#include "runs/figure/store/step_json.h"

#include "runs/base/json_blocks.h"

namespace dwell {

nlohmann::ordered_json step_json(const std::string& command, const RunFolder& run, const RunStep& step,
                                 const std::vector<std::string>& limits) {
  nlohmann::ordered_json json = json_of_command(command);
  json["run"] = run.folder().string();
  json["step"] = step.number;
  json["kind"] = step.kind;
  json["iteration"] = step.iteration;
  json["folder"] = run.path_of(step).string();
  json["content"] = step.content;
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const StepFile& file : step.files) files.push_back({{"name", file.name}, {"sha256", file.sha256}});
  json["files"] = std::move(files);
  json["limits"] = limits;
  return json;
}

}  // namespace dwell
