#include "core/formats/hdf5_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

constexpr int kBitsPerByte = 8;
constexpr std::size_t kSingle = 4;  // bytes

class PackingReader {
 public:
  PackingReader(const Hdf5File& file, const std::string& path, const Hdf5Numbers& numbers, const std::string& where)
      : file_(file), path_(path), numbers_(numbers), where_(where) {}

  PackedValues read(const std::vector<double>& no_data) {
    const auto scale = one_number("scale_factor"), offset = one_number("add_offset");
    if (scale) packing_.scale = scale->numbers.front();
    if (offset) packing_.offset = offset->numbers.front();
    if (packing_.scale == 0.0) refuse("scale_factor", *scale, "a finite number, not 0,");
    packed_bytes_ = std::max(scale ? scale->floating_bytes : 0, offset ? offset->floating_bytes : 0);
    read_sign();
    read_range();
    add_markers("_FillValue");
    add_markers("missing_value");
    for (const double value : no_data) add_marker({"no data", value});
    if (numbers_.fill && *numbers_.fill != 0.0) add_marker({"the data set's fill value", *numbers_.fill});
    return packing_;
  }

 private:
  [[noreturn]] void refuse(const std::string& name, const Hdf5Value& value, const char* required) const {
    std::string shown;
    for (const double number : value.numbers) shown += fmt::format("{}{}", shown.empty() ? " = " : ", ", number);
    for (const std::string& text : value.texts)
      shown += fmt::format("{}{}", shown.empty() ? " = " : ", ", in_quotes(text));
    throw InputError(
        fmt::format("{}: attribute {} of HDF5 data set '{}'{}; {} required", where_, name, path_, shown, required));
  }

  /// The attribute, which if it is there must hold as many numbers.
  std::optional<Hdf5Value> known(const std::string& name, std::size_t least, std::size_t most, bool finite,
                                 const char* required) const {
    if (!file_.has_attribute(path_, name)) return std::nullopt;
    const Hdf5Value value = file_.attribute(path_, name).value_or(Hdf5Value{});
    const std::size_t count = value.numbers.size();
    const bool sound =
        value.texts.empty() && count >= least && count <= most &&
        (!finite || std::all_of(value.numbers.begin(), value.numbers.end(), [](double v) { return std::isfinite(v); }));
    if (!sound) refuse(name, value, required);
    return value;
  }
  std::optional<Hdf5Value> one_number(const std::string& name) const {
    return known(name, 1, 1, true, "one finite number");
  }

  void read_sign() {
    if (!file_.has_attribute(path_, "_Unsigned")) return;
    const Hdf5Value value = file_.attribute(path_, "_Unsigned").value_or(Hdf5Value{});
    const std::string word = value.texts.size() == 1 ? lower_case(trim(value.texts.front())) : "";
    if (word != "true" && word != "false") refuse("_Unsigned", value, "true or false");
    if (numbers_.floating) return;
    const int bits = static_cast<int>(numbers_.bytes) * kBitsPerByte;
    if (word == "true" && numbers_.with_sign) packing_.other_sign_bits = bits;
    if (word == "false" && !numbers_.with_sign) packing_.other_sign_bits = -bits;
  }

  void read_range() {
    const auto least = one_number("valid_min"), most = one_number("valid_max");
    const auto both = known("valid_range", 2, 2, true, "two finite numbers");
    if (both && (least || most)) refuse("valid_range", *both, "either valid_range or valid_min and valid_max");
    if (least) packing_.least = least->numbers.front();
    if (most) packing_.most = most->numbers.front();
    if (both) packing_.least = both->numbers.front(), packing_.most = both->numbers.back();
    if (packing_.least && packing_.most && *packing_.least > *packing_.most && packing_.other_sign_bits == 0) {
      refuse(both ? "valid_range" : "valid_min", both ? *both : *least, "the smaller number first is");
    }
    for (const auto& value : {least, most, both}) {
      if (value) packing_.range_of_heights = packing_.range_of_heights || is_of_heights(*value);
    }
  }

  bool is_of_heights(const Hdf5Value& range) const {
    const bool wider = !numbers_.floating || numbers_.bytes < range.floating_bytes;
    return range.floating_bytes > 0 && range.floating_bytes == packed_bytes_ && wider;
  }

  void add_markers(const std::string& name) {
    constexpr std::size_t kMost = 1000;
    const auto values = known(name, 1, kMost, false, "numbers are");
    if (!values) return;
    for (const double value : values->numbers) add_marker({name, value});
  }

  void add_marker(const NoDataMarker& marker) {
    const auto same = [&](const NoDataMarker& known) { return known.value == marker.value; };
    const bool there = std::any_of(packing_.no_data.begin(), packing_.no_data.end(), same);
    if (!there && !std::isnan(marker.value)) packing_.no_data.push_back(marker);
  }

  const Hdf5File& file_;
  const std::string& path_;
  const Hdf5Numbers& numbers_;
  const std::string& where_;
  PackedValues packing_;
  std::size_t packed_bytes_ = 0;  // of the wider of scale_factor and add_offset
};

}  // namespace

PackedValues packing_of_data_set(const Hdf5File& file, const std::string& path, const Hdf5Numbers& numbers,
                                 const std::vector<double>& no_data, const std::string& where) {
  return PackingReader(file, path, numbers, where).read(no_data);
}

}  // namespace dwell
