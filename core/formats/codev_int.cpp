#include "core/formats/codev_int.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/text_grid.h"
#include "core/formats/wavefront_words.h"

namespace dwell {
namespace {

constexpr char kCodevComment = '!';

std::string_view first_word(std::string_view line) {
  line = trim(line);
  return line.substr(0, line.find_first_of(" \t"));
}

/// The line that says what the data are; false if there is none. The title before it may be missing.
bool find_data_line(TextLines& lines) {
  for (int candidates = 0; candidates < 2 && lines.next();) {
    if (lines.line().starts_with(kCodevComment)) continue;
    ++candidates;
    const std::string_view word = first_word(lines.line());
    TextLines below = lines;  // a title may begin like a data line
    const bool is_title = candidates == 1 && below.next() && first_word(below.line()) == "GRD";
    if ((word == "GRD" || word == "ZFR" || word == "ZRN") && !is_title) return true;
  }
  return false;
}

/// What the data line says.
struct DataLine {
  TextGrid grid;
  std::optional<double> wavelength_um, scale, no_data, x_scale;
  bool wavefront = false;  // WFR in place of SUR
};

class DataLineReader {
 public:
  DataLineReader(std::string_view line, std::string place) : rest_(line), place_(std::move(place)) {}

  DataLine read() {
    if (next_word() != "GRD") refuse("kind of data", word_, "GRD (a grid; Zernike coefficients are not read)");
    data_.grid.top_first = true;
    data_.grid.cols = count("number of columns");
    data_.grid.rows = count("number of rows");
    check_quantity();
    while (!next_word().empty()) take_field();
    require("WVL", data_.wavelength_um.has_value(), "the wavelength in um");
    require("SSZ", data_.scale.has_value(), "the value of one wavelength");
    return data_;
  }

 private:
  [[noreturn]] void refuse(std::string_view field, std::string_view value, std::string_view required) const {
    throw InputError(fmt::format("{}: {} = {}; required: {}", place_, field, in_quotes(value), required));
  }

  std::string_view next_word() {
    rest_ = trim(rest_);
    word_ = first_word(rest_);
    rest_.remove_prefix(word_.size());
    return word_;
  }

  Index count(const char* what) {
    const std::optional<Index> number = parse_count(next_word());
    if (!number) refuse(what, word_, "a whole number >= 1");
    return *number;
  }

  void check_quantity() {
    data_.wavefront = next_word() == "WFR";
    if (word_ == "SUR" || data_.wavefront) return;
    refuse("quantity", word_, "SUR, a surface, or WFR, a wavefront (filters, coatings, birefringence are no heights)");
  }

  void take_field() {
    const std::string_view field = word_;
    if (field == "NNB" || field == "NNR") return;  // how Code V interpolates
    if (field == "WVL")
      return take(
          data_.wavelength_um, field, [](double v) { return v >= 0.1 && v <= 20.0; },
          "from 0.1 to 20 [um]; 632.8 nm are 0.6328");
    if (field == "SSZ")
      return take(
          data_.scale, field, [](double v) { return v != 0.0; }, "finite, not 0");
    if (field == "NDA")
      return take(
          data_.no_data, field, [](double) { return true; }, "a finite number");
    if (field == "XSC") {
      return take(
          data_.x_scale, field, [](double v) { return v == 1.0; }, "1, as pixels must be square here");
    }
    refuse("field", field, "WVL, SSZ, NDA, XSC or NNB");
  }

  template <class Accept>
  void take(std::optional<double>& slot, std::string_view field, Accept accept, const char* required) {
    if (slot) refuse("field", field, "each once");
    slot = finite_number(next_word());
    if (!slot || !accept(*slot)) refuse(field, word_, required);
  }

  void require(const char* field, bool given, const char* meaning) const {
    if (!given) throw InputError(fmt::format("{}: {} ({}) is missing", place_, field, meaning));
  }

  std::string_view rest_, word_;
  std::string place_;
  DataLine data_;
};

/// A surface is given in waves of height. Of a wavefront only whoever measured it knows the height.
void add_waves(const DataLine& data, const std::string& place, MapHeader& header) {
  header.wavelength = *data.wavelength_um * units::kNmPerUm;
  header.from_waves = true;
  header.wave_field = data.wavefront ? "the data line (WFR, WVL)" : "the data line (SUR, WVL)";
  if (!data.wavefront) header.wave_scale = 1.0;
  if (data.wavefront) note_wavefront("WFR", place, "WFR, the quantity,", header);
}

}  // namespace

bool is_codev_int(std::string_view text) {
  TextLines lines(text);
  return find_data_line(lines);
}

MapSource parse_codev_int(std::string_view text, const std::string& where, const PixelLimit& limit) {
  TextLines lines(text);
  if (!find_data_line(lines)) {
    throw InputError(fmt::format(
        "{}: no Code V interferogram; after comment lines (!) and a title, a line 'GRD columns rows SUR WVL w SSZ s' "
        "is required",
        where));
  }
  DataLine data = DataLineReader(lines.line(), fmt::format("{}, line {}", where, lines.number())).read();
  constexpr double kDefaultNoData = 32767.0;
  const double no_data = data.no_data.value_or(kDefaultNoData);
  MapSource source;
  add_waves(data, fmt::format("{}, line {}", where, lines.number()), source.header);
  const double nm = *data.wavelength_um * units::kNmPerUm / *data.scale;
  if (!std::isfinite(nm)) throw InputError(fmt::format("{}: WVL / SSZ is beyond any height", where));
  data.grid.limit = limit;
  data.grid.no_data = fmt::format("{} (NDA)", no_data);
  TextWords words(lines, kCodevComment);
  source.rows = data.grid.rows;
  source.cols = data.grid.cols;
  source.header.unit = "nm";
  source.raw_factor = nm;
  source.values = read_text_grid(
      words, data.grid, text.size(),
      [&](std::string_view word) {
        std::optional<double> value = finite_number(word);
        if (value) value = *value == no_data ? std::numeric_limits<double>::quiet_NaN() : *value * nm;
        return value;
      },
      where);
  if (words.next()) {
    throw InputError(fmt::format("{}, line {}: {} follows the {} of {} values; nothing more is accepted", where,
                                 words.line(), in_quotes(words.word()), counted(source.rows, "row"), source.cols));
  }
  return source;
}

}  // namespace dwell
