#include "core/formats/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/formats/header_statements.h"
#include "core/formats/remark_guard.h"
#include "core/formats/said_wavelength.h"
#include "core/formats/text_comment.h"
#include "core/formats/wavefront_words.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using About = UnclearStatement::About;

constexpr const char* kAcceptedUnits = "a unit of height (nm, um, mm, m, waves) or of rate (nm/s, um/s, um/min, m/s)";

/// Text behind a name whose value should be a number: "Gugolz 64" behind a pitch is what polishes.
bool begins_with_a_letter(std::string_view text) {
  const char c = text.empty() ? ' ' : text.front();
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Whether a name that holds or has a unit is of the heights alone: "height unit", "z", but not "values" or "unit".
bool names_heights(const std::string& shown) {
  constexpr std::array<std::string_view, 9> kAnything{"data",  "value",  "values",  "daten",  "wert",
                                                      "werte", "valeur", "valeurs", "donnees"};
  const HeaderKey key = parse_header_key(shown);
  return key.axis == 'z' || std::any_of(key.words.begin(), key.words.end(), [&](const std::string& word) {
           return is_value_word(word) && !is_among(word, kAnything);
         });
}

/// The names of the program's own files, whose two numbers stand beside a comma without a blank.
bool is_documented(const HeaderKey& key) { return key.shown == "pitch_mm" || key.shown == "origin_mm"; }

}  // namespace

std::string TextHeader::place() const { return fmt::format("{}, line {}", where_, line_); }

void TextHeader::add_unclear(About about, const std::string& message) {
  header_.unclear.push_back({about, fmt::format("{}: {}", place(), message)});
}

void TextHeader::refuse(const HeaderKey& key, std::string_view value, const std::string& required) const {
  throw InputError(fmt::format("{}: {} = '{}'; {} required", place(), key.shown, value, required));
}

void TextHeader::only_once(const HeaderKey& key, MapTopic topic) {
  const std::string name = fmt::format("{} {} {}", static_cast<int>(topic), key.axis, lower_case(key.shown));
  if (!seen_.emplace(name, line_).second) {
    throw InputError(fmt::format("{}: {} is given a second time; once is accepted", place(), key.shown));
  }
}

void TextHeader::read_comment(std::string_view comment, long line) {
  line_ = line;
  comment = bare_comment(comment);
  if (const std::size_t colon = comment.find(':');
      colon != std::string_view::npos && trim(comment.substr(0, colon)) == "made") {
    const std::string_view step = trim(comment.substr(colon + 1));
    if (!step.empty()) header_.history.emplace_back(step);
    return;
  }
  note_wavefront(comment, place(), in_quotes(comment), header_);
  if (known_value_unit(comment) || is_optical_unit(comment)) return take_unit(comment, "the comment");
  for (const std::string& statement : header_statements(comment)) read_statement(statement);
}

/// "key: value", "key = value", "key,value" of spreadsheets, or words alone.
void TextHeader::read_statement(std::string_view text) {
  const std::size_t at = text.find_first_of(":=");
  if (at == std::string_view::npos) {
    if (!read_captions(text) && !read_fields(text) && !read_loose(text)) guard(text);
    return;
  }
  const std::string_view value = trim(text.substr(at + 1));
  if (take(parse_header_key(text.substr(0, at)), value, false)) return;
  if (!read_captions(value) && !read_loose(value)) guard(text);
}

bool TextHeader::read_fields(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return false;
  HeaderKey key = parse_header_key(text.substr(0, comma));
  return meaning_of(key).trust == InText::Sure && take(key, trim(text.substr(comma + 1)), false);
}

void TextHeader::guard(std::string_view text) {
  const std::vector<UnclearStatement> unclear = unclear_remarks(text, place());
  header_.unclear.insert(header_.unclear.end(), unclear.begin(), unclear.end());
}

bool TextHeader::read_captions(std::string_view text) {
  const std::vector<HeaderKey> captions = header_captions(text);
  for (const HeaderKey& caption : captions) take_caption(caption);
  return !captions.empty();
}

/// "unit um", "pixel size 0.25 mm", "heights in um": the longest beginning that is a name with a value that fits.
bool TextHeader::read_loose(std::string_view text) {
  constexpr std::size_t kLongestName = 6;
  const auto words = words_of(text);
  for (std::size_t n = std::min(words.size(), kLongestName); n > 0; --n) {
    const auto end = static_cast<std::size_t>(words[n - 1].data() + words[n - 1].size() - text.data());
    if (n < words.size() && take(parse_header_key(text.substr(0, end)), trim(text.substr(end)), true)) return true;
  }
  return false;
}

