#include "core/spectra/psd_line.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/spec_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

constexpr double kPerDecade = 10.0;

struct Bin {
  double count = 0.0, log_frequency = 0.0, density = 0.0;
};

}  // namespace

std::string power_of_frequency(const PsdLine& line) {
  return fmt::format("f^{:.3g}", 0.0 - line.b);  // 0 and not -0
}

double PsdLine::operator()(double frequency) const { return a * std::pow(frequency, -b); }

std::optional<PsdLineFit> fit_psd_line(const PsdCurve& curve, double from, double to) {
  std::map<int, Bin> bins;
  for (std::size_t k = 0; k < curve.frequency.size(); ++k) {
    const double f = curve.frequency[k];
    if (!(f >= from && f <= to)) continue;
    Bin& bin = bins[static_cast<int>(std::floor(kPerDecade * std::log10(f)))];
    bin.count += 1.0, bin.log_frequency += std::log10(f), bin.density += curve.density[k];
  }
  double n = 0.0, sx = 0.0, sy = 0.0;
  std::vector<std::pair<double, double>> points;
  for (const auto& [number, bin] : bins) {
    if (!(bin.density > 0.0)) continue;
    points.emplace_back(bin.log_frequency / bin.count, std::log10(bin.density / bin.count));
    n += 1.0, sx += points.back().first, sy += points.back().second;
  }
  if (points.size() < 3) return std::nullopt;
  double xx = 0.0, xy = 0.0;
  for (const auto& [x, y] : points) xx += (x - sx / n) * (x - sx / n), xy += (x - sx / n) * (y - sy / n);
  const double slope = xy / xx, at_one = sy / n - slope * sx / n;
  double square = 0.0;
  for (const auto& [x, y] : points) square += std::pow(y - at_one - slope * x, 2);
  return PsdLineFit{{std::pow(10.0, at_one), -slope}, from, to, std::sqrt(square / n)};
}

PsdLimitCheck check_psd_limit(const PsdCurve& curve, const PsdLine& limit, double from, double to) {
  PsdLimitCheck check;
  check.from = from, check.to = to;
  bool in_run = false;
  for (std::size_t k = 0; k < curve.frequency.size(); ++k) {
    const double f = curve.frequency[k];
    if (!(f >= from && f <= to)) continue;
    ++check.checked;
    const double factor = curve.density[k] / limit(f);
    if (!(factor <= check.worst_factor)) check.worst_factor = factor, check.worst_frequency = f;
    const bool is_above = !(factor <= 1.0);
    if (is_above) {
      ++check.above;
      if (in_run) {
        check.runs.back().second = f;
      } else {
        check.runs.emplace_back(f, f);
      }
    }
    in_run = is_above;
  }
  return check;
}

PsdLimit parse_psd_limit(const std::string& text) {
  constexpr ValueRange kDensities{1e-30, 1e30, ""}, kExponents{0.0, 20.0, ""};
  const auto [kind, rest] = split_kind(text);
  const bool has_kind = text.find(':') != std::string::npos;
  const auto fields = split(has_kind ? std::string_view(rest) : std::string_view(text), ',');
  if ((!has_kind || lower_case(trim(kind)) == "radial") && fields.size() == 2) {
    const auto a = finite_number(fields[0]), b = finite_number(fields[1]);
    if (a && b && kDensities.holds(*a) && kExponents.holds(*b)) return {has_kind, {*a, *b}};
  }
  throw InputError(fmt::format(
      "limit \"{}\"; accepted: A,B for the spectra along x and y (A > 0 in nm^2 mm, the density at 1/mm), or "
      "radial:A,B (A in nm^2 mm^2), for A f^-B: a negative B would be a limit that rises; A {}, B {}",
      text, kDensities.text(), kExponents.text()));
}

}  // namespace dwell
