#include "runs/job/learnt_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {
namespace {

constexpr std::string_view kHeading = "step,stroke,late_s";

nlohmann::json summary_in(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json";
  nlohmann::json summary;
  if (std::filesystem::exists(file)) summary = nlohmann::json::parse(read_whole_file(file), nullptr, false);
  if (summary.is_object() && summary.value("command", nlohmann::json()) == "plan") return summary;
  throw InputError(
      fmt::format("{}: is not the folder of a plan; required one that dwell plan --out has written", folder.string()));
}

/// A text in the summary, by its way down: {"program", "sha256"}.
std::string text_at(const nlohmann::json& summary, std::initializer_list<const char*> way,
                    const std::filesystem::path& folder) {
  const nlohmann::json* at = &summary;
  std::string words;
  for (const char* key : way) {
    words += (words.empty() ? "" : ".") + std::string(key);
    const auto found = at->is_object() ? at->find(key) : at->end();
    if (found == at->end())
      throw InputError(fmt::format("{}: {} is missing", (folder / "summary.json").string(), words));
    at = &*found;
  }
  if (at->is_string()) return *at;
  throw InputError(fmt::format("{}: {} = {}; required text", (folder / "summary.json").string(), words, at->dump()));
}

/// A file in the folder, which must be as the summary knows it.
std::filesystem::path unchanged(const std::filesystem::path& folder, const std::string& name,
                                const std::string& sha256) {
  std::filesystem::path file = folder / name;
  if (file.filename() != name)
    throw InputError(fmt::format("{}: names the file '{}'; required one in the folder", folder.string(), name));
  if (sha256_of_file(file) == sha256) return file;
  throw InputError(fmt::format("{}: has changed since the plan was made; required the same file", file.string()));
}

}  // namespace

std::string late_text(const std::vector<Index>& stroke, const std::vector<double>& late) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "# by how much every step of the program takes longer than the machine is thought to need, as logs "
                 "tell\n{}\n",
                 kHeading);
  for (std::size_t i = 0; i < late.size(); ++i)
    fmt::format_to(out, "{},{},{:.9g}\n", i + 1, stroke[i] == StrokeMoves::kNoStroke ? 0 : stroke[i] + 1, late[i]);
  return fmt::to_string(text);
}

std::vector<double> parse_late_text(std::string_view text, const std::string& file) {
  std::vector<double> late;
  TextLines lines(text);
  bool headed = false;
  while (lines.next()) {
    const std::string_view line = lines.line();
    if (line.empty() || line.starts_with('#')) continue;
    if (!headed) {
      headed = line == kHeading;
      if (headed) continue;
      throw InputError(fmt::format("{}: line {}: '{}'; required the heading {}", file, lines.number(), line, kHeading));
    }
    const std::size_t first = line.find(','), last = line.rfind(',');
    const auto step = parse_number(line.substr(0, first));
    const auto seconds = last == std::string_view::npos ? std::nullopt : parse_number(line.substr(last + 1));
    if (first == last || !step || *step != static_cast<double>(late.size() + 1) || !seconds ||
        !std::isfinite(*seconds)) {
      throw InputError(fmt::format("{}: line {}: '{}'; required {} with step {} and a finite number of s", file,
                                   lines.number(), line, kHeading, late.size() + 1));
    }
    late.push_back(*seconds);
  }
  return late;
}

PlanOnDisk read_plan_on_disk(const std::filesystem::path& folder) {
  const nlohmann::json summary = summary_in(folder);
  PlanOnDisk plan;
  plan.program_sha256 = text_at(summary, {"program", "sha256"}, folder);
  plan.program = unchanged(folder, text_at(summary, {"program", "file"}, folder), plan.program_sha256);
  return plan;
}

std::optional<LearntFiles> read_learnt_files(const std::filesystem::path& folder) {
  const nlohmann::json summary = summary_in(folder);
  const auto motion = summary.find("motion");
  if (motion == summary.end() || !motion->contains("learnt")) return std::nullopt;
  LearntFiles learnt;
  const std::filesystem::path late =
      unchanged(folder, kLateFile, text_at(summary, {"motion", "learnt", "late_sha256"}, folder));
  learnt.late = parse_late_text(read_whole_file(late), late.string());
  learnt.removal =
      read_map(unchanged(folder, kLearntRemovalFile, text_at(summary, {"motion", "learnt", "removal_sha256"}, folder)));
  learnt.machine_sha256 = text_at(summary, {"motion", "learnt", "machine_sha256"}, folder);
  const nlohmann::json& logs = (*motion)["learnt"].value("logs", nlohmann::json());
  if (!logs.is_number_integer() || logs.get<long>() < 1)
    throw InputError(fmt::format("{}: motion.learnt.logs = {}; required a whole number >= 1",
                                 (folder / "summary.json").string(), logs.dump()));
  learnt.logs = logs.get<int>();
  return learnt;
}

}  // namespace dwell
