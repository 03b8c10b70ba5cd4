#include "core/formats/map_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/formats/field_name.h"
#include "core/formats/remark_guard.h"
#include "core/formats/said_wavelength.h"
#include "core/formats/wavefront_words.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr double kSameLength = 1e-6;          // relative: single precision
constexpr std::size_t kLongestRemark = 4000;  // characters

bool agree(double a, double b) { return std::abs(a - b) <= kSameLength * std::max(std::abs(a), std::abs(b)); }

std::string value_of(const MapField& field) {
  std::string value;
  for (const double number : field.numbers) value += fmt::format("{}{}", value.empty() ? "" : ", ", number);
  for (const std::string& text : field.texts) value += fmt::format("{}{}", value.empty() ? "" : ", ", in_quotes(text));
  return value;
}

std::string said(const MapField& field) {
  const std::string value = value_of(field);
  return value.empty() ? field.shown : fmt::format("{} = {}", field.shown, value);
}

/// A length that one field gives along an axis or both.
struct SaidLength {
  double mm;
  const MapField* field;
};

/// What was said of a pair of lengths, x and y.
struct SaidPair {
  std::optional<SaidLength> x, y;
};

class MapFieldsReader {
 public:
  MapFieldsReader(const std::vector<MapField>& fields, const std::string& where) : fields_(fields), where_(where) {}

  SaidOfMap read() {
    // Units first: a field of pitch or origin may need that of another.
    for (const MapField& field : fields_) read_unit(field, parse_field_name(field.name));
    for (const MapField& field : fields_) read_other(field, parse_field_name(field.name));
    for (const MapField& field : fields_) read_waves_of(field);
    settle_unit();
    settle_pitch();
    settle_origin();
    return std::move(said_);
  }

 private:
  [[noreturn]] void refuse(const MapField& field, std::string_view required) const {
    throw InputError(fmt::format("{}: {}; {} required", where_, said(field), required));
  }
  [[noreturn]] void refuse_both(const MapField& a, const MapField& b) const {
    throw InputError(fmt::format("{}: {}, but {}; they must agree", where_, said(a), said(b)));
  }

  /// The one text of a field of a unit; empty where it says nothing.
  std::string unit_text(const MapField& field) const {
    if (field.texts.size() != 1 || !field.numbers.empty()) refuse(field, "a text that names a unit is");
    return std::string(trim(field.texts.front()));
  }

  /// "z = 'um'" is a unit whatever else the name may be of; pixels have a height too.
  static bool is_unit_of_values(const MapField& field, const FieldName& name) {
    return (name.values || name.topic == MapTopic::Label) && name.axis == FieldAxis::Both && field.texts.size() == 1 &&
           field.numbers.empty() && (known_value_unit(field.texts.front()) || is_wave_unit(field.texts.front()));
  }

  void read_unit(const MapField& field, const FieldName& name) {
    if (is_unit_of_values(field, name)) return take_unit(field, std::string(trim(field.texts.front())));
    if (name.topic == MapTopic::ValueUnit && !(field.texts.empty() && field.numbers.empty())) {
      take_unit(field, unit_text(field));
    }
    if (name.topic == MapTopic::UnknownUnit && !unknown_unit_ && !is_of_something_else(field)) unknown_unit_ = &field;
    if (name.topic == MapTopic::Label && field.texts.size() == 1) take_unit(field, unit_of_label(field.texts.front()));
    if (name.topic != MapTopic::LateralUnit || field.texts.size() != 1) return;
    const auto nm = known_length_unit(field.texts.front());
    if (!nm) return;  // pixels, degrees on the sky: what it is of has no length then
    const double mm = *nm / units::kNmPerMm;
    if (lateral_ && lateral_->mm != mm) refuse_both(*lateral_->field, field);
    lateral_ = SaidLength{mm, &field};
  }

