#include "core/formats/profile_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/value_range.h"
#include "core/formats/profile_table.h"
#include "core/formats/slope_unit.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr ValueRange kSlopeRange{-1e6, 1e6, "urad"};

/// The columns that the profile is taken from, and what is known of them.
struct ChosenColumns {
  std::size_t place = 0, value = 1;
  bool said_slope = false, said_height = false;  // by the words of the user or of the file
};

class ColumnChoice {
 public:
  ColumnChoice(const ProfileTable& table, const std::string& where) : table_(table), where_(where) {}

  ChosenColumns choose(const std::string& columns) const {
    ChosenColumns chosen = columns.empty() ? by_file() : by_user(columns);
    if (!table_.names.empty()) {
      chosen.said_slope = chosen.said_slope || table_.names[chosen.value].is_slope();
      chosen.said_height = chosen.said_height || table_.names[chosen.value].is_height();
    }
    return chosen;
  }

  std::string shown(std::size_t column) const {
    return table_.names.empty() ? fmt::format("column {}", column + 1) : table_.names[column].shown;
  }

 private:
  std::string names() const {
    if (table_.names.empty()) return fmt::format("{} columns without names", table_.columns);
    std::string text;
    for (std::size_t k = 0; k < table_.columns; ++k)
      text += fmt::format("{}{} {}", k == 0 ? "" : ", ", k + 1, in_quotes(table_.names[k].shown));
    return text;
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(
        fmt::format("{}: {}; it has {}; give `columns` PLACE,VALUE, each a name or a number", where_, why, names()));
  }

  template <class Is>
  std::vector<std::size_t> where_names(Is is) const {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < table_.names.size(); ++k) {
      if (is(table_.names[k])) found.push_back(k);
    }
    return found;
  }

  ChosenColumns by_file() const {
    if (table_.names.empty()) {
      if (table_.columns != 2) refuse("which columns hold place and value is not said");
      return {};
    }
    const auto places = where_names([](const ProfileColumn& c) { return c.is_place(); });
    if (places.size() != 1) refuse("more than one column may be the place");
    const auto slopes = where_names([](const ProfileColumn& c) { return c.is_slope(); });
    const auto heights = where_names([](const ProfileColumn& c) { return c.is_height(); });
    // Of slopes and heights of one profile, the first were measured, as profile_csv writes them.
    const bool slope_first = heights.empty() || (!slopes.empty() && slopes[0] < heights[0]);
    const auto& values = slope_first ? slopes : heights;
    const auto& others = slope_first ? heights : slopes;
    if (values.size() != 1 || others.size() > 1) refuse("more than one column may be the slope or height");
    return {places[0], values[0], false, false};
  }

  ChosenColumns by_user(const std::string& columns) const {
    const auto parts = split(columns, ',');
    if (parts.size() != 2) refuse(fmt::format("`columns` \"{}\" are not two", columns));
    ChosenColumns chosen{column_of(parts[0], true), column_of(parts[1], false), false, false};
    if (chosen.place == chosen.value) refuse(fmt::format("`columns` \"{}\" are one and the same", columns));
    if (finite_number(parts[1])) return chosen;
    const ProfileColumn word{"", profile_words(parts[1]), ""};
    chosen.said_slope = word.is_slope();
    chosen.said_height = word.is_height();
    return chosen;
  }

  std::size_t column_of(std::string_view word, bool place) const {
    if (const auto number = finite_number(word)) {
      if (*number >= 1.0 && *number <= static_cast<double>(table_.columns) && *number == std::floor(*number))
        return static_cast<std::size_t>(*number) - 1;
      refuse(fmt::format("`columns`: {} is none of 1 to {}", in_quotes(trim(word)), table_.columns));
    }
    const ProfileColumn wanted{"", profile_words(word), ""};
    if (wanted.words.empty()) refuse(fmt::format("`columns`: {} is no name", in_quotes(word)));
    if (table_.names.empty()) {
      const bool known = place ? wanted.is_place() : wanted.is_slope() || wanted.is_height();
      if (table_.columns == 2 && known) return place ? 0 : 1;
      refuse(fmt::format("`columns`: no column is named {}", in_quotes(trim(word))));
    }
    for (const int how : {0, 1, 2}) {
      const auto found = where_names([&](const ProfileColumn& c) { return is_meant(c, wanted, how); });
      if (found.size() == 1) return found[0];
      if (found.size() > 1)
        refuse(fmt::format("`columns`: {} columns are named {}", found.size(), in_quotes(trim(word))));
    }
    refuse(fmt::format("`columns`: no column is named {}", in_quotes(trim(word))));
  }

  /// By the same words, by holding them all, or by meaning the same.
  static bool is_meant(const ProfileColumn& column, const ProfileColumn& wanted, int how) {
    if (how == 0) return column.words == wanted.words;
    if (how == 1) {
      return std::all_of(wanted.words.begin(), wanted.words.end(), [&column](const std::string& word) {
        return std::find(column.words.begin(), column.words.end(), word) != column.words.end();
      });
    }
    return (wanted.is_place() && column.is_place()) || (wanted.is_slope() && column.is_slope()) ||
           (wanted.is_height() && column.is_height());
  }

  const ProfileTable& table_;
  const std::string& where_;
};

