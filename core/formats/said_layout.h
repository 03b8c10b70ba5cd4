#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/formats/map_header.h"

namespace dwell {

/// Collects where the comments of a text map say that its pixels lie: pitch, size and origin along x and y. Messages
/// begin with `where`.
class SaidLayout {
 public:
  enum class What { Pitch, Size, Origin };
  enum class Axis { X = 0, Y = 1 };

  struct Length {
    double mm = 0.0;
    std::string key;        // as the file calls it, for messages
    double rounding = 0.0;  // relative
  };

  explicit SaidLayout(std::string where) : where_(std::move(where)) {}

  /// Throws InputError that begins with `place` if it was said otherwise before.
  void set(What what, Axis axis, const Length& length, const std::string& place);
  /// A size without a unit, which may be the number of rows or columns; else `message` says that it is unclear.
  void add_counts(const std::vector<double>& numbers, const std::string& message);
  /// A height in a unit of length without a width beside it may be a step of the values; `message` says so.
  void question_height(const std::string& message) { height_message_ = message; }
  /// Gwyddion's size is that of all pixels, from edge to edge; that of others may be from the first to the last.
  void set_gwyddion() { gwyddion_ = true; }

  /// Adds pitch and origin to the header, or what of them is unclear.
  void add_to(MapHeader& header) const;
  /// Adds what sizes say of a matrix. Throws InputError if they disagree with the pitch.
  void add_sizes(MapHeader& header, Index rows, Index cols) const;

 private:
  using Pair = std::optional<Length>[2];
  struct Counts {
    std::vector<double> numbers;
    std::string message;
  };

  std::optional<Point> both(const Pair& pair, UnclearStatement::About about, const char* what, MapHeader& header) const;
  void add_counts_to(MapHeader& header, Index rows, Index cols) const;

  std::string where_;
  Pair pitch_, size_, origin_;
  std::vector<Counts> counts_;
  std::string height_message_;
  bool gwyddion_ = false;
};

/// Whether two statements of a number agree: to `rounding` and 1e-9, relative.
bool statements_agree(double a, double b, double rounding = 0.0);

}  // namespace dwell
