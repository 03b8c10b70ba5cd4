#include "core/formats/fits_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/formats/field_name.h"
#include "core/formats/remark_guard.h"
#include "core/formats/said_orientation.h"
#include "core/formats/said_wavelength.h"
#include "core/formats/wavefront_words.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

/// The keywords of the image that is open.
class Keywords {
 public:
  Keywords(fitsfile* file, const std::string& where) : file_(file), where_(where) {}

  std::optional<double> number(const std::string& name) const {
    double value = 0.0;
    int status = 0;
    fits_read_key(file_, TDOUBLE, name.c_str(), &value, nullptr, &status);
    if (absent(status)) return std::nullopt;
    if (status != 0) refuse(name, fits_message(status), "a number is required");
    if (!std::isfinite(value)) refuse(name, fmt::format("{}", value), "a finite number is required");
    return value;
  }
  std::optional<std::string> text(const std::string& name) const {
    char* value = nullptr;
    int status = 0;
    fits_read_key_longstr(file_, name.c_str(), &value, nullptr, &status);
    const std::string found = value ? value : "";
    std::free(value);
    if (absent(status)) return std::nullopt;
    if (status != 0) refuse(name, fits_message(status), "a text is required");
    return std::string(trim(found));
  }
  [[noreturn]] void refuse(const std::string& name, const std::string& value, const char* required) const {
    throw InputError(fmt::format("{}: FITS keyword {} = {}; {}", where_, name, value, required));
  }
  fitsfile* file() const { return file_; }

 private:
  static bool absent(int status) {
    if (status != KEY_NO_EXIST && status != VALUE_UNDEFINED) return false;
    fits_clear_errmsg();
    return true;
  }
  fitsfile* file_;
  const std::string& where_;
};

/// One axis as the keywords of world coordinates describe it.
struct LinearAxis {
  double pitch = 0.0, origin = 0.0;  // [mm]
};

/// The step along an axis and its keyword; nothing if there is none.
std::optional<std::pair<std::string, double>> step_of(const Keywords& keywords, const std::string& n) {
  for (const std::string& name : {"CDELT" + n, fmt::format("CD{}_{}", n, n)}) {
    if (const auto step = keywords.number(name)) return std::pair{name, *step};
  }
  return std::nullopt;
}

/// Axes of the map must be those of the image.
void check_not_turned(const Keywords& keywords) {
  for (const std::string name : {"CD1_2", "CD2_1", "PC1_2", "PC2_1", "CROTA1", "CROTA2"}) {
    const double across = keywords.number(name).value_or(0.0);
    if (across != 0.0) keywords.refuse(name, fmt::format("{}", across), "0 (axes along x and y) is required");
  }
  for (const std::string name : {"PC1_1", "PC2_2"}) {
    const double along = keywords.number(name).value_or(1.0);
    if (along != 1.0) keywords.refuse(name, fmt::format("{}", along), "1 (the step is in CDELT) is required");
  }
}

/// Nothing if it is not in a unit of length: the angles of the sky are no pitch.
std::optional<LinearAxis> axis(const Keywords& keywords, int number) {
  const std::string n = std::to_string(number);
  const auto nm = known_length_unit(keywords.text("CUNIT" + n).value_or(""));
  if (!nm) return std::nullopt;
  const auto step = step_of(keywords, n);
  if (!step) return std::nullopt;
  check_not_turned(keywords);
  const auto& [name, size] = *step;
  if (!(size > 0.0)) keywords.refuse(name, fmt::format("{}", size), "a step > 0 is required");
  const double mm = *nm / units::kNmPerMm;
  const double reference = keywords.number("CRPIX" + n).value_or(0.0);
  const double value = keywords.number("CRVAL" + n).value_or(0.0);
  const LinearAxis found{size * mm, (value + (1.0 - reference) * size) * mm};
  if (!std::isfinite(found.pitch) || !std::isfinite(found.origin)) {
    keywords.refuse(name, fmt::format("{}", size), "a pitch and an origin that are finite in mm are required");
  }
  return found;
}

/// A card of the header: name, value and comment.
struct Card {
  std::string name, value, comment;

  bool is_text() const { return value.starts_with('\''); }
  std::optional<double> number() const {
    std::string text = value;  // FITS may write 1.5D-3
    std::replace(text.begin(), text.end(), 'D', 'E');
    return finite_number(text);
  }
};