  /// Seconds, volts and pixels are no unit of heights, whatever they are of.
  static bool is_of_something_else(const MapField& field) {
    static constexpr std::string_view kNoHeights[] = {
        "s",   "sec", "ms", "us",  "hz",   "khz", "mhz",     "ghz",    "k",     "c",     "v",
        "mv",  "a",   "ma", "w",   "mw",   "kg",  "g",       "n",      "pa",    "deg",   "degree",
        "rpm", "%",   "px", "adu", "mbar", "bar", "percent", "pixels", "pixel", "counts"};
    return field.texts.size() == 1 && is_among(lower_case(trim(field.texts.front())), kNoHeights);
  }

  void take_unit(const MapField& field, const std::string& unit) {
    if (unit.empty()) return;
    if (unit_field_ && !same_unit(*said_.header.unit, unit)) refuse_both(*unit_field_, field);
    if (unit_field_) return;
    said_.header.unit = unit;
    unit_field_ = &field;
  }

  static bool same_unit(const std::string& a, const std::string& b) {
    return a == b || (is_wave_unit(a) && is_wave_unit(b)) ||
           (known_length_unit(a) && known_length_unit(a) == known_length_unit(b)) ||
           (known_rate_unit(a) && known_rate_unit(a) == known_rate_unit(b));
  }

  void read_other(const MapField& field, const FieldName& name) {
    if (is_unit_of_values(field, name)) return;
    switch (name.topic) {
      case MapTopic::Pitch:
        return take_pitch(field, name);
      case MapTopic::Size:
        guard(field);
        return add_unclear(said_.unclear_pitch, field);
      case MapTopic::Orientation:
        return take_orientation(field);
      case MapTopic::Other:
        return guard(field);
      case MapTopic::Label:
        if (field.texts.size() != 1 || unit_of_label(field.texts.front()).empty()) guard(field);
        return;
      case MapTopic::Origin:
        return take_origin(field, name);
      case MapTopic::NoData:
        return take_no_data(field);
      case MapTopic::ValueScale:
        return check_scale(field, name);
      default:
        return;
    }
  }

  /// A wavelength with its unit, and what calls the values a path difference. Of several wavelengths none counts.
  void read_waves_of(const MapField& field) {
    const auto is_remark = [](const std::string& text) { return text.size() <= kLongestRemark; };
    std::string words = field.name;
    for (const std::string& text : field.texts) words += is_remark(text) ? " " + text : "";
    note_wavefront(words, where_, said(field), said_.header);
    if (!names_wavelength(field.name)) return;
    const std::vector<double> mm = lengths(field, parse_field_name(field.name));
    if (mm.size() == 1) add_wavelength(mm.front() * units::kNmPerMm, said(field), said_.header);
  }

  static void add_unclear(std::string& list, const MapField& field) {
    constexpr std::size_t kMost = 400;  // characters
    if (list.size() < kMost) list += (list.empty() ? "" : ", ") + said(field);
  }

  /// The lengths that a field holds [mm]; none if it leaves open in which unit.
  std::vector<double> lengths(const MapField& field, const FieldName& name) const {
    std::vector<double> mm;
    for (const std::string& text : field.texts) {
      if (const auto length = length_of_text(text)) mm.push_back(*length);
    }
    if (!mm.empty()) return mm.size() == field.texts.size() ? mm : std::vector<double>{};
    const auto unit = field.mm ? field.mm : name.mm ? name.mm : lateral_ ? std::optional(lateral_->mm) : std::nullopt;
    if (!unit) return {};
    for (const double number : field.numbers) mm.push_back(number * *unit);
    return mm;
  }

