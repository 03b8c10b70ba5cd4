#include "runs/plan/sampled_uncertainty.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

struct CountRow {
  std::string_view key;
  double least, most;
};
constexpr std::array<CountRow, 2> kCountRows{{{"samples", 2.0, 1e4}, {"seed", 0.0, 2147483647.0}}};

double count_of(const CountRow& row, std::string_view part) {
  const auto value = parse_number(std::string(trim(part.substr(part.find('=') + 1))));
  if (value && *value >= row.least && *value <= row.most && *value == std::floor(*value)) return *value;
  throw InputError(
      fmt::format("'{}': required a whole number from {:.0f} to {:.0f}, without a unit", part, row.least, row.most));
}

UncertaintySpec sizes_of(const std::string& text) {
  try {
    return parse_uncertainty_spec(text);
  } catch (const InputError& error) {
    const std::string message = error.what();
    const bool lists_keys = message.find("accepted: ") != std::string::npos;
    throw InputError(message + (lists_keys ? ", of several runs only; samples=N, seed=N" : ""));
  }
}

}  // namespace

SampledUncertainty parse_sampled_uncertainty(std::string_view text) {
  std::string sizes;
  std::array<std::optional<double>, kCountRows.size()> counts;
  for (const std::string_view raw : split(text, ',')) {
    const std::string_view part = trim(raw), key = trim(part.substr(0, part.find('=')));
    bool is_count = false;
    for (std::size_t k = 0; k < kCountRows.size(); ++k) {
      if (key != kCountRows[k].key) continue;
      if (counts[k]) throw InputError(fmt::format("'{}': {} is given twice", text, key));
      counts[k] = count_of(kCountRows[k], part);
      is_count = true;
    }
    if (!is_count) sizes += (sizes.empty() ? "" : ",") + std::string(part);
  }
  SampledUncertainty uncertainty;
  if (!sizes.empty()) uncertainty.unsure = sizes_of(sizes);
  if (uncertainty.unsure.drift > 0.0) {
    throw InputError(
        fmt::format("'{}': drift is from run to run, and a plan is one run; required without it (tif-rate says how "
                    "wrong the rate of this run may be)",
                    text));
  }
  if (uncertainty.unsure == UncertaintySpec{})
    throw InputError(fmt::format("'{}': nothing in it is uncertain; required a size above 0, as tif-rate=5%", text));
  if (counts[0]) uncertainty.samples = static_cast<int>(*counts[0]);
  if (counts[1]) uncertainty.seed = static_cast<unsigned>(*counts[1]);
  return uncertainty;
}

std::string to_string(const SampledUncertainty& uncertainty) {
  return fmt::format("{},samples={},seed={}", to_string(uncertainty.unsure), uncertainty.samples, uncertainty.seed);
}

}  // namespace dwell