/// Keywords of the standard and of this program, which are read by name or say nothing of the map.
bool is_read_elsewhere(const std::string& name) {
  constexpr std::array kNames{"SIMPLE",  "BITPIX",   "NAXIS",   "EXTEND",   "XTENSION", "PCOUNT",  "GCOUNT", "BSCALE",
                              "BZERO",   "BLANK",    "ORIGIN",  "COMMENT",  "HISTORY",  "EXTNAME", "EXTVER", "DATAMIN",
                              "DATAMAX", "TIMEUNIT", "EQUINOX", "LONGSTRN", "CONTINUE", "END"};
  constexpr std::array kBeginnings{"NAXIS", "CDELT", "CUNIT", "CRPIX", "CRVAL", "CTYPE", "CROTA",
                                   "CD1_",  "CD2_",  "PC1_",  "PC2_",  "MADE",  "CNAME", "DATE"};
  return is_among(name, kNames) ||
         std::any_of(kBeginnings.begin(), kBeginnings.end(), [&](const char* b) { return name.starts_with(b); });
}

/// The unit of length in brackets at the beginning of a comment, "[mm] pitch" or "pixel scale [m/pix]", in mm.
std::optional<double> unit_of_comment(const std::string& comment) {
  const std::size_t open = comment.find('['), close = comment.find(']', open == std::string::npos ? 0 : open);
  if (open == std::string::npos || close == std::string::npos) return std::nullopt;
  std::string unit = comment.substr(open + 1, close - open - 1);
  for (const char* per : {"/pixel", "/pix", "/px", " per pixel"}) {
    if (unit.ends_with(per)) unit.resize(unit.size() - std::string_view(per).size());
  }
  const auto nm = known_length_unit(unit);
  return nm ? std::optional(*nm / units::kNmPerMm) : std::nullopt;
}

/// The same card as a field; nothing if neither its name nor its text can speak of a map.
std::optional<MapField> field_of_card(const Card& card, const Keywords& keywords) {
  const FieldName name = parse_field_name(card.name);
  const bool says_nothing = name.topic == MapTopic::Other && !name.place && !card.is_text() &&
                            !names_wavelength(card.name) &&
                            !read_axis_claim(card.name, card.value == "T"   ? "true"
                                                        : card.value == "F" ? "false"
                                                                            : card.value);
  if (is_read_elsewhere(card.name) || says_nothing) return std::nullopt;
  MapField field;
  field.name = card.name;
  field.shown = "FITS keyword " + card.name;
  field.mm = unit_of_comment(card.comment);
  if (card.name == "PITCHMM") field.mm = 1.0;
  if (card.name == "PUPLSCAL") field.mm = units::kMmPerM;
  const bool plate = card.name == "SCALE" || card.name == "PLTSCALE" || card.name == "SECPIX";
  if (plate) field.name = "resolution";  // of the sky on the detector, in most files
  if (card.is_text()) {
    if (const auto text = keywords.text(card.name)) field.texts = {*text};
  } else if (const auto number = card.number()) {
    field.numbers = {*number};
  } else if (card.value == "T" || card.value == "F") {
    field.numbers = {card.value == "T" ? 1.0 : 0.0};
    field.logical = true;
  }
  return field;
}

std::vector<Card> cards_of(fitsfile* file) {
  int count = 0, status = 0;
  fits_get_hdrspace(file, &count, nullptr, &status);
  std::vector<Card> cards;
  for (int i = 1; i <= count; ++i) {
    std::array<char, FLEN_KEYWORD> name{};
    std::array<char, FLEN_VALUE> value{};
    std::array<char, FLEN_COMMENT> comment{};
    int fault = 0;  // of a card that cannot be read, which is one of nobody's
    fits_read_keyn(file, i, name.data(), value.data(), comment.data(), &fault);
    if (fault == 0) cards.push_back({name.data(), value.data(), comment.data()});
  }
  fits_clear_errmsg();
  return cards;
}

/// Whether the comment behind the value of a card may speak of the map's values: behind a number of its own, a unit is
/// that number's.
bool comment_is_remark(const Card& card) {
  constexpr std::array kOfTheArray{"SIMPLE", "BITPIX", "EXTEND", "XTENSION", "BSCALE", "BZERO", "DATAMIN", "DATAMAX"};
  const bool of_the_array = card.name.starts_with("NAXIS") || is_among(card.name, kOfTheArray);
  const bool number = card.number() && !of_the_array;
  return card.name != "CONTINUE" && !number;
}

