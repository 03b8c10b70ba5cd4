#include "runs/acceptance/surface_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/form/map_statistics.h"
#include "core/form/robust_pv.h"
#include "core/map/surface_slope.h"
#include "core/spectra/psd.h"
#include "core/spectra/wavelength_bands.h"

namespace dwell {
namespace {

constexpr const char* kAccepted =
    "accepted: QUANTITY<=NUMBER[UNIT], separated by commas, with rms, pv, pvr, slope, mid or band(A..Bmm), as "
    "\"rms<=1, pv<=10nm, slope<=0.2urad, band(0.3..3mm)<=0.5\"";

struct LimitUnit {
  const char* name;
  double scale;  // to nm, or urad
};
constexpr std::array<LimitUnit, 6> kHeights{
    {{"nm", 1.0}, {"pm", 1e-3}, {"A", 0.1}, {"um", 1e3}, {"mm", 1e6}, {"", 1.0}}};
constexpr std::array<LimitUnit, 5> kSlopes{
    {{"urad", 1.0}, {"nrad", 1e-3}, {"mrad", 1e3}, {"arcsec", 4.84813681109536}, {"", 1.0}}};

/// Reads a specification, a limit after the other.
class LimitReader {
 public:
  LimitReader(std::string_view text, const std::vector<double>& band_edges) : text_(text), band_edges_(band_edges) {}

  std::vector<SurfaceLimit> read() {
    std::vector<SurfaceLimit> limits;
    for (const std::string_view part : split(text_, ',')) {
      part_ = trim(part);
      SurfaceLimit limit = read_limit();
      for (const SurfaceLimit& other : limits) {
        if (same_quantity(other, limit)) fail(fmt::format("{} is limited twice", limit.name));
      }
      limits.push_back(std::move(limit));
    }
    return limits;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("\"{}\": \"{}\": {}; {}", text_, part_, why, kAccepted));
  }

  static bool same_quantity(const SurfaceLimit& a, const SurfaceLimit& b) {
    return a.quantity == b.quantity && a.shortest == b.shortest && a.longest == b.longest;
  }

  SurfaceLimit read_limit() const {
    const std::size_t sign = part_.find("<=");
    if (sign == std::string_view::npos) fail("no <=");
    SurfaceLimit limit = read_quantity(trim(part_.substr(0, sign)));
    limit.most = read_value(trim(part_.substr(sign + 2)), limit.quantity == SurfaceQuantity::Slope);
    return limit;
  }

  SurfaceLimit read_quantity(std::string_view written) const {
    SurfaceLimit limit;
    limit.name = lower_case(written);
    if (limit.name == "rms") return limit;
    if (limit.name == "pv") return limit.quantity = SurfaceQuantity::Pv, limit;
    if (limit.name == "pvr") return limit.quantity = SurfaceQuantity::Pvr, limit;
    if (limit.name == "slope") return limit.quantity = SurfaceQuantity::Slope, limit;
    limit.quantity = SurfaceQuantity::Band;
    if (limit.name == "mid") {
      if (band_edges_.empty() || band_edges_.size() % 2 != 0) {
        fail(
            fmt::format("mid is the band in the middle of an even number of wavelengths (--bands 33,0.12), and there "
                        "are {}",
                        band_edges_.size()));
      }
      const std::size_t middle = band_edges_.size() / 2;
      limit.longest = band_edges_[middle - 1], limit.shortest = band_edges_[middle];
      return limit;
    }
    if (!limit.name.starts_with("band(") || !limit.name.ends_with(")")) fail("no such quantity");
    read_band(std::string_view(limit.name).substr(5, limit.name.size() - 6), limit);
    return limit;
  }

  void read_band(std::string_view written, SurfaceLimit& limit) const {
    std::string_view band = trim(written);
    if (!band.ends_with("mm")) fail("the wavelengths of a band need their unit, mm");
    band = band.substr(0, band.size() - 2);
    const std::size_t dots = band.find("..");
    if (dots == std::string_view::npos) fail("a band is two wavelengths with two dots between them");
    std::string_view first = trim(band.substr(0, dots));
    if (first.ends_with("mm")) first = first.substr(0, first.size() - 2);
    const std::optional<double> a = finite_number(first), b = finite_number(band.substr(dots + 2));
    if (!a || !b || !(*a > 0.0) || !(*b > 0.0) || *a == *b) fail("a band needs two different wavelengths > 0");
    limit.shortest = std::min(*a, *b), limit.longest = std::max(*a, *b);
  }

