#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/formats/header_statements.h"
#include "core/formats/text_header.h"
#include "core/map/value_units.h"

// What comments say of where pixels lie: the part of TextHeader that takes pitch, size and origin.

namespace dwell {
namespace {

using About = UnclearStatement::About;

/// Text behind a name whose value should be a number: "Gugolz 64" behind a pitch is what polishes.
bool begins_with_a_letter(std::string_view text) {
  const char c = text.empty() ? ' ' : text.front();
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The names of the program's own files, whose two numbers stand beside a comma without a blank.
bool is_documented(const HeaderKey& key) { return key.shown == "pitch_mm" || key.shown == "origin_mm"; }

}  // namespace

/// "the pixel pitch was found to be 0.25 mm".
bool TextHeader::take_prose_pitch(const HeaderKey& key, std::string_view value) {
  if (!holds_a_length(value)) return false;
  add_unclear(About::Pitch, fmt::format("{} looks like a pixel pitch; write '# pitch_mm: 0.1'",
                                        in_quotes(key.shown + " " + std::string(value))));
  return true;
}

/// The unit of lengths that a statement has in its name or its value [nm]; 0 = none. Both must agree.
double TextHeader::unit_of_lengths(const HeaderKey& key, std::string_view value, const HeaderLengths& lengths) const {
  if (key.length && lengths.length && !statements_agree(*key.length, *lengths.length)) {
    refuse(key, value, fmt::format("numbers in {}", key.unit));
  }
  return lengths.length.value_or(key.length.value_or(0.0));
}

bool TextHeader::take_pitch(const HeaderKey& key, std::string_view value, InText trust) {
  const char* const required = "one finite number > 0, or two (x,y) separated by a comma, in mm or with a unit,";
  if (!is_documented(key) && may_have_decimal_comma(value)) {
    add_unclear(
        About::Pitch,
        fmt::format("{} = '{}': a decimal comma, or x and y? Write '# pitch_mm: 0.5', with a point", key.shown, value));
    return true;
  }
  const bool sure = trust == InText::Sure;
  const auto lengths = parse_header_lengths(value);
  if (!lengths || lengths->pixels) {
    if (!sure) return false;
    if (key.unit.empty() && begins_with_a_letter(value) && !holds_a_length(value)) {
      if (words_of(value).size() > 1) return false;  // "Gugolz 64" is for polishing
      add_unclear(About::Pitch, fmt::format("{} = '{}'; {} required", key.shown, value, required));
      return true;
    }
    refuse(key, value, required);
  }
  const double unit = unit_of_lengths(key, value, *lengths);
  if (unit == 0.0 && !sure) return false;
  const std::vector<double> mm = lengths->mm(unit);
  if (std::any_of(mm.begin(), mm.end(), [](double v) { return !(v > 0.0 && std::isfinite(v)); }) ||
      (key.axis != 0 && mm.size() > 1 && unit > 0.0)) {
    if (unit > 0.0) refuse(key, value, required);
  }
  only_once(key, MapTopic::Pitch);
  if (unit == 0.0 || trust == InText::Doubtful) {
    add_unclear(About::Pitch,
                fmt::format("{} = '{}' looks like a pixel pitch{}; write '# pitch_mm: 0.1', or the number with its "
                            "unit: '# pitch: 100 um'",
                            key.shown, value, unit == 0.0 ? " without a unit" : ""));
    return true;
  }
  const bool along_x = key.axis != 'y' || mm.size() > 1, along_y = key.axis != 'x' || mm.size() > 1;
  if (along_x) layout_.set(SaidLayout::What::Pitch, SaidLayout::Axis::X, {mm.front(), key.shown}, place());
  if (along_y) layout_.set(SaidLayout::What::Pitch, SaidLayout::Axis::Y, {mm.back(), key.shown}, place());
  return true;
}

bool TextHeader::take_size(const HeaderKey& key, std::string_view value) {
  if (known_value_unit(value) && are_value_words(key.words)) return take_value_unit(key, value, true);  // "Height: nm"
  const auto lengths = parse_header_lengths(value);
  if (!lengths || lengths->pixels) return false;
  const double unit = unit_of_lengths(key, value, *lengths);
  if (take_interval(key, *lengths, value)) return true;
  if (unit == 0.0) {
    layout_.add_counts(lengths->numbers,
                       fmt::format("{}: {} = '{}' is neither the number of rows or columns nor a length with a unit; "
                                   "write '# pitch_mm: 0.1'",
                                   place(), key.shown, value));
    return true;
  }
  const std::vector<double> mm = lengths->mm(unit);
  if (std::any_of(mm.begin(), mm.end(), [](double v) { return !(v > 0.0 && std::isfinite(v)); })) return false;
  only_once(key, MapTopic::Size);
  if (are_value_words(key.words) && mm.size() == 1) {
    layout_.question_height(
        fmt::format("{}: {} = '{}': the height of the field, or a step of the values? Write "
                    "'# pitch_mm: 0.1' and '# unit: nm'",
                    place(), key.shown, value));
  }
  const bool both = mm.size() > 1 || key.axis == 0;
  using Axis = SaidLayout::Axis;
  const auto set = [&](Axis axis, double size) {
    layout_.set(SaidLayout::What::Size, axis, {size, key.shown, lengths->rounding}, place());
  };
  if (both || key.axis == 'x') set(Axis::X, mm.front());
  if (both || key.axis == 'y') set(Axis::Y, mm.back());
  return true;
}

/// "xmin = -25": without a unit; 0 is where maps begin.
bool TextHeader::take_start(const HeaderKey& key, std::string_view value) {
  const auto number = finite_number(value);
  return number && *number != 0.0 && take_offset(key, value, false);
}

/// "x range: -25 25": from where to where, along one axis.
bool TextHeader::take_interval(const HeaderKey& key, const HeaderLengths& lengths, std::string_view value) {
  if (lengths.numbers.size() != 2 || !key.has("range")) return false;
  if (lengths.numbers.front() != 0.0) {
    add_unclear(About::Origin, fmt::format("{} = '{}' looks like an origin; write '# origin_mm: x,y', the centre of "
                                           "the first pixel",
                                           key.shown, value));
  }
  return true;
}

bool TextHeader::take_origin(const HeaderKey& key, std::string_view value, bool sure) {
  const auto lengths = parse_header_lengths(value);
  const char* const required = "two finite numbers x,y, in mm or with a unit,";
  if (!lengths || lengths->pixels) {
    const bool says_nothing = value.find_first_of("0123456789") == std::string_view::npos && key.unit.empty();
    if (sure && !says_nothing) refuse(key, value, required);
    return false;
  }
  const double unit = unit_of_lengths(key, value, *lengths);
  if (unit == 0.0 && !sure) return false;
  if ((key.axis == 0) != (lengths->numbers.size() == 2)) refuse(key, value, required);
  only_once(key, MapTopic::Origin);
  if (unit == 0.0) {
    add_unclear(About::Origin, fmt::format("{} = '{}' looks like an origin without a unit; write '# origin_mm: x,y', "
                                           "the centre of the first pixel",
                                           key.shown, value));
    return true;
  }
  const std::vector<double> mm = lengths->mm(unit);
  if (std::any_of(mm.begin(), mm.end(), [](double v) { return !std::isfinite(v); })) refuse(key, value, required);
  using Axis = SaidLayout::Axis;
  if (key.axis != 'y') layout_.set(SaidLayout::What::Origin, Axis::X, {mm.front(), key.shown}, place());
  if (key.axis != 'x') layout_.set(SaidLayout::What::Origin, Axis::Y, {mm.back(), key.shown}, place());
  return true;
}

/// Of an offset, a corner, a centre or an extent nobody knows whether it is that of a pixel's centre, its edge, or of
/// the heights.
bool TextHeader::take_offset(const HeaderKey& key, std::string_view value, bool moves) {
  constexpr std::size_t kMostNumbers = 6;
  const auto lengths = parse_header_lengths(value, kMostNumbers);
  if (!lengths) return false;
  const auto& numbers = lengths->numbers;
  if (moves && std::all_of(numbers.begin(), numbers.end(), [](double v) { return v == 0.0; })) return true;
  add_unclear(moves ? About::Shift : About::Origin,
              fmt::format("{} = '{}' looks like an origin; write '# origin_mm: x,y', the centre of the "
                          "first pixel",
                          key.shown, value));
  return true;
}

}  // namespace dwell