void TextHeader::take_caption(const HeaderKey& key) {
  if (key.axis == 'x' || key.axis == 'y' || speaks_of_coordinates(key)) return take_lateral_unit(key.unit, key.shown);
  if (is_wave_unit(key.remark)) return take_unit(key.remark, key.shown);
  if (is_optical_unit(key.remark)) refuse(key, key.remark, kAcceptedUnits);
  take_unit(key.unit, key.shown);
  if (key.every_axis || speaks_of_everything(key)) take_lateral_unit(key.unit, key.shown);
}

/// Whether it was a statement, or something that is now kept as unclear. With `loose` there was no ':' or '=', so that
/// the line may be prose.
bool TextHeader::take(HeaderKey key, std::string_view value, bool loose) {
  if (add_wavelength(key, value, fmt::format("line {}", line_), header_)) return true;
  const HeaderMeaning meaning = meaning_of(key);
  if (key.stem == "channel" || key.stem == "valueunits") layout_.set_gwyddion();
  constexpr std::size_t kWordsOfProse = 2;
  const bool prose = loose && words_of(value).size() >= kWordsOfProse;
  const bool sure = meaning.trust == InText::Sure;
  switch (meaning.topic) {
    case MapTopic::ValueUnit:
      return take_value_unit(key, value, sure && !prose) || (prose && sure && take_unknown_unit(key, value));
    case MapTopic::UnknownUnit:
      return take_unknown_unit(key, value);
    case MapTopic::LateralUnit:
      return take_lateral(key, value, sure && !prose);
    case MapTopic::Pitch:
      return take_pitch(key, value, loose ? InText::Fits : meaning.trust) ||
             (prose && sure && take_prose_pitch(key, value));
    case MapTopic::Size:
      // "height [10 nm]" gives the values in steps of 10 nm.
      return !(loose && value.find_first_of("([") == 0) && take_size(key, value);
    case MapTopic::Origin:
      return meaning.moves || meaning.trust == InText::Doubtful ? take_offset(key, value, meaning.moves)
                                                                : take_origin(key, value, sure && !prose);
    case MapTopic::NoData:
      return take_no_data(key, value, sure && !loose, sure);
    case MapTopic::ValueScale:
      return take_scale(key, value);
    default:
      return false;
  }
}

/// "unit um of the surface", "laser unit: um".
bool TextHeader::take_unknown_unit(const HeaderKey& key, std::string_view value) {
  const auto words = words_of(value);
  if (words.empty() || !known_value_unit(words.front())) return false;
  add_unclear(About::Unit, fmt::format("{} looks like the unit of the values; write '# unit: um'",
                                       in_quotes(key.shown + " " + std::string(value))));
  return true;
}

/// "the pixel pitch was found to be 0.25 mm".
bool TextHeader::take_prose_pitch(const HeaderKey& key, std::string_view value) {
  if (!holds_a_length(value)) return false;
  add_unclear(About::Pitch, fmt::format("{} looks like a pixel pitch; write '# pitch_mm: 0.1'",
                                        in_quotes(key.shown + " " + std::string(value))));
  return true;
}

void TextHeader::take_unit(std::string_view unit, const std::string& key) {
  const auto factor = is_wave_unit(unit) ? std::optional(0.0) : known_value_unit(unit);
  if (!factor) throw InputError(fmt::format("{}: {} = '{}'; {} required", place(), key, unit, kAcceptedUnits));
  const bool rate = known_rate_unit(unit).has_value(), rate_before = header_.unit && known_rate_unit(*header_.unit);
  if (header_.unit && (!statements_agree(*factor, *unit_factor_) || rate != rate_before)) {
    throw InputError(fmt::format("{}: {} says '{}', but {} = '{}' above; they must agree", place(), key, unit,
                                 unit_key_, *header_.unit));
  }
  if (header_.unit) return;
  // Over points it may be the unit of x and y too: of m or inches, which heights seldom are in, or of a huge part.
  if (!rate && *factor != units::kNmPerMm && !names_heights(key)) {
    of_everything_ =
        fmt::format("{}: {} in '{}': of x and y too? Name the columns as 'x_mm y_mm z_{}'", place(), key, unit, unit);
  }
  header_.unit = std::string(unit);
  unit_factor_ = factor;
  unit_key_ = key;
}