  double read_value(std::string_view written, bool is_slope) const {
    const std::size_t end = written.find_last_of("0123456789.");
    if (end == std::string_view::npos) fail("no number after <=");
    const std::string_view unit = trim(written.substr(end + 1));
    const std::optional<double> number = finite_number(written.substr(0, end + 1));
    if (!number || !(*number > 0.0)) fail("the limit must be a number > 0");
    const auto scaled = [&](const auto& units) {
      std::string names;
      for (const LimitUnit& known : units) {
        if (unit == known.name || (*known.name == 'u' && unit == fmt::format("\xC2\xB5{}", known.name + 1)))
          return *number * known.scale;
        if (*known.name != '\0') names += (names.empty() ? "" : ", ") + std::string(known.name);
      }
      fail(fmt::format("unit {}; of {} required one of {}", in_quotes(unit), is_slope ? "a slope" : "a height", names));
    };
    return is_slope ? scaled(kSlopes) : scaled(kHeights);
  }

  std::string_view text_;
  const std::vector<double>& band_edges_;
  std::string_view part_;
};

void judge_band(const ArealPsd& psd, SurfaceVerdict& verdict) {
  const BandRms band = band_rms(psd, {verdict.limit.longest, verdict.limit.shortest}).bands[1];
  verdict.value = band.rms;
  verdict.note = band.note;
}

HeightMap about_mean(HeightMap map, double mean) {
  for (double& value : map.values) value -= mean;
  return map;
}

std::optional<double> finite_or_none(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

std::vector<SurfaceLimit> parse_surface_limits(std::string_view text, const std::vector<double>& band_edges) {
  return LimitReader(text, band_edges).read();
}

void check_surface_limits(std::string_view text) {
  // Edges that no band of a specification has, so that `mid` is no band that the text limits as well.
  parse_surface_limits(text, {1.7e300, 1.3e300});
}

std::vector<double> tool_band_edges(double fwhm) { return {2.0 * fwhm, 0.5 * fwhm}; }

std::string surface_limits_text(const std::vector<SurfaceLimit>& limits) {
  std::string text;
  for (const SurfaceLimit& limit : limits) {
    std::string name = limit.name;
    if (name == "mid") name = fmt::format("band({}..{}mm)", limit.shortest, limit.longest);  // whatever the edges
    text += fmt::format("{}{}<={}{}", text.empty() ? "" : ", ", name, limit.most, limit.unit());
  }
  return text;
}

std::vector<SurfaceVerdict> judge_surface(const HeightMap& map, const FormTerms& form,
                                          const std::vector<SurfaceLimit>& limits, int threads,
                                          const Progress& progress) {
  const HeightMap figure = without_form(map, form, threads);
  const MapStatistics statistics = map_statistics(figure, {}, threads);
  PsdOptions options;
  options.threads = threads;
  std::optional<ArealPsd> psd;
  std::vector<SurfaceVerdict> verdicts;
  for (const SurfaceLimit& limit : limits) {
    progress.check();
    SurfaceVerdict verdict{limit, {}, {}};
    switch (limit.quantity) {
      case SurfaceQuantity::Rms:
        verdict.value = finite_or_none(statistics.rms_about_zero());
        break;
      case SurfaceQuantity::Pv:
        verdict.value = finite_or_none(statistics.pv);
        break;
      case SurfaceQuantity::Pvr:
        if (const auto robust = robust_pv(figure, threads)) verdict.value = finite_or_none(robust->pvr);
        if (!verdict.value) verdict.note = "too few pixels";
        break;
      case SurfaceQuantity::Slope:
        verdict.value = finite_or_none(slope_statistics(figure, threads).total);
        if (!verdict.value) verdict.note = "no neighbouring pixels along both axes";
        break;
      case SurfaceQuantity::Band:
        if (!psd) psd = areal_psd(about_mean(figure, statistics.mean), options);
        judge_band(*psd, verdict);
        break;
    }
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

bool all_pass(const std::vector<SurfaceVerdict>& verdicts) {
  return std::all_of(verdicts.begin(), verdicts.end(), [](const SurfaceVerdict& v) { return v.passes(); });
}

std::string verdict_lines(const std::vector<SurfaceVerdict>& verdicts) {
  std::string text;
  for (const SurfaceVerdict& v : verdicts) {
    const std::string value = v.value ? fmt::format("{:.4g} {}", *v.value, v.limit.unit()) : "not known";
    text += fmt::format("{:<10}{:<18}at most {:.4g} {}, is {}, {}{}\n", text.empty() ? "accept" : "", v.limit.name,
                        v.limit.most, v.limit.unit(), value,
                        v.passes() ? fmt::format("{:.4g} {} to spare: passes", v.margin(), v.limit.unit())
                        : v.value  ? fmt::format("{:.4g} {} too much: FAILS", -v.margin(), v.limit.unit())
                                   : std::string("so it FAILS"),
                        v.note.empty() ? "" : fmt::format(" ({})", v.note));
  }
  return text;
}

}  // namespace dwell