/// What COMMENT, HISTORY and the comments behind values seem to say. HISTORY tells what was done: of that only a unit
/// is still so.
void guard_remarks(const std::vector<Card>& cards, const std::string& where, MapHeader& header) {
  for (const Card& card : cards) {
    if (!comment_is_remark(card)) continue;
    const bool history = card.name == "HISTORY", whole = history || card.name == "COMMENT";
    const std::string place = fmt::format("{}: FITS {}{}", where, whole ? "" : "comment behind keyword ", card.name);
    for (UnclearStatement& unclear : unclear_remarks(card.comment, place, RemarkPlace::Field)) {
      if (!history || unclear.about == UnclearStatement::About::Unit) header.unclear.push_back(std::move(unclear));
    }
  }
}

/// Keywords of an image whose pixels are several of the detector's, or every other one: of which of them a size is, is
/// open. Empty if there are none.
std::string binning(const Keywords& keywords) {
  std::string found;
  for (const std::string name : {"LTM1_1", "LTM2_2", "LTM1_2", "LTM2_1", "XBINNING", "YBINNING", "BINNING", "CCDSUM"}) {
    const std::string value = keywords.text(name).value_or("");
    const bool across = name == "LTM1_2" || name == "LTM2_1";
    const std::string plain = across ? "0" : "1";
    if (value.empty() || value == "1 1" || finite_number(value) == finite_number(plain)) continue;
    found += fmt::format("{}FITS keyword {} = {}", found.empty() ? "" : ", ", name, value);
  }
  return found;
}

/// A pitch other than that of world coordinates is left open where pixels are binned.
void take_binning(const Keywords& keywords, SaidOfMap& said) {
  if (!said.header.pitch) return;
  const std::string binned = binning(keywords);
  if (binned.empty()) return;
  said.unclear_pitch += fmt::format("{}{} with {}", said.unclear_pitch.empty() ? "" : ", ", said.pitch_field, binned);
  said.header.pitch.reset();
  said.pitch_field.clear();
}

/// What a card of any kind, EXTNAME too, calls a path difference; not HISTORY, which tells what was done.
void add_wavefronts(const std::vector<Card>& cards, const std::string& where, MapHeader& header) {
  for (const Card& card : cards) {
    if (card.name == "HISTORY" || card.name.starts_with("MADE")) continue;
    const std::string words = card.name + " " + card.value + " / " + card.comment;
    note_wavefront(words, where, fmt::format("FITS card {}", in_quotes(words)), header);
  }
}

/// Whether an axis is of the sky, which no map is laid out in.
bool is_of_the_sky(const Keywords& keywords, const std::string& n) {
  constexpr std::array kSky{"RA--", "DEC-", "GLON", "GLAT", "ELON", "ELAT", "HPLN", "HPLT"};
  const std::string type = keywords.text("CTYPE" + n).value_or("");
  const std::string unit = lower_case(keywords.text("CUNIT" + n).value_or(""));
  return std::any_of(kSky.begin(), kSky.end(), [&](const char* begin) { return type.starts_with(begin); }) ||
         unit.starts_with("deg") || unit.starts_with("arcsec");
}

/// World coordinates without a unit, or in none of length, leave the origin open; unless they are of the sky.
std::string unclear_world(const Keywords& keywords) {
  std::string unclear;
  const auto add = [&](const std::string& name, double value, const std::string& n) {
    unclear += fmt::format("{}FITS keyword {}{} = {} with CUNIT{} = {}", unclear.empty() ? "" : ", ", name, n, value, n,
                           in_quotes(keywords.text("CUNIT" + n).value_or("")));
  };
  for (const std::string n : {"1", "2"}) {
    if (is_of_the_sky(keywords, n)) continue;
    const double value = keywords.number("CRVAL" + n).value_or(0.0), pixel = keywords.number("CRPIX" + n).value_or(0.0);
    if (value != 0.0) add("CRVAL", value, n);
    if (pixel != 0.0 && pixel != 1.0) add("CRPIX", pixel, n);
  }
  return unclear;
}

