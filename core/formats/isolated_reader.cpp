#include "core/formats/isolated_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "core/base/child_process.h"
#include "core/base/doubles_of_bytes.h"
#include "core/base/errors.h"
#include "core/formats/unpacked_size.h"

namespace dwell {
namespace {

enum class Outcome : char { Map, InputError, NoMemory, Fault };

/// A record of plain values and strings, written and read in the same order by the same program.
class Writer {
 public:
  explicit Writer(const AnswerSink& sink) : sink_(sink) {}
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    sink_({reinterpret_cast<const char*>(&value), sizeof value});
  }
  void put_text(std::string_view text) {
    put(text.size());
    sink_(text);
  }
  void put_values(const std::vector<double>& values) {
    sink_({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
  }

 private:
  const AnswerSink& sink_;
};

/// Takes nothing on trust: the process that wrote the record may have run wild.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T get() {
    T value{};
    const std::string_view bytes = next(sizeof value);
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(next(get<std::size_t>())); }
  /// All the rest.
  std::vector<double> values() { return doubles_of(rest_); }

 private:
  std::string_view next(std::size_t size) {
    if (size > rest_.size()) throw std::runtime_error("the reader in its own process gave half an answer");
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }
  std::string_view rest_;
};

/// Calls put(field) or get(field) with every field but the values, in one order. What a new field of the header or of
/// the source would miss here does not compile.
template <class Source, class Each>
void each_field(Source& source, Each each) {
  auto& [rows, cols, values, raw_factor, header, pitch_hint, pitch_field, unclear_origin, camera_pixel] = source;
  auto& [pitch, origin, unit, no_data, unclear, places_known, history, pitch_rounding, wavelength, wave_scale,
         from_waves, wave_field, other_is_wavefront] = header;
  static_cast<void>(values);  // come last, and fill the rest
  each(rows), each(cols), each(raw_factor), each(no_data), each(pitch_hint), each(pitch_field), each(unclear_origin),
      each(camera_pixel);
  each(pitch), each(origin), each(unit), each(unclear), each(places_known), each(history), each(pitch_rounding);
  each(wavelength), each(wave_scale), each(from_waves), each(wave_field), each(other_is_wavefront);
}

class FieldWriter {
 public:
  explicit FieldWriter(Writer& out) : out_(out) {}
  void operator()(const std::string& text) const { out_.put_text(text); }
  void operator()(const std::vector<std::string>& texts) const {
    out_.put(texts.size());
    for (const std::string& text : texts) out_.put_text(text);
  }
  void operator()(const std::vector<double>& numbers) const {
    out_.put(numbers.size());
    for (const double number : numbers) out_.put(number);
  }
  void operator()(const std::vector<UnclearStatement>& statements) const {
    out_.put(statements.size());
    for (const UnclearStatement& statement : statements) out_.put(statement.about), out_.put_text(statement.message);
  }
  template <class T>
  void operator()(const std::optional<T>& field) const {
    out_.put(field.has_value());
    if (field) (*this)(*field);
  }
  template <class T>
  void operator()(const T& value) const {
    out_.put(value);
  }

 private:
  Writer& out_;
};

class FieldReader {
 public:
  explicit FieldReader(Reader& in) : in_(in) {}
  void operator()(std::string& text) const { text = in_.text(); }
  void operator()(std::vector<std::string>& texts) const {
    for (auto count = in_.get<std::size_t>(); count > 0; --count) texts.push_back(in_.text());
  }
  void operator()(std::vector<double>& numbers) const {
    for (auto count = in_.get<std::size_t>(); count > 0; --count) numbers.push_back(in_.get<double>());
  }
  void operator()(std::vector<UnclearStatement>& statements) const {
    for (auto count = in_.get<std::size_t>(); count > 0; --count) {
      const auto about = in_.get<UnclearStatement::About>();
      statements.push_back({about, in_.text()});
    }
  }
  template <class T>
  void operator()(std::optional<T>& field) const {
    if (in_.get<char>() != 0) (*this)(field.emplace());
  }
  template <class T>
  void operator()(T& value) const {
    value = in_.get<T>();
  }

 private:
  Reader& in_;
};

void put_map(const MapSource& source, Writer& out) {
  out.put(Outcome::Map);
  each_field(source, FieldWriter(out));
  out.put_values(source.values);
}

MapSource source_of(Reader& in) {
  MapSource source;
  each_field(source, FieldReader(in));
  source.values = in.values();
  const auto held = static_cast<Index>(source.values.size());
  if (source.rows < 1 || source.cols < 1 || source.rows > held / source.cols || source.rows * source.cols != held) {
    throw std::runtime_error("the reader in its own process gave a map of another size");
  }
  return source;
}

void put_message(Outcome outcome, std::string_view message, Writer& out) {
  out.put(outcome);
  out.put_text(message);
}

void attempt(const std::function<MapSource()>& read, Writer out) {
  try {
    put_map(read(), out);
  } catch (const InputError& error) {
    put_message(Outcome::InputError, error.what(), out);
  } catch (const std::bad_alloc&) {
    put_message(Outcome::NoMemory, "", out);
  } catch (const std::exception& error) {
    put_message(Outcome::Fault, error.what(), out);
  }
}

/// What a reader may use: a packed file takes time and memory by what it unpacks to.
ChildLimits limits_of(std::size_t bytes, const PixelLimit& limit) {
  constexpr double kSeconds = 2.0, kBytesPerSecond = 4e6, kUnpackedPerSecond = 1e8;
  constexpr std::size_t kMemory = std::size_t{4} << 30, kMemoryPerByte = 16, kMemoryPerPixel = 12;
  const double file = static_cast<double>(bytes);
  const double pixels = std::min(limit.most(), limit.given ? limit.most() : kMostUnpacking * file / sizeof(double));
  const double unpacked = pixels * sizeof(double);
  const auto asked = static_cast<std::size_t>(limit.given.value_or(0.0)) * kMemoryPerPixel;
  return {kSeconds + file / kBytesPerSecond + unpacked / kUnpackedPerSecond, kMemory + kMemoryPerByte * bytes + asked};
}

}  // namespace

MapSource read_isolated(const std::function<MapSource()>& read, std::size_t bytes, const std::string& format,
                        const std::string& where, const PixelLimit& limit) {
  const ChildLimits limits = limits_of(bytes, limit);
  const auto corrupt = [&] {
    return InputError(
        fmt::format("{}: {} of {} bytes is corrupt: its library came to harm reading it, or wanted more than {:.0f} s "
                    "or {:.1f} GiB",
                    where, format, bytes, limits.cpu_seconds, static_cast<double>(limits.bytes) / 0x1p30));
  };
  const auto answer = output_of_child([&](const AnswerSink& sink) { attempt(read, Writer(sink)); }, limits);
  if (!answer || answer->bytes().empty()) throw corrupt();
  Reader in(answer->bytes());
  switch (in.get<Outcome>()) {
    case Outcome::Map:
      return source_of(in);
    case Outcome::InputError:
      throw InputError(in.text());
    case Outcome::NoMemory:
      throw corrupt();
    case Outcome::Fault:
      break;
  }
  throw std::runtime_error(in.text());
}

}  // namespace dwell