bool TextHeader::take_value_unit(const HeaderKey& key, std::string_view value, bool sure) {
  if (known_value_unit(value) || is_wave_unit(value)) {
    only_once(key, MapTopic::ValueUnit);
    take_unit(value, key.shown);
    if (key.every_axis || fold_letters(key.shown).starts_with("all")) take_lateral_unit(value, key.shown);
    return true;
  }
  if (sure || is_optical_unit(value) || is_optical_unit(key.remark)) refuse(key, value, kAcceptedUnits);
  return false;
}

void TextHeader::take_lateral_unit(std::string_view unit, const std::string& key) {
  const auto length = known_length_unit(unit);
  if (!length) {
    throw InputError(fmt::format("{}: {} in '{}'; a unit of length (mm, um, m) is required", place(), key, unit));
  }
  if (lateral_ && !statements_agree(*lateral_, *length)) {
    throw InputError(
        fmt::format("{}: {} in '{}', but {} in another unit; they must agree", place(), key, unit, lateral_key_));
  }
  lateral_ = length;
  lateral_key_ = key;
}

bool TextHeader::take_lateral(const HeaderKey& key, std::string_view value, bool sure) {
  if (known_length_unit(value)) {
    take_lateral_unit(value, key.shown);
    return true;
  }
  if (sure) refuse(key, value, "a unit of length (mm, um, m)");
  return false;
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
  const bool both = mm.size() > 1 || key.axis == 0;
  using Axis = SaidLayout::Axis;
  const auto set = [&](Axis axis, double size) {
    layout_.set(SaidLayout::What::Size, axis, {size, key.shown, lengths->rounding}, place());
  };
  if (both || key.axis == 'x') set(Axis::X, mm.front());
  if (both || key.axis == 'y') set(Axis::Y, mm.back());
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
  add_unclear(About::Origin, fmt::format("{} = '{}' looks like an origin; write '# origin_mm: x,y', the centre of the "
                                         "first pixel",
                                         key.shown, value));
  return true;
}

/// `sure`: refused if it does not fit; `named`: honoured if it does.
bool TextHeader::take_no_data(const HeaderKey& key, std::string_view value, bool sure, bool named) {
  std::vector<double> numbers;
  bool understood = !value.empty() || !sure;
  for (const std::string_view field : split(value, ',')) {
    const auto number = height_number(field);
    const std::string word = lower_case(trim(field));
    understood = understood && (number || word == "none" || word == "no");
    if (number && std::isfinite(*number)) numbers.push_back(*number);
  }
  if (!understood) {
    if (sure) refuse(key, value, "a finite number, as the map holds it, or nan,");
    return false;
  }
  if (numbers.empty()) return true;
  if (!named) {
    add_unclear(About::NoData,
                fmt::format("{} = '{}' looks like a value for no data; write '# nodata: {}'", key.shown, value, value));
    return true;
  }
  only_once(key, MapTopic::NoData);
  header_.no_data.insert(header_.no_data.end(), numbers.begin(), numbers.end());
  return true;
}

bool TextHeader::take_scale(const HeaderKey& key, std::string_view value) {
  const auto words = words_of(value);
  const auto number = words.empty() ? std::nullopt : finite_number(words.front());
  if (!number) return false;
  if (words.size() == 1 && key.unit.empty() && (*number == 1.0 || *number == 0.0)) return true;
  add_unclear(About::Factor, fmt::format("{} = '{}' looks like a factor of the values; write the values without it and "
                                         "their unit, '# unit: nm'",
                                         key.shown, value));
  return true;
}

MapHeader TextHeader::header_of_points(bool huge) const {
  MapHeader header = header_;
  layout_.add_to(header);
  header.places_known = lateral_.has_value();
  const bool asked = !of_everything_.empty() && (*unit_factor_ > units::kNmPerMm || huge);
  if (!lateral_ && asked) header.unclear.push_back({About::Places, of_everything_});
  return header;
}

MapHeader TextHeader::header_of_matrix(Index rows, Index cols) const {
  MapHeader header = header_of_points(false);
  layout_.add_sizes(header, rows, cols);
  if (lateral_ && !statements_agree(*lateral_, units::kNmPerMm)) {
    header.unclear.push_back(
        {About::Pitch, fmt::format("{}: {} is not mm; write '# pitch_mm: 0.1'", where_, lateral_key_)});
  }
  return header;
}

}  // namespace dwell