  void take_pitch(const MapField& field, const FieldName& name) {
    const std::vector<double> mm = lengths(field, name);
    const bool documented = lower_case(field.name) == "pitch_mm";
    const auto good = [](double pitch) { return std::isfinite(pitch) && pitch > 0.0; };
    const std::size_t most = name.axis == FieldAxis::Both ? 2 : 1;
    const bool sound = !mm.empty() && mm.size() <= most && std::all_of(mm.begin(), mm.end(), good);
    if (documented && !sound) refuse(field, "one finite number > 0, or two (x, y),");
    if (name.clear && !mm.empty() && !std::all_of(mm.begin(), mm.end(), good)) refuse(field, "finite numbers > 0 are");
    // Of other names than ours nobody knows whether x or y comes first: images have rows first.
    const bool ordered = documented || mm.size() < 2 || mm.front() == mm.back();
    if (!sound || !name.clear || !ordered) return add_unclear(said_.unclear_pitch, field);
    if (name.axis != FieldAxis::Y) take_length(pitch_.x, mm.front(), field);
    if (name.axis != FieldAxis::X) take_length(pitch_.y, mm.back(), field);
  }

  void take_length(std::optional<SaidLength>& slot, double mm, const MapField& field) const {
    if (slot && !agree(slot->mm, mm)) refuse_both(*slot->field, field);
    if (!slot) slot = SaidLength{mm, &field};
  }

  void take_origin(const MapField& field, const FieldName& name) {
    const std::vector<double> mm = lengths(field, name);
    const auto finite = [](double place) { return std::isfinite(place); };
    const bool documented = lower_case(field.name) == "origin_mm";
    const std::size_t needed = name.axis == FieldAxis::Both ? 2 : 1;
    const bool sound = mm.size() == needed && std::all_of(mm.begin(), mm.end(), finite);
    if (documented && !sound) refuse(field, "two finite numbers (x, y)");
    const bool ordered = documented || mm.size() < 2 || mm.front() == mm.back();
    if (sound && name.clear && ordered) {
      if (name.axis != FieldAxis::Y) take_length(origin_.x, mm.front(), field);
      if (name.axis != FieldAxis::X) take_length(origin_.y, mm.back(), field);
      return;
    }
    const auto zero = [](double place) { return place == 0.0; };
    const bool nowhere = field.texts.empty() && std::all_of(field.numbers.begin(), field.numbers.end(), zero);
    if (nowhere && !(name.middle && !field.numbers.empty())) return;
    if (!field.texts.empty() && std::none_of(field.texts.begin(), field.texts.end(), speaks_of_a_place)) return;
    add_unclear(said_.unclear_origin, field);
  }

  /// "upper left" is a place, the name of an institution is none.
  static bool speaks_of_a_place(const std::string& text) {
    if (length_of_text(text) || finite_number(text)) return true;
    const std::string lower = lower_case(text);
    const std::string_view words[] = {"upper", "lower", "top", "bottom", "left", "right", "centre", "center"};
    return std::any_of(std::begin(words), std::end(words),
                       [&](std::string_view word) { return lower.find(word) != std::string::npos; });
  }

  void take_no_data(const MapField& field) {
    for (const std::string& text : field.texts) {
      const auto number = height_number(text);
      if (!number) refuse(field, "a number that stands for no data is");
      if (!std::isnan(*number)) said_.header.no_data.push_back(*number);
    }
    for (const double number : field.numbers) {
      if (!std::isnan(number)) said_.header.no_data.push_back(number);
    }
  }

  /// What the texts of a field say that is not known, as a comment would: "columns = 'x_mm y_mm z_um'".
  void guard(const MapField& field) {
    for (const std::string& text : field.texts) {
      if (text.size() > kLongestRemark) continue;  // a program, a log
      const std::string place = fmt::format("{}: {}", where_, field.shown);
      std::vector<UnclearStatement> unclear = unclear_remarks(text, place, RemarkPlace::Field);
      // "detector = 'm'": a unit alone is said of the name.
      if (unclear.empty() && known_value_unit(text) && lower_case(trim(text)) != "in") {
        unclear = unclear_remarks(fmt::format("{} = {}", field.name, text), place, RemarkPlace::Field);
      }
      said_.header.unclear.insert(said_.header.unclear.end(), unclear.begin(), unclear.end());
    }
  }

