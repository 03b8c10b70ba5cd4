#include "core/formats/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/header_statements.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using About = UnclearStatement::About;

constexpr double kSameStatement = 1e-9;  // relative difference up to which two statements agree
constexpr const char* kAcceptedUnits = "a unit of height (nm, um, mm, m) or of rate (nm/s, um/s, um/min, m/s)";

bool agrees(double a, double b, double rounding = kSameStatement) {
  return std::abs(a - b) <= std::max(rounding, kSameStatement) * std::max(std::abs(a), std::abs(b));
}

}  // namespace

std::string TextHeader::place() const { return fmt::format("{}, line {}", where_, line_); }

void TextHeader::set_line(long line) { line_ = line; }

void TextHeader::add_unclear(About about, const std::string& message) {
  header_.unclear.push_back({about, fmt::format("{}: {}", place(), message)});
}

void TextHeader::refuse(const HeaderKey& key, std::string_view value, const std::string& required) const {
  throw InputError(fmt::format("{}: {} = '{}'; {} required", place(), key.shown, value, required));
}

void TextHeader::only_once(const HeaderKey& key, HeaderRole role) {
  const std::string name = fmt::format("{} {} {}", static_cast<int>(role), key.axis, lower_case(key.shown));
  if (!seen_.emplace(name, line_).second) {
    throw InputError(fmt::format("{}: {} is given a second time; once is accepted", place(), key.shown));
  }
}

void TextHeader::read_comment(std::string_view comment, long line) {
  line_ = line;
  while (!comment.empty() && comment.front() == '#') comment = trim(comment.substr(1));
  if (comment.size() > 1 && comment.front() == '"' && comment.back() == '"') {
    comment = trim(comment.substr(1, comment.size() - 2));
  }
  if (const std::size_t colon = comment.find(':');
      colon != std::string_view::npos && trim(comment.substr(0, colon)) == "made") {
    const std::string_view step = trim(comment.substr(colon + 1));
    if (!step.empty()) header_.history.emplace_back(step);
    return;
  }
  if (is_optical_unit(comment))
    throw InputError(fmt::format("{}: {}; {} required", place(), in_quotes(comment), kAcceptedUnits));
  if (known_value_unit(comment)) return take_unit(comment, "the comment");
  for (const std::string& statement : header_statements(comment)) read_statement(statement);
}

/// "key: value", "key = value", or words alone.
void TextHeader::read_statement(std::string_view text) {
  const std::size_t at = text.find_first_of(":=");
  if (at == std::string_view::npos) {
    if (!read_captions(text) && !read_loose(text)) note_mention(text);
    return;
  }
  const std::string_view value = trim(text.substr(at + 1));
  if (take(parse_header_key(text.substr(0, at)), value, false)) return;
  if (!read_captions(value) && !read_loose(value)) note_mention(text);
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
  if (key.axis == 'x' || key.axis == 'y') return take_lateral_unit(key.unit, key.shown);
  if (is_optical_unit(key.remark)) refuse(key, key.remark, kAcceptedUnits);
  take_unit(key.unit, key.shown);
  if (key.every_axis) take_lateral_unit(key.unit, key.shown);
}

/// Whether it was a statement, or something that is now kept as unclear. With `loose` there was no ':' or '=', so that
/// the line may be prose.
bool TextHeader::take(HeaderKey key, std::string_view value, bool loose) {
  const HeaderMeaning meaning = meaning_of(key);
  if (key.stem == "channel" || key.stem == "valueunits") gwyddion_ = true;
  constexpr std::size_t kWordsOfProse = 2;
  const auto words = words_of(value);
  const bool prose = loose && words.size() >= kWordsOfProse;
  const bool sure = meaning.sure && !prose;
  switch (meaning.role) {
    case HeaderRole::None:
      return false;
    case HeaderRole::Unit:
      if (take_value_unit(key, value, sure)) return true;
      if (!(prose && meaning.sure && known_value_unit(words.front()))) return false;
      add_unclear(About::Unit, fmt::format("{} looks like the unit of the values; write '# unit: um'",
                                           in_quotes(key.shown + " " + std::string(value))));
      return true;
    case HeaderRole::LateralUnit:
      return take_lateral(key, value, sure);
    case HeaderRole::Pitch:
      if (take_pitch(key, value, sure)) return true;
      if (!(prose && meaning.sure && holds_a_length(value))) return false;
      add_unclear(About::Pitch, fmt::format("{} looks like a pixel pitch; write '# pitch_mm: 0.1'",
                                            in_quotes(key.shown + " " + std::string(value))));
      return true;
    case HeaderRole::Size:
      return take_size(key, value);
    case HeaderRole::Origin:
      return take_origin(key, value, sure);
    case HeaderRole::Offset:
      return take_offset(key, value);
    case HeaderRole::NoData:
      return take_no_data(key, value, sure);
    case HeaderRole::Scale:
      return take_scale(key, value);
  }
  return false;
}

