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
#include "core/formats/said_factor.h"
#include "core/formats/said_orientation.h"
#include "core/formats/said_wavelength.h"
#include "core/formats/text_comment.h"
#include "core/formats/wavefront_words.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using About = UnclearStatement::About;

/// The colon and the equals sign of Chinese and Japanese keyboards as those of ASCII.
std::string with_plain_colons(std::string_view text) {
  std::string plain(text);
  for (const auto& [wide, narrow] : {std::pair("\xef\xbc\x9a", ":"), std::pair("\xef\xbc\x9d", "=")}) {
    const std::string_view sign = wide;
    for (std::size_t at = 0; (at = plain.find(sign, at)) != std::string::npos;) plain.replace(at, sign.size(), narrow);
  }
  return plain;
}

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

void TextHeader::read_comment(std::string_view text, long line) {
  line_ = line;
  const std::string plain = with_plain_colons(bare_comment(text));
  const std::string_view comment = plain;
  if (const std::size_t colon = comment.find(':');
      colon != std::string_view::npos && trim(comment.substr(0, colon)) == "made") {
    const std::string_view step = trim(comment.substr(colon + 1));
    if (!step.empty()) header_.history.emplace_back(step);
    return;
  }
  note_wavefront(comment, place(), in_quotes(comment), header_);
  if (known_value_unit(comment) || is_optical_unit(comment)) return take_unit(comment, "the comment");
  if (read_tabbed(comment)) return;
  for (const std::string& statement : header_statements(comment)) read_statement(statement);
}

/// "unit<tab>um", as spreadsheets part names and values.
bool TextHeader::read_tabbed(std::string_view comment) {
  std::vector<std::string_view> fields = split(comment, '\t');
  std::erase_if(fields, [](std::string_view field) { return trim(field).empty(); });
  std::vector<std::string_view> rest;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    HeaderKey key = parse_header_key(fields[i]);
    const bool pair = i + 1 < fields.size() && fields[i].find_first_of(":=") == std::string_view::npos &&
                      meaning_of(key).trust == InText::Sure && take(key, trim(fields[i + 1]), false);
    if (pair) {
      ++i;
    } else {
      rest.push_back(fields[i]);
    }
  }
  if (rest.size() == fields.size()) return false;
  for (const std::string_view field : rest) {
    for (const std::string& statement : header_statements(field)) read_statement(statement);
  }
  return true;
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

/// Whether it was a statement, or something that is now kept as unclear. With `loose` there was no ':' or '=', so that
/// the line may be prose.
bool TextHeader::take(HeaderKey key, std::string_view value, bool loose) {
  if (add_wavelength(key, value, fmt::format("line {}", line_), header_)) return true;
  if (!loose && take_axis_claim(key, value)) return true;
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
      if (meaning.moves || meaning.trust == InText::Doubtful) return take_offset(key, value, meaning.moves);
      if (take_origin(key, value, sure && !prose)) return true;
      return !loose && key.axis != 0 && take_start(key, value);  // "xmin = -25", without a unit
    case MapTopic::NoData:
      return take_no_data(key, value, sure && !loose, sure);
    case MapTopic::ValueScale:
      return take_scale(key, value, loose);
    case MapTopic::Orientation:
    case MapTopic::AxisOrder:
      return !loose && take_orientation(key, value, meaning.topic);
    default:
      return false;
  }
}

/// "y_up: false".
bool TextHeader::take_axis_claim(const HeaderKey& key, std::string_view value) {
  const auto claim = read_axis_claim(key.shown, value);
  if (!claim || claim->usual) return claim.has_value();
  const bool sign = claim->axis == 'z';
  add_unclear(sign ? About::Factor : About::Axes,
              fmt::format("{} = '{}' looks like {}", key.shown, value,
                          sign ? "a sign of the values; those that are positive are taken for material to remove"
                               : "an orientation; x is taken to point to the right and y up"));
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

bool TextHeader::take_scale(const HeaderKey& key, std::string_view value, bool loose) {
  const auto words = words_of(value);
  if (words.empty()) return false;
  const auto number = finite_number(words.front());
  // A sign, a prefix or a norm may be a word; without a ':' that is prose.
  const std::vector<double> numbers = number ? std::vector<double>{*number} : std::vector<double>{};
  const std::vector<std::string> texts =
      number ? std::vector<std::string>{} : std::vector<std::string>{std::string(value)};
  if (!number && (loose || !may_be_a_word(key.stem))) return false;
  if (words.size() == 1 && key.unit.empty() && (leaves_heights(key.stem, numbers, texts) || number == 0.0)) return true;
  add_unclear(About::Factor, fmt::format("{} = '{}' looks like a factor of the values; write the values without it and "
                                         "their unit, '# unit: nm'",
                                         key.shown, value));
  return true;
}

/// "orientation = 3", "y axis: down", "order: F".
bool TextHeader::take_orientation(const HeaderKey& key, std::string_view value, MapTopic topic) {
  const std::string text(value);
  const bool order = topic == MapTopic::AxisOrder;
  const AxisOrder read = order ? read_axis_order({text}, {}) : AxisOrder::RowsFirst;
  if (order && read == AxisOrder::Unknown) return false;
  const bool direction = names_a_direction(key.shown) && (key.axis == 'x' || key.axis == 'y');
  const char axis = direction ? key.axis : '\0';
  const bool usual = order ? read == AxisOrder::RowsFirst : is_usual_orientation(value, axis);
  const bool speed = value.find("rpm") != std::string_view::npos || value.find('/') != std::string_view::npos;
  if (usual || value.empty() || speed) return usual;
  add_unclear(order ? About::Rows : About::Axes,
              fmt::format("{} = '{}' looks like an orientation; the first row is taken for that of the smallest y, the "
                          "first column for that of the smallest x; turn the map so and leave the comment out",
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