struct ProfileUnits {
  std::string place, value;  // for messages
  double mm = 1.0;           // in one of the place
  double factor = 1.0;       // urad or nm in one of the value, with its sign
  ProfileQuantity quantity = ProfileQuantity::Slope;
};

/// The unit and its quantity; nothing if it is none of slope or height.
std::optional<std::pair<ProfileQuantity, double>> value_unit_of(std::string_view text) {
  if (const auto slope = known_slope_unit(text)) return std::pair{ProfileQuantity::Slope, *slope};
  if (const auto height = known_length_unit(text)) return std::pair{ProfileQuantity::Height, *height};
  return std::nullopt;
}

constexpr const char* kProfileUnits =
    "accepted: PLACE,VALUE, as mm,urad or mm,-urad: a length, then rad, mrad, urad, nrad, deg, arcsec, nm/mm and their "
    "like or a length, with a minus to turn the sign of the values";

ProfileUnits units_of_user(const std::string& unit) {
  const auto refuse = [&unit](const std::string& why) {
    throw InputError(fmt::format("`unit` \"{}\": {}; {}", unit, why, kProfileUnits));
  };
  const auto parts = split(unit, ',');
  if (parts.size() != 2) refuse("two units are required");
  const std::string_view place = trim(parts[0]);
  std::string_view value = trim(parts[1]);
  if (place.starts_with('-')) refuse("the place has no sign to turn; source=high turns an ellipse");
  const std::optional<double> mm = known_length_unit(place);
  if (!mm) refuse(fmt::format("{} is no length", in_quotes(place)));
  ProfileUnits units{std::string(place), std::string(value), *mm / units::kNmPerMm, 1.0, ProfileQuantity::Slope};
  const double sign = value.starts_with('-') ? -1.0 : 1.0;
  if (sign < 0.0) value = trim(value.substr(1));
  const auto known = value.starts_with('-') ? std::nullopt : value_unit_of(value);
  if (!known) refuse(fmt::format("{} is no unit of slope or height", in_quotes(value)));
  units.quantity = known->first;
  units.factor = sign * known->second;
  return units;
}

/// The unit that the file gives to a column; empty: none. `place`: it is that of x.
std::string unit_of_file(const ProfileTable& table, std::size_t column, bool place, const std::string& where) {
  const auto& said = place ? table.place_unit : table.value_unit;
  const std::string named = table.names.empty() ? "" : table.names[column].unit;
  if (said && !named.empty() && *said != named) {
    throw InputError(fmt::format("{}: a header line gives the unit {}, line {} gives {}; one is required", where,
                                 in_quotes(*said), table.names_line, in_quotes(named)));
  }
  return said ? *said : named;
}

/// "slope*1e6 (rad)", "10 x slope": the name may hold a factor.
bool may_hold_factor(const ProfileColumn& column) {
  const std::string name = column.shown.substr(0, column.shown.find_first_of("[("));
  const bool number = std::any_of(column.words.begin(), column.words.end(),
                                  [](const std::string& word) { return word.front() >= '0' && word.front() <= '9'; });
  return number || name.find_first_of("*^") != std::string::npos;
}

ProfileUnits units_of_file(const ProfileTable& table, const ChosenColumns& chosen, const std::string& place,
                           const std::string& value, const std::string& where) {
  const auto refuse = [&where](const std::string& why) {
    throw InputError(fmt::format("{}: {}; give `unit`; {}", where, why, kProfileUnits));
  };
  if (!table.unclear.empty()) throw InputError(fmt::format("{}; give `unit`; {}", table.unclear[0], kProfileUnits));
  for (const std::size_t column : {chosen.place, chosen.value}) {
    if (!table.names.empty() && may_hold_factor(table.names[column]))
      refuse(fmt::format("line {}: {} may hold a factor", table.names_line, in_quotes(table.names[column].shown)));
  }
  if (place.empty() || value.empty())
    refuse(fmt::format("the file says no unit of {}", place.empty() ? "the place" : "the values"));
  const std::optional<double> mm = known_length_unit(place);
  if (!mm) refuse(fmt::format("line {}: {} is no known unit of length", table.names_line, in_quotes(place)));
  const auto known = value_unit_of(value);
  if (!known) {
    refuse(fmt::format("line {}: {} is no known unit of slope or height", table.names_line, in_quotes(value)));
  }
  return {place, value, *mm / units::kNmPerMm, known->second, known->first};
}

