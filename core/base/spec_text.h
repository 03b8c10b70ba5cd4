#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/point.h"
#include "core/base/value_range.h"

namespace dwell {

/// What a user wrote as "kind:key=value,key=value" or just "kind", for instance "gaussian:peak=1,fwhm=2.8,radius=5".
/// Every lookup throws InputError naming the field, the whole text, the key, its value and what is accepted.
struct SpecText {
  std::string field;                                         // what messages call it: "path", "tif"
  std::string text;                                          // as given
  std::string kind;                                          // before the first colon
  std::vector<std::pair<std::string, std::string>> entries;  // key and value, in the order given

  bool has(std::string_view key) const;
  std::optional<std::string> word(std::string_view key) const;

  /// A number, possibly infinite, never NaN, else within ranges::kNumber; a narrower range is for the caller to check.
  double number(std::string_view key) const;                           // required
  double number(std::string_view key, const ValueRange& range) const;  // required, within the range
  double number(std::string_view key, double fallback) const;          // fallback if the key is not given
  std::optional<double> optional_number(std::string_view key) const;

  /// One of a few words; the first if the key is not given.
  std::string choice(std::string_view key, std::initializer_list<std::string_view> accepted) const;

  /// A point [mm] written X/Y.
  std::optional<Point> optional_point(std::string_view key) const;

  /// Throws that the value of a key is not what is required.
  [[noreturn]] void reject(std::string_view key, std::string_view required) const;

  /// Throws if a key is not among those accepted.
  void accept_only(std::initializer_list<std::string_view> keys) const;
  void accept_only(const std::vector<std::string>& keys) const;
};

/// Splits the text. Throws InputError if the kind is empty, an entry is not key=value, or a key is given twice.
SpecText parse_spec_text(const std::string& text, const std::string& field);

/// The part before the first colon, and all that follows it (empty without a colon).
std::pair<std::string, std::string> split_kind(const std::string& text);

}  // namespace dwell
