#include "runs/job/scatter_option.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {

ScatterOptions parse_scatter_options(const std::string& text) {
  std::optional<double> pitch, reach;
  for (const std::string_view field : split(text, ',')) {
    const std::size_t at = field.find('=');
    const std::string_view key = trim(field.substr(0, at));
    const auto value = at == std::string_view::npos ? std::nullopt : finite_number(field.substr(at + 1));
    std::optional<double>* const slot = key == "pitch" ? &pitch : key == "reach" ? &reach : nullptr;
    if (!slot || *slot || !value || !(*value > 0.0)) {
      throw InputError(fmt::format("'{}'; required pitch=MM[,reach=MM], both > 0, each once", text));
    }
    *slot = value;
  }
  if (!pitch) throw InputError(fmt::format("'{}'; required pitch=MM[,reach=MM], both > 0", text));
  return {*pitch, reach};
}

std::string to_string(const std::optional<ScatterOptions>& options) {
  if (!options) return "";
  const std::string reach = options->reach ? fmt::format(",reach={}", *options->reach) : "";
  return fmt::format("pitch={}{}", options->pitch, reach);
}

}  // namespace dwell
