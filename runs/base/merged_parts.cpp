#include "runs/base/merged_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"

namespace dwell {
namespace {

using AskedJson = nlohmann::ordered_json;

struct Difference {
  std::string field;  // "asked.options.smoothness"
  std::string first, second;
};

std::string short_text(const AskedJson& json) {
  constexpr std::size_t kMost = 60;
  std::string text = json.dump(-1, ' ', true);
  if (text.size() > kMost) text = text.substr(0, kMost) + "...";
  return text;
}

std::optional<Difference> first_difference(const AskedJson& a, const AskedJson& b, const std::string& field) {
  if (a == b) return {};
  if (a.is_object() && b.is_object()) {
    for (const auto& [key, value] : a.items()) {
      const std::string inner = field.empty() ? key : fmt::format("{}.{}", field, key);
      if (!b.contains(key)) return Difference{inner, short_text(value), "not given"};
      if (auto found = first_difference(value, b[key], inner)) return found;
    }
    for (const auto& [key, value] : b.items()) {
      const std::string inner = field.empty() ? key : fmt::format("{}.{}", field, key);
      if (!a.contains(key)) return Difference{inner, "not given", short_text(value)};
    }
  } else if (a.is_array() && b.is_array() && a.size() == b.size()) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (auto found = first_difference(a[k], b[k], fmt::format("{}[{}]", field, k))) return found;
    }
  }
  return Difference{field, short_text(a), short_text(b)};
}

/// What all parts of a sweep have in common.
AskedJson common_to_all(const SweepPart& part) {
  return {{"command", part.command}, {"shards", part.shard.count}, {"tasks", part.tasks}, {"asked", part.asked}};
}

void require_one_sweep(const std::vector<ReadSweepPart>& parts) {
  const AskedJson first = common_to_all(parts.front().part);
  for (const ReadSweepPart& other : parts) {
    const auto differs = first_difference(first, common_to_all(other.part), "");
    if (!differs) continue;
    throw InputError(fmt::format("part '{}' ({}): {} = {}; that of '{}' ({}) is {}. Parts of one sweep are required",
                                 other.place, to_string(other.part.shard), differs->field, differs->second,
                                 parts.front().place, to_string(parts.front().part.shard), differs->first));
  }
}

/// The part of every shard, in their order.
std::vector<const ReadSweepPart*> each_shard_once(const std::vector<ReadSweepPart>& parts) {
  std::vector<const ReadSweepPart*> shards(parts.front().part.shard.count, nullptr);
  for (const ReadSweepPart& part : parts) {
    const ReadSweepPart*& known = shards[part.part.shard.number - 1];
    if (known != nullptr) {
      throw InputError(fmt::format("shard {} comes twice, in '{}' and in '{}'; required each once",
                                   to_string(part.part.shard), known->place, part.place));
    }
    known = &part;
  }
  constexpr std::size_t kMostNamed = 20;
  std::vector<std::string> missing;
  std::size_t count = 0;
  for (std::size_t k = 0; k < shards.size(); ++k) {
    if (shards[k] != nullptr) continue;
    if (++count <= kMostNamed) missing.push_back(to_string(Shard{k + 1, shards.size()}));
  }
  if (count > 0) {
    throw InputError(fmt::format("{} of {} missing: {}{}", count, counted(shards.size(), "shard"),
                                 fmt::join(missing, ", "), count > kMostNamed ? ", ..." : ""));
  }
  return shards;
}

}  // namespace

MergedParts merge_parts(std::vector<ReadSweepPart> parts) {
  if (parts.empty()) throw InputError("no part is given; required all parts of a sweep");
  require_one_sweep(parts);
  const std::vector<const ReadSweepPart*> shards = each_shard_once(parts);
  const SweepPart& first = parts.front().part;
  MergedParts merged{first.command, first.asked, {}, {}};
  for (std::size_t task = 1; task <= first.tasks; ++task) {
    const ReadSweepPart& of = *shards[(task - 1) % shards.size()];
    merged.results.push_back(of.part.results[(task - 1) / shards.size()]);
    merged.folders.push_back(of.folder);
  }
  return merged;
}

}  // namespace dwell
