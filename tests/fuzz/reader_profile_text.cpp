#include <cmath>

#include "core/formats/profile_text.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

/// Whatever is read has places that increase, and values that make a profile.
void require_profile(std::string_view bytes, const dwell::ProfileReadOptions& options) {
  const dwell::ProfileText text = dwell::parse_profile_text(bytes, options, "profile");
  dwell::fuzz::require(text.x.size() >= dwell::kFewestPlaces && text.values.size() == text.x.size());
  for (std::size_t i = 1; i < text.x.size(); ++i) dwell::fuzz::require(text.x[i] > text.x[i - 1]);
  for (const double value : text.values) dwell::fuzz::require(std::isfinite(value));
  const dwell::LineProfile profile = dwell::line_profile(text.quantity, text.x, text.values);
  const dwell::ProfileText again =
      dwell::parse_profile_text(dwell::profile_csv(profile, "again"), {}, "what was written");
  dwell::fuzz::require(again.quantity == text.quantity && again.x == text.x && again.values == text.values);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dwell::fuzz::read(data, size, [](std::string_view bytes) { require_profile(bytes, {"1,2", "mm,-urad"}); });
  return dwell::fuzz::read(data, size, [](std::string_view bytes) { require_profile(bytes, {}); });
}
