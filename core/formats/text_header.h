#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/formats/header_roles.h"
#include "core/formats/map_header.h"
#include "core/formats/said_layout.h"

namespace dwell {

/// Collects what the comment lines of a text map, or the names of its columns, say about it, in the spellings of many
/// programs (docs/formats.md, "What a file may say of itself"): the unit of the values, pitch, size of the field,
/// origin, the value that stands for no data, and how the map was made. What looks like one of these and cannot be
/// understood is refused at once (InputError naming line, key, value and what is accepted), or kept as unclear for
/// whoever knows the options. What no rule has understood is scanned by the last guard (core/formats/remark_guard.h);
/// every other comment means nothing.
class TextHeader {
 public:
  /// `where` begins messages, as in "map a.csv".
  explicit TextHeader(std::string where) : where_(where), layout_(std::move(where)) {}

  /// Takes one comment line, from its '#'.
  void read_comment(std::string_view text, long line);

  /// A unit of the values, or of x and y, that `key` states; it must agree with what was said before.
  void take_unit(std::string_view unit, const std::string& key);
  void take_lateral_unit(std::string_view unit, const std::string& key);
  void set_line(long line) { line_ = line; }
  void add_unclear(UnclearStatement::About about, const std::string& message);

  /// What was said of a matrix of this size. Throws InputError if a field size disagrees with the pitch.
  MapHeader header_of_matrix(Index rows, Index cols) const;
  /// What was said of points: their coordinates tell size, pitch and origin. A unit that may be that of the places is
  /// left open where these would make a `huge` part.
  MapHeader header_of_points(bool huge) const;
  /// The unit of coordinates and lengths without one of their own [nm].
  std::optional<double> lateral_unit() const { return lateral_; }

 private:
  void read_statement(std::string_view text);
  bool read_loose(std::string_view text);
  bool read_captions(std::string_view text);
  void take_caption(const HeaderKey& key);
  bool take(HeaderKey key, std::string_view value, bool loose);
  bool take_value_unit(const HeaderKey& key, std::string_view value, bool sure);
  bool take_lateral(const HeaderKey& key, std::string_view value, bool sure);
  bool take_pitch(const HeaderKey& key, std::string_view value, InText trust);
  bool take_size(const HeaderKey& key, std::string_view value);
  bool take_origin(const HeaderKey& key, std::string_view value, bool sure);
  bool take_offset(const HeaderKey& key, std::string_view value, bool moves);
  bool take_start(const HeaderKey& key, std::string_view value);
  bool take_interval(const HeaderKey& key, const HeaderLengths& lengths, std::string_view value);
  bool take_no_data(const HeaderKey& key, std::string_view value, bool sure, bool named);
  bool take_scale(const HeaderKey& key, std::string_view value, bool loose);
  bool take_axis_claim(const HeaderKey& key, std::string_view value);
  bool take_orientation(const HeaderKey& key, std::string_view value, MapTopic topic);
  bool take_unknown_unit(const HeaderKey& key, std::string_view value);
  bool take_prose_pitch(const HeaderKey& key, std::string_view value);
  void guard(std::string_view text);
  bool read_tabbed(std::string_view comment);
  bool read_fields(std::string_view text);
  double unit_of_lengths(const HeaderKey& key, std::string_view value, const HeaderLengths& lengths) const;
  void only_once(const HeaderKey& key, MapTopic topic);
  [[noreturn]] void refuse(const HeaderKey& key, std::string_view value, const std::string& required) const;
  std::string place() const;
  std::string where_;
  long line_ = 0;
  MapHeader header_;
  std::string unit_key_, lateral_key_;
  std::string of_everything_;  // why the unit of the values may be that of places too; empty: it is not
  std::optional<double> unit_factor_, lateral_;
  SaidLayout layout_;
  std::map<std::string, long> seen_;  // topic and name of what was said: line
};

}  // namespace dwell