void TextHeader::take_unit(std::string_view unit, const std::string& key) {
  const auto factor = known_value_unit(unit);
  if (!factor) throw InputError(fmt::format("{}: {} = '{}'; {} required", place(), key, unit, kAcceptedUnits));
  const bool rate = !known_length_unit(unit), rate_before = header_.unit && !known_length_unit(*header_.unit);
  if (header_.unit && (!agrees(*factor, *unit_factor_) || rate != rate_before)) {
    throw InputError(fmt::format("{}: {} says '{}', but {} = '{}' above; they must agree", place(), key, unit,
                                 unit_key_, *header_.unit));
  }
  if (header_.unit) return;
  header_.unit = std::string(unit);
  unit_factor_ = factor;
  unit_key_ = key;
}

bool TextHeader::take_value_unit(const HeaderKey& key, std::string_view value, bool sure) {
  if (known_value_unit(value)) {
    only_once(key, HeaderRole::Unit);
    take_unit(value, key.shown);
    if (key.every_axis) take_lateral_unit(value, key.shown);
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
  if (lateral_ && !agrees(*lateral_, *length)) {
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
  if (key.length && lengths.length && !agrees(*key.length, *lengths.length)) {
    refuse(key, value, fmt::format("numbers in {}", key.unit));
  }
  return lengths.length.value_or(key.length.value_or(0.0));
}

void TextHeader::set_length(std::optional<Length>& slot, const Length& length, const char* what) {
  if (slot && !agrees(slot->mm, length.mm, slot->rounding + length.rounding)) {
    throw InputError(fmt::format("{}: {} gives a {} of {} mm, but {} above {} mm; they must agree", place(), length.key,
                                 what, length.mm, slot->key, slot->mm));
  }
  if (!slot) slot = length;
}

bool TextHeader::take_pitch(const HeaderKey& key, std::string_view value, bool sure) {
  const auto lengths = parse_header_lengths(value);
  const char* const required = "one finite number > 0, or two (x,y) separated by a comma, in mm or with a unit,";
  if (!lengths || lengths->pixels) {
    if (sure) refuse(key, value, required);
    return false;
  }
  const double unit = unit_of_lengths(key, value, *lengths);
  if (unit == 0.0 && !sure) return false;
  const std::vector<double> mm = lengths->mm(unit);
  if (std::any_of(mm.begin(), mm.end(), [](double v) { return !(v > 0.0 && std::isfinite(v)); }) ||
      (key.axis != 0 && mm.size() > 1 && unit > 0.0)) {
    if (unit > 0.0) refuse(key, value, required);
  }
  only_once(key, HeaderRole::Pitch);
  if (unit == 0.0 || key.stem == "resolution") {
    add_unclear(About::Pitch,
                fmt::format("{} = '{}' looks like a pixel pitch{}; write '# pitch_mm: 0.1', or the number with its "
                            "unit: '# pitch: 100 um'",
                            key.shown, value, unit == 0.0 ? " without a unit" : ""));
    return true;
  }
  const bool along_x = key.axis != 'y' || mm.size() > 1, along_y = key.axis != 'x' || mm.size() > 1;
  if (along_x) set_length(pitch_[0], {mm.front(), key.shown}, "pitch in x");
  if (along_y) set_length(pitch_[1], {mm.back(), key.shown}, "pitch in y");
  return true;
}

bool TextHeader::take_size(const HeaderKey& key, std::string_view value) {
  if (known_value_unit(value) && are_value_words(key.words)) return take_value_unit(key, value, true);  // "Height: nm"
  const auto lengths = parse_header_lengths(value);
  if (!lengths || lengths->pixels) return false;
  const double unit = unit_of_lengths(key, value, *lengths);
  if (unit == 0.0) {
    counts_.push_back({lengths->numbers,
                       fmt::format("{}: {} = '{}' is neither the number of rows or columns nor a length with a unit; "
                                   "write '# pitch_mm: 0.1'",
                                   place(), key.shown, value)});
    return true;
  }
  const std::vector<double> mm = lengths->mm(unit);
  if (std::any_of(mm.begin(), mm.end(), [](double v) { return !(v > 0.0 && std::isfinite(v)); })) return false;
  only_once(key, HeaderRole::Size);
  const bool both = mm.size() > 1 || key.axis == 0;
  if (both || key.axis == 'x') set_length(size_[0], {mm.front(), key.shown, lengths->rounding}, "width");
  if (both || key.axis == 'y') set_length(size_[1], {mm.back(), key.shown, lengths->rounding}, "height");
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
  only_once(key, HeaderRole::Origin);
  if (unit == 0.0) {
    add_unclear(About::Origin, fmt::format("{} = '{}' looks like an origin without a unit; write '# origin_mm: x,y', "
                                           "the centre of the first pixel",
                                           key.shown, value));
    return true;
  }
  const std::vector<double> mm = lengths->mm(unit);
  if (std::any_of(mm.begin(), mm.end(), [](double v) { return !std::isfinite(v); })) refuse(key, value, required);
  if (key.axis != 'y') set_length(origin_[0], {mm.front(), key.shown}, "origin in x");
  if (key.axis != 'x') set_length(origin_[1], {mm.back(), key.shown}, "origin in y");
  return true;
}

/// Of an offset nobody knows whether it is that of a pixel's centre, its corner, or of the heights.
bool TextHeader::take_offset(const HeaderKey& key, std::string_view value) {
  const auto lengths = parse_header_lengths(value);
  if (!lengths || lengths->pixels) return false;
  const auto& numbers = lengths->numbers;
  if (std::all_of(numbers.begin(), numbers.end(), [](double v) { return v == 0.0; })) return true;
  add_unclear(About::Origin, fmt::format("{} = '{}' looks like an origin; write '# origin_mm: x,y', the centre of the "
                                         "first pixel",
                                         key.shown, value));
  return true;
}

bool TextHeader::take_no_data(const HeaderKey& key, std::string_view value, bool sure) {
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
  if (!sure) {
    add_unclear(About::NoData,
                fmt::format("{} = '{}' looks like a value for no data; write '# nodata: {}'", key.shown, value, value));
    return true;
  }
  only_once(key, HeaderRole::NoData);
  header_.no_data.insert(header_.no_data.end(), numbers.begin(), numbers.end());
  return true;
}

bool TextHeader::take_scale(const HeaderKey& key, std::string_view value) {
  const auto words = words_of(value);
  const auto number = words.empty() ? std::nullopt : finite_number(words.front());
  if (!number) return false;
  if (words.size() == 1 && key.unit.empty() && (*number == 1.0 || *number == 0.0)) return true;
  add_unclear(About::Unit, fmt::format("{} = '{}' looks like a factor of the values; write their unit, '# unit: nm'",
                                       key.shown, value));
  return true;
}

void TextHeader::note_mention(std::string_view text) {
  if (!mentions_value_unit(text) && !is_caption_with_unit(text)) return;
  add_unclear(About::Unit, fmt::format("{} looks like the unit of the values; write '# unit: um', or the comment "
                                       "without a unit",
                                       in_quotes(text)));
}

void TextHeader::add_counts(MapHeader& header, Index rows, Index cols) const {
  for (const Count& count : counts_) {
    const bool all = std::all_of(count.numbers.begin(), count.numbers.end(), [&](double number) {
      return number == static_cast<double>(rows) || number == static_cast<double>(cols) ||
             number == static_cast<double>(rows * cols);
    });
    if (!all) header.unclear.push_back({About::Pitch, count.message});
  }
}

/// The pitch from the size of the field. Gwyddion's is that of all pixels from edge to edge; of another program it may
/// be the distance between the first and the last.
void TextHeader::add_size(MapHeader& header, Index rows, Index cols) const {
  if (!size_[0] && !size_[1]) return;
  if (!gwyddion_ || !size_[0] || !size_[1]) {
    const Length& size = size_[0] ? *size_[0] : *size_[1];
    header.unclear.push_back(
        {About::Pitch, fmt::format("{}: {} = {} mm: over all pixels, or from the first to the last? Write "
                                   "'# pitch_mm: 0.1'",
                                   where_, size.key, size.mm)});
    return;
  }
  const Point pitch{size_[0]->mm / static_cast<double>(cols), size_[1]->mm / static_cast<double>(rows)};
  const double rounding = std::max({size_[0]->rounding, size_[1]->rounding, kSameStatement});
  if (!header.pitch) {
    header.pitch = pitch;
    header.pitch_rounding = rounding;
  } else if (!agrees(header.pitch->x, pitch.x, rounding) || !agrees(header.pitch->y, pitch.y, rounding)) {
    throw InputError(fmt::format("{}: {} and {} say a pitch of {} x {} mm, but {} says {} x {} mm; they must agree",
                                 where_, size_[0]->key, size_[1]->key, pitch.x, pitch.y, pitch_[0]->key,
                                 header.pitch->x, header.pitch->y));
  }
}

MapHeader TextHeader::header_of_points() const {
  MapHeader header = header_;
  const auto both = [&](const std::optional<Length>(&pair)[2], About about, const char* what) -> std::optional<Point> {
    if (pair[0] && pair[1]) return Point{pair[0]->mm, pair[1]->mm};
    if (pair[0] || pair[1]) {
      const std::string& key = (pair[0] ? pair[0] : pair[1])->key;
      header.unclear.push_back(
          {about, fmt::format("{}: {} says the {} in one direction only; both are required", where_, key, what)});
    }
    return std::nullopt;
  };
  header.pitch = both(pitch_, About::Pitch, "pitch");
  header.origin = both(origin_, About::Origin, "origin");
  return header;
}

MapHeader TextHeader::header_of_matrix(Index rows, Index cols) const {
  MapHeader header = header_of_points();
  add_size(header, rows, cols);
  add_counts(header, rows, cols);
  if (lateral_ && !agrees(*lateral_, units::kNmPerMm)) {
    header.unclear.push_back(
        {About::Pitch, fmt::format("{}: {} is not mm; write '# pitch_mm: 0.1'", where_, lateral_key_)});
  }
  return header;
}

}  // namespace dwell
