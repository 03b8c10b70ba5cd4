#include "bench/measurements.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/whole_file.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr int kSchema = 1;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(fmt::format(
      "{}: {}; to measure everything anew, remove this file or say --anew; to keep it, name another with --results",
      file.string(), why));
}

/// The first circumstance that differs, in words; empty if none does.
std::string difference(const Json& there, const Json& here) {
  for (const auto& [key, value] : here.items()) {
    const Json other = there.contains(key) ? there.at(key) : Json();
    if (other != value)
      return fmt::format("measured with {} = {}, while it is {} now", key, other.dump(), value.dump());
  }
  for (const auto& [key, value] : there.items()) {
    if (!here.contains(key)) return fmt::format("measured with {} = {}, which is not said now", key, value.dump());
  }
  return "";
}

bool is_measurement(const Json& entry) {
  return entry.is_object() && entry.contains("result") && entry.contains("seconds") &&
         entry.at("seconds").is_number() && std::isfinite(entry.at("seconds").get<double>());
}

Json read_results(const std::filesystem::path& file) {
  Json all;
  try {
    all = Json::parse(read_whole_file(file));
  } catch (const Json::exception& e) {
    refuse(file, fmt::format("not the results of a benchmark, or damaged: {}", e.what()));
  }
  if (!all.is_object() || !all.contains("schema") || !all.contains("circumstances") || !all.contains("measurements"))
    refuse(file, "not the results of a benchmark: schema, circumstances or measurements are missing");
  if (all.at("schema") != kSchema)
    refuse(file, fmt::format("schema = {}; accepted: {}", all.at("schema").dump(), kSchema));
  if (!all.at("circumstances").is_object() || !all.at("measurements").is_object())
    refuse(file, "circumstances and measurements are not objects");
  for (const auto& [name, entry] : all.at("measurements").items()) {
    if (!is_measurement(entry)) refuse(file, fmt::format("the measurement '{}' has no result and seconds", name));
  }
  return all;
}

}  // namespace

Measurements::Measurements(std::filesystem::path file, Json circumstances)
    : file_(std::move(file)), circumstances_(std::move(circumstances)) {
  if (!std::filesystem::exists(file_)) return;
  const Json all = read_results(file_);
  if (const std::string why = difference(all.at("circumstances"), circumstances_); !why.empty()) refuse(file_, why);
  kept_ = all.at("measurements");
  taken_over_ = kept_.size();
}

Json Measurements::take(const std::string& name, const std::function<Json()>& measure) {
  if (const auto found = kept_.find(name); found != kept_.end()) return found->at("result");
  const auto begin = std::chrono::steady_clock::now();
  Json result = measure();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  kept_[name] = {{"result", result}, {"seconds", seconds}};
  if (!file_.empty()) {
    const Json all{{"schema", kSchema}, {"circumstances", circumstances_}, {"measurements", kept_}};
    write_whole_file(file_, all.dump() + "\n");
  }
  return result;
}

double Measurements::seconds(const std::string& prefix) const {
  double sum = 0.0;
  for (const auto& [name, entry] : kept_.items()) {
    if (name.starts_with(prefix)) sum += entry.at("seconds").get<double>();
  }
  return sum;
}

}  // namespace dwell::bench