bool is_same_factor(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

/// Where both user and file say a known unit, they must agree, but for the sign.
void check_profile_units(const ProfileUnits& user, const std::string& place, const std::string& value,
                         const std::string& where) {
  const auto refuse = [&where](const std::string& file, const std::string& option) {
    throw InputError(fmt::format("{}: the header says {}, `unit` says {}; they must agree but for the sign", where,
                                 in_quotes(file), in_quotes(option)));
  };
  if (const auto mm = known_length_unit(place); mm && !is_same_factor(*mm / units::kNmPerMm, user.mm))
    refuse(place, user.place);
  if (const auto known = value_unit_of(value);
      known && (known->first != user.quantity || !is_same_factor(known->second, std::abs(user.factor)))) {
    refuse(value, user.value);
  }
}

ProfileUnits units_of(const ProfileTable& table, const ChosenColumns& chosen, const ProfileReadOptions& options,
                      const std::string& where) {
  const std::string place = unit_of_file(table, chosen.place, true, where),
                    value = unit_of_file(table, chosen.value, false, where);
  ProfileUnits units =
      options.unit.empty() ? units_of_file(table, chosen, place, value, where) : units_of_user(options.unit);
  if (!options.unit.empty()) check_profile_units(units, place, value, where);
  const bool slope = units.quantity == ProfileQuantity::Slope;
  if ((chosen.said_height && slope) || (chosen.said_slope && !slope)) {
    throw InputError(fmt::format("{}: the values are named {}, and {} is a unit of {}; `columns` and `unit` must fit",
                                 where, slope ? "a height" : "a slope", in_quotes(units.value),
                                 slope ? "slope" : "height"));
  }
  return units;
}

/// Places must run one way; those that decrease are turned.
void sort_places(ProfileText& profile, const std::vector<long>& lines, const std::string& where) {
  const std::size_t n = profile.x.size();
  profile.turned = profile.x[1] < profile.x[0];
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double step = profile.turned ? profile.x[i] - profile.x[i + 1] : profile.x[i + 1] - profile.x[i];
    if (step >= ranges::kPitch.least) continue;
    const std::string places = fmt::format("{}, line {}: x = {:.9g} mm after {:.9g} mm on line {}", where, lines[i + 1],
                                           profile.x[i + 1], profile.x[i], lines[i]);
    if (std::abs(step) < ranges::kPitch.least)
      throw InputError(
          fmt::format("{}: the place stands twice; {:g} mm apart at least is required", places, ranges::kPitch.least));
    throw InputError(fmt::format("{}: it runs back; places must increase, or all decrease", places));
  }
  if (!profile.turned) return;
  std::reverse(profile.x.begin(), profile.x.end());
  std::reverse(profile.values.begin(), profile.values.end());
}

[[noreturn]] void refuse_number(const char* what, double number, const ValueRange& range, const std::string& where,
                                long line) {
  throw InputError(fmt::format("{}, line {}: the {} is {:.9g} {}; {} is required", where, line, what, number,
                               range.unit, range.text()));
}

}  // namespace

ProfileText parse_profile_text(std::string_view text, const ProfileReadOptions& options, const std::string& where) {
  const ProfileTable table = read_profile_table(text, where);
  const ColumnChoice choice(table, where);
  const ChosenColumns chosen = choice.choose(options.columns);
  const ProfileUnits units = units_of(table, chosen, options, where);
  if (table.rows.size() < kFewestPlaces) {
    throw InputError(fmt::format("{}: {} places; at least {} are required", where, table.rows.size(), kFewestPlaces));
  }
  ProfileText profile{units.quantity, {},          {},   choice.shown(chosen.place), choice.shown(chosen.value),
                      units.place,    units.value, false};
  const ValueRange& range = units.quantity == ProfileQuantity::Slope ? kSlopeRange : ranges::kHeight;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double x = units.mm * table.rows[i][chosen.place], value = units.factor * table.rows[i][chosen.value];
    if (!ranges::kPlace.holds(x)) refuse_number("place", x, ranges::kPlace, where, table.lines[i]);
    if (!range.holds(value)) refuse_number("value", value, range, where, table.lines[i]);
    profile.x.push_back(x);
    profile.values.push_back(value);
  }
  sort_places(profile, table.lines, where);
  return profile;
}

std::string profile_csv(const LineProfile& profile, const std::string& remark) {
  const bool slope = profile.measured == ProfileQuantity::Slope;
  fmt::memory_buffer buffer;
  auto out = std::back_inserter(buffer);
  fmt::format_to(out, "# {}\nx_mm,{}\n", remark, slope ? "slope_urad,height_nm" : "height_nm,slope_urad");
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    const double first = slope ? profile.slope[i] : profile.height[i],
                 second = slope ? profile.height[i] : profile.slope[i];
    fmt::format_to(out, "{},{},{}\n", profile.x[i], first, second);
  }
  return fmt::to_string(buffer);
}

}  // namespace dwell
