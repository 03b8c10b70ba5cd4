#include "core/form/polynomial_spec.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/spec_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

constexpr int kMostDegree = 14;  // as high as the Zernike polynomials go
constexpr const char* kAccepted =
    "piston,tilt,power,astigmatism (some of them) or none; zernike-noll:1-36, zernike-fringe:1-37 or "
    "zernike-ansi:0-35 with ,x=MM,y=MM,radius=MM,obscuration=RATIO if wanted; legendre:4 or chebyshev:4 (total "
    "degree), legendre:4x3 (along x and y)";

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(fmt::format("form \"{}\": {}; accepted: {}", text, why, kAccepted));
}

/// A whole number of at most four digits; -1 if the text is none.
int whole_number(std::string_view text) {
  text = trim(text);
  if (text.empty() || text.size() > 4 || text.find_first_not_of("0123456789") != std::string_view::npos) return -1;
  return static_cast<int>(*parse_number(text));
}

void parse_circle(PolynomialSpec& spec, const std::string& text, const std::string& entries) {
  const SpecText circle = parse_spec_text("zernike:" + entries, "form");
  circle.accept_only({"x", "y", "radius", "obscuration"});
  if (circle.has("x") != circle.has("y")) refuse(text, "x and y of the centre are given together or not at all");
  if (circle.has("x")) spec.centre = Point{circle.number("x"), circle.number("y")};
  if (spec.centre && !(ranges::kPlace.holds(spec.centre->x) && ranges::kPlace.holds(spec.centre->y))) {
    refuse(text, "the centre must be finite, x and y each " + ranges::kPlace.text());
  }
  spec.radius = circle.optional_number("radius");
  if (spec.radius && !ranges::kSize.holds(*spec.radius)) refuse(text, "radius must be > 0, " + ranges::kSize.text());
  spec.obscuration = circle.number("obscuration", 0.0);
  if (!(spec.obscuration >= 0.0 && spec.obscuration < 1.0)) refuse(text, "obscuration must be >= 0 and < 1");
}

PolynomialSpec parse_zernike(const std::string& text, ZernikeOrdering ordering, const std::string& rest) {
  PolynomialSpec spec;
  spec.kind = PolynomialSpec::Kind::Zernike;
  spec.ordering = ordering;
  const std::size_t comma = rest.find(',');
  const std::string range = rest.substr(0, comma);
  const std::size_t dash = range.find('-');
  if (dash == std::string::npos) refuse(text, "a range of numbers FIRST-LAST is required");
  spec.first = whole_number(std::string_view(range).substr(0, dash));
  spec.last = whole_number(std::string_view(range).substr(dash + 1));
  const int least = first_zernike(ordering), most = last_zernike(ordering);
  if (spec.first < least || spec.last > most || spec.first > spec.last) {
    refuse(text, fmt::format("numbers of the ordering {} run from {} to {}", to_string(ordering), least, most));
  }
  if (comma != std::string::npos) parse_circle(spec, text, rest.substr(comma + 1));
  return spec;
}

PolynomialSpec parse_product(const std::string& text, PolynomialSpec::Kind kind, const std::string& rest) {
  PolynomialSpec spec;
  spec.kind = kind;
  const std::size_t cross = rest.find('x');
  spec.total = cross == std::string::npos;
  spec.degree_x = whole_number(std::string_view(rest).substr(0, cross));
  spec.degree_y = spec.total ? spec.degree_x : whole_number(std::string_view(rest).substr(cross + 1));
  for (const int degree : {spec.degree_x, spec.degree_y}) {
    if (degree < 0 || degree > kMostDegree) {
      refuse(text, fmt::format("a degree is a whole number from 0 to {}", kMostDegree));
    }
  }
  return spec;
}

}  // namespace

PolynomialSpec parse_polynomial_spec(const std::string& text) {
  const auto [kind_text, rest] = split_kind(text);
  const std::string kind = lower_case(trim(kind_text));
  for (const ZernikeOrdering ordering : {ZernikeOrdering::Noll, ZernikeOrdering::Fringe, ZernikeOrdering::Ansi}) {
    if (kind == "zernike-" + to_string(ordering)) return parse_zernike(text, ordering, rest);
  }
  if (kind == "zernike") refuse(text, "the ordering must be named");
  if (kind == "legendre") return parse_product(text, PolynomialSpec::Kind::Legendre, rest);
  if (kind == "chebyshev") return parse_product(text, PolynomialSpec::Kind::Chebyshev, rest);
  PolynomialSpec spec;
  try {
    spec.terms = parse_form_terms(text);
  } catch (const InputError&) {
    refuse(text, "unknown");
  }
  return spec;
}

std::string to_string(const PolynomialSpec& spec) {
  if (spec.kind == PolynomialSpec::Kind::Terms) return to_string(spec.terms);
  if (spec.kind == PolynomialSpec::Kind::Zernike) {
    std::string text = fmt::format("zernike-{}:{}-{}", to_string(spec.ordering), spec.first, spec.last);
    if (spec.centre) text += fmt::format(",x={},y={}", spec.centre->x, spec.centre->y);
    if (spec.radius) text += fmt::format(",radius={}", *spec.radius);
    if (spec.obscuration > 0.0) text += fmt::format(",obscuration={}", spec.obscuration);
    return text;
  }
  const char* name = spec.kind == PolynomialSpec::Kind::Legendre ? "legendre" : "chebyshev";
  return spec.total ? fmt::format("{}:{}", name, spec.degree_x)
                    : fmt::format("{}:{}x{}", name, spec.degree_x, spec.degree_y);
}

}  // namespace dwell
