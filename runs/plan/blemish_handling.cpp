#include "runs/plan/blemish_handling.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr std::array<std::pair<BlemishHandling, std::string_view>, 3> kHandlings{
    {{BlemishHandling::Report, "report"}, {BlemishHandling::LeaveOut, "leave-out"}, {BlemishHandling::Keep, "keep"}}};

}  // namespace

BlemishHandling parse_blemish_handling(std::string_view text) {
  for (const auto& [handling, word] : kHandlings) {
    if (text == word) return handling;
  }
  throw InputError(fmt::format("'{}'; accepted: report, leave-out, keep", text));
}

std::string to_string(BlemishHandling handling) {
  for (const auto& [known, word] : kHandlings) {
    if (known == handling) return std::string(word);
  }
  return "";
}

}  // namespace dwell