/// Axes whose names, steps or turns say that they are not x to the right and y up.
void question_axes(const Keywords& keywords, const std::string& where, MapHeader& header) {
  const auto add = [&](const std::string& name, const std::string& value) {
    header.unclear.push_back(
        {UnclearStatement::About::Rows,
         fmt::format("{}: FITS keyword {} = {} looks like an orientation; the first axis is that of x to the right, "
                     "the second that of y upwards",
                     where, name, value)});
  };
  for (const std::string n : {"1", "2"}) {
    if (is_of_the_sky(keywords, n)) return;
    for (const std::string& name : {"CTYPE" + n, "CNAME" + n}) {
      const std::string value = keywords.text(name).value_or("");
      const FieldName said = parse_field_name(value);
      const char first = value.empty() ? ' ' : lower_case(value).front();
      if (said.place && first == (n == "1" ? 'y' : 'x')) add(name, in_quotes(value));
    }
    const auto step = step_of(keywords, n);
    if (step && step->second < 0.0) add(step->first, fmt::format("{}", step->second));
  }
  for (const std::string name : {"CD1_2", "CD2_1", "PC1_2", "PC2_1", "CROTA1", "CROTA2"}) {
    const double turned = keywords.number(name).value_or(0.0);
    if (turned != 0.0) add(name, fmt::format("{}", turned));
  }
  for (const std::string name : {"PC1_1", "PC2_2"}) {
    const double along = keywords.number(name).value_or(1.0);
    if (along < 0.0) add(name, fmt::format("{}", along));
  }
}

/// SCALE may be the plate scale of a telescope, the pitch, or a factor of the values.
void question_scale(const std::vector<Card>& cards, const std::string& where, MapHeader& header) {
  for (const Card& card : cards) {
    const auto number = card.number();
    const bool of_pixels = unit_of_comment(card.comment) || lower_case(card.comment).find("pix") != std::string::npos;
    if (card.name != "SCALE" || !number || *number == 1.0 || of_pixels) continue;
    if (header.pitch && header.pitch->x == *number) continue;
    header.unclear.push_back({UnclearStatement::About::Factor,
                              fmt::format("{}: FITS keyword SCALE = {} looks like a factor of the values, which are "
                                          "read as they are",
                                          where, *number)});
  }
}

void add_world(const Keywords& keywords, SaidOfMap& said, const std::string& where) {
  const std::optional<LinearAxis> x = axis(keywords, 1), y = axis(keywords, 2);
  if (!x || !y) {
    const std::string unclear = unclear_world(keywords);
    if (!unclear.empty()) said.unclear_origin += (said.unclear_origin.empty() ? "" : ", ") + unclear;
    for (const std::string n : {"1", "2"}) {
      const auto step = step_of(keywords, n);
      if (!step) continue;
      said.unclear_pitch +=
          fmt::format("{}FITS keyword {} = {} with CUNIT{} = {}", said.unclear_pitch.empty() ? "" : ", ", step->first,
                      step->second, n, in_quotes(keywords.text("CUNIT" + n).value_or("")));
    }
    return;
  }
  constexpr double kSame = 1e-6;  // relative: single precision
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSame * b; };
  if (said.header.pitch && !(same(said.header.pitch->x, x->pitch) && same(said.header.pitch->y, y->pitch))) {
    throw InputError(
        fmt::format("{}: {}, but the FITS keywords CDELT and CUNIT give steps of {} and {} mm; they must agree", where,
                    said.pitch_field, x->pitch, y->pitch));
  }
  said.header.pitch = Point{x->pitch, y->pitch};
  said.header.origin = Point{x->origin, y->origin};
  said.unclear_origin.clear();
  said.pitch_field = fmt::format("FITS keywords CDELT and CUNIT: steps of {} and {} mm", x->pitch, y->pitch);
}

}  // namespace

FitsHeader read_fits_header(fitsfile* file, const std::string& where) {
  const Keywords keywords(file, where);
  std::vector<MapField> fields;
  const std::vector<Card> cards = cards_of(file);
  for (const Card& card : cards) {
    if (auto field = field_of_card(card, keywords)) fields.push_back(std::move(*field));
  }
  FitsHeader header;
  header.said = read_map_fields(fields, where);
  guard_remarks(cards, where, header.said.header);
  if (!keywords.number("PITCHMM")) take_binning(keywords, header.said);
  add_wavefronts(cards, where, header.said.header);
  question_axes(keywords, where, header.said.header);
  add_world(keywords, header.said, where);
  question_scale(cards, where, header.said.header);
  for (int step = 1; const auto made = keywords.text(fmt::format("MADE{}", step)); ++step) {
    header.said.header.history.push_back(*made);
  }
  header.blank = keywords.number("BLANK");
  return header;
}

}  // namespace dwell