  void add_statement(UnclearStatement::About about, const MapField& field, const char* what) {
    said_.header.unclear.push_back({about, fmt::format("{}: {} looks like {}", where_, said(field), what)});
  }

  void take_orientation(const MapField& field) {
    const bool none =
        std::all_of(field.numbers.begin(), field.numbers.end(), [](double v) { return v == 0.0; }) &&
        std::all_of(field.texts.begin(), field.texts.end(), [](const std::string& text) {
          const std::string lower = lower_case(trim(text));
          return lower.empty() || lower == "none" || lower == "no" || lower == "false" || lower == "normal";
        });
    if (!none) {
      add_statement(UnclearStatement::About::Rows, field,
                    "an orientation; the first row is that of the smallest y, the first column that of the smallest x");
    }
  }

  void check_scale(const MapField& field, const FieldName& name) {
    const std::string lower = lower_case(field.name);
    const bool added = lower.find("offset") != std::string::npos || lower.find("intercept") != std::string::npos;
    const double neutral = added || lower == "waves" ? 0.0 : 1.0;
    const bool harmless = field.texts.empty() && std::all_of(field.numbers.begin(), field.numbers.end(),
                                                             [&](double number) { return number == neutral; });
    if (harmless) return;
    if (name.clear) refuse(field, fmt::format("{} (heights as they are) is", neutral));
    add_statement(UnclearStatement::About::Factor, field, "a factor of the values, which are read as they are");
  }

  void settle_unit() const {
    if (said_.header.unit || !unknown_unit_) return;
    throw InputError(
        fmt::format("{}: {}; it may be the unit of the heights: say that as unit", where_, said(*unknown_unit_)));
  }

  void settle_pitch() {
    if (pitch_.x && pitch_.y) {
      said_.header.pitch = Point{pitch_.x->mm, pitch_.y->mm};
      said_.pitch_field = said(*pitch_.x->field);
      if (pitch_.y->field != pitch_.x->field) said_.pitch_field += ", " + said(*pitch_.y->field);
    } else if (pitch_.x || pitch_.y) {
      add_unclear(said_.unclear_pitch, *(pitch_.x ? pitch_.x : pitch_.y)->field);
    }
  }

  void settle_origin() {
    if (origin_.x && origin_.y) {
      said_.header.origin = Point{origin_.x->mm, origin_.y->mm};
    } else if (origin_.x || origin_.y) {
      add_unclear(said_.unclear_origin, *(origin_.x ? origin_.x : origin_.y)->field);
    }
  }

  const std::vector<MapField>& fields_;
  const std::string& where_;
  SaidOfMap said_;
  const MapField *unit_field_ = nullptr, *unknown_unit_ = nullptr;
  std::optional<SaidLength> lateral_;
  SaidPair pitch_, origin_;
};

}  // namespace

SaidOfMap read_map_fields(const std::vector<MapField>& fields, const std::string& where) {
  return MapFieldsReader(fields, where).read();
}

std::string unit_of_label(const std::string& label) {
  const std::string_view text = trim(label);
  for (const auto& [open, close] : {std::pair{'(', ')'}, {'[', ']'}}) {
    if (!text.ends_with(close)) continue;
    const std::size_t at = text.rfind(open);
    if (at == std::string_view::npos) return "";
    const std::string unit(trim(text.substr(at + 1, text.size() - at - 2)));
    return known_value_unit(unit) || is_wave_unit(unit) ? unit : "";
  }
  return "";
}

std::optional<double> length_of_text(const std::string& text) {
  const std::string_view all = trim(text);
  const std::size_t at = all.find_last_of("0123456789.");
  if (at == std::string_view::npos) return std::nullopt;
  const auto number = finite_number(all.substr(0, at + 1));
  const auto nm = known_length_unit(all.substr(at + 1));
  return number && nm ? std::optional(*number * *nm / units::kNmPerMm) : std::nullopt;
}

}  // namespace dwell
