#include "core/formats/map_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/formats/field_name.h"
#include "core/formats/field_texts.h"
#include "core/formats/remark_guard.h"
#include "core/formats/said_factor.h"
#include "core/formats/said_orientation.h"
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
    if (name.topic == MapTopic::UnknownUnit && !unknown_unit_ &&
        !(field.texts.size() == 1 && is_unit_of_no_height(field.texts.front())))
      unknown_unit_ = &field;
    const bool label = name.topic == MapTopic::Label && name.axis == FieldAxis::Both;  // not of x or y
    if (label && field.texts.size() == 1) take_unit(field, unit_of_label(field.texts.front()));
    if (name.topic != MapTopic::LateralUnit || field.texts.size() != 1) return;
    const auto nm = known_length_unit(field.texts.front());
    if (!nm) return;  // pixels, degrees on the sky: what it is of has no length then
    const double mm = *nm / units::kNmPerMm;
    if (lateral_ && lateral_->mm != mm) refuse_both(*lateral_->field, field);
    lateral_ = SaidLength{mm, &field};
  }

  void take_unit(const MapField& field, const std::string& unit) {
    if (unit.empty()) return;
    if (unit_field_ && !is_same_unit(*said_.header.unit, unit)) refuse_both(*unit_field_, field);
    if (unit_field_) return;
    said_.header.unit = unit;
    unit_field_ = &field;
  }

  void read_other(const MapField& field, const FieldName& name) {
    if (is_unit_of_values(field, name) || take_axis_claim(field)) return;
    switch (name.topic) {
      case MapTopic::Pitch:
        return take_pitch(field, name);
      case MapTopic::Size:
        return take_size(field, name);
      case MapTopic::Orientation:
        return take_orientation(field, name);
      case MapTopic::AxisOrder:
        return take_axis_order(field, name);
      case MapTopic::Other:
        if (name.place) take_place(field);
        return guard(field);
      case MapTopic::Label:
        if (field.texts.size() != 1 || unit_of_label(field.texts.front()).empty()) guard(field);
        return;
      case MapTopic::Origin:
        return take_origin(field, name);
      case MapTopic::NoData:
        return take_no_data(field, name);
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
    const bool lower =
        !field.texts.empty() && std::all_of(field.texts.begin(), field.texts.end(),
                                            [](const auto& text) { return is_usual_orientation(text, '\0'); });
    if (lower) return;  // the first row is the lowest, as here
    if (std::any_of(field.texts.begin(), field.texts.end(), names_another_corner)) question_rows(field);
    add_unclear(said_.unclear_origin, field);
  }

  void take_no_data(const MapField& field, const FieldName& name) {
    if (!name.clear) return question_no_data(field);
    for (const std::string& text : field.texts) {
      const auto number = height_number(text);
      if (!number) refuse(field, "a number that stands for no data is");
      if (!std::isnan(*number)) said_.header.no_data.push_back(*number);
    }
    for (const double number : field.numbers) {
      if (!std::isnan(number)) said_.header.no_data.push_back(number);
    }
  }

  /// "mask = 9" may be a marker, a count or a switch.
  void question_no_data(const MapField& field) {
    const auto is_marker = [](const std::string& text) { return finite_number(text).has_value(); };
    const bool numbers =
        std::any_of(field.numbers.begin(), field.numbers.end(), [](double v) { return !std::isnan(v); });
    if (field.logical || !(numbers || std::any_of(field.texts.begin(), field.texts.end(), is_marker))) return;
    add_statement(UnclearStatement::About::NoData, field, "a value for no data; say it as no_data");
  }

  /// "x_range = [-25, 25]" is where the map lies, "height = 10 nm" may be a step of the values; other sizes are of the
  /// field.
  void take_size(const MapField& field, const FieldName& name) {
    guard(field);
    if (name.axis != FieldAxis::Both && field.numbers.size() == 2 && field.numbers.front() != 0.0) {
      add_unclear(said_.unclear_origin, field);
    }
    const bool length = name.mm || std::any_of(field.texts.begin(), field.texts.end(), [](const std::string& text) {
                          return length_of_text(text).has_value();
                        });
    if (name.values && length && !names_a_width()) {
      add_statement(UnclearStatement::About::Factor, field,
                    "the height of the field or a step of the values; say the pitch as pitch_mm");
    }
    add_unclear(said_.unclear_pitch, field);
  }

  bool names_a_width() const {
    return std::any_of(fields_.begin(), fields_.end(), [](const MapField& field) {
      const FieldName name = parse_field_name(field.name);
      return name.topic == MapTopic::Size && !name.values;
    });
  }

  /// "x_mm = 10", "x = [0, 1, 2]".
  void take_place(const MapField& field) {
    const bool nowhere = std::all_of(field.numbers.begin(), field.numbers.end(), [](double v) { return v == 0.0; });
    if (!nowhere) add_unclear(said_.unclear_origin, field);
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
      if (unclear.empty()) unclear = questions_of_orientation(fmt::format("{}: {}", field.name, text), place);
      said_.header.unclear.insert(said_.header.unclear.end(), unclear.begin(), unclear.end());
    }
  }

  /// "columns = 'y'", "seen = 'from below'": a few words may say an orientation together with the name alone.
  static std::vector<UnclearStatement> questions_of_orientation(const std::string& statement,
                                                                const std::string& place) {
    constexpr std::size_t kLongest = 60;  // characters
    if (statement.size() > kLongest) return {};
    std::vector<UnclearStatement> unclear = unclear_remarks(statement, place, RemarkPlace::Field);
    std::erase_if(unclear, [](const UnclearStatement& said) {
      return said.about != UnclearStatement::About::Rows && said.about != UnclearStatement::About::Axes;
    });
    return unclear;
  }

  void add_statement(UnclearStatement::About about, const MapField& field, const char* what) {
    said_.header.unclear.push_back({about, fmt::format("{}: {} looks like {}", where_, said(field), what)});
  }

  void take_orientation(const MapField& field, const FieldName& name) {
    if (name.axis != FieldAxis::Both && field.numbers.size() > 2) {
      return add_unclear(said_.unclear_origin, field);  // coordinates
    }
    const bool named = lower_case(field.name).ends_with("mirror");  // of which, mostly: "M1"
    if (named && !field.logical && std::none_of(field.texts.begin(), field.texts.end(), names_a_mirroring)) return;
    const bool direction = names_a_direction(field.name) && name.axis != FieldAxis::Both;
    const char axis = !direction ? '\0' : name.axis == FieldAxis::X ? 'x' : 'y';
    const bool usual = std::all_of(field.numbers.begin(), field.numbers.end(),
                                   [&](double v) { return is_usual_orientation(v, axis); }) &&
                       std::all_of(field.texts.begin(), field.texts.end(),
                                   [&](const std::string& text) { return is_usual_orientation(text, axis); });
    if (!usual) question_rows(field);
  }

  /// "y_up = false".
  bool take_axis_claim(const MapField& field) {
    if (field.texts.size() + field.numbers.size() != 1) return false;
    std::string value = field.texts.empty() ? fmt::format("{}", field.numbers.front()) : field.texts.front();
    if (field.logical && !field.numbers.empty()) value = field.numbers.front() != 0.0 ? "true" : "false";
    const auto claim = read_axis_claim(field.name, value);
    if (claim && !claim->usual && claim->axis != 'z') question_rows(field);
    if (claim && !claim->usual && claim->axis == 'z') {
      add_statement(UnclearStatement::About::Factor, field,
                    "a sign of the values; those that are positive are taken for material to remove");
    }
    return claim.has_value();
  }

  /// "order = 'zernike'" is of something else; "dims = 'lon, lat'" is not.
  void take_axis_order(const MapField& field, const FieldName& name) {
    const AxisOrder order = read_axis_order(field.texts, field.numbers);
    if (order == AxisOrder::ColumnsFirst || (order == AxisOrder::Unknown && name.clear)) return question_rows(field);
    if (order == AxisOrder::Unknown) guard(field);
  }

  void question_rows(const MapField& field) {
    add_statement(UnclearStatement::About::Rows, field,
                  "an orientation; the first row is that of the smallest y, the first column that of the smallest x");
  }

  void check_scale(const MapField& field, const FieldName& name) {
    if (leaves_heights(field.name, field.numbers, field.texts)) return;
    const bool text = field.numbers.empty() && !field.texts.empty();
    if (name.clear && !text) refuse(field, fmt::format("{} (heights as they are) is", neutral_number(field.name)));
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

}  // namespace dwell
