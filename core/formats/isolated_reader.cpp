#include "core/formats/isolated_reader.h"

#include <fmt/format.h>

#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "core/base/child_process.h"
#include "core/base/doubles_of_bytes.h"
#include "core/base/errors.h"

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

void put_map(const MapSource& source, Writer& out) {
  out.put(Outcome::Map);
  out.put(source.rows);
  out.put(source.cols);
  out.put(source.header.pitch.has_value());
  out.put(source.header.pitch.value_or(Point{}));
  out.put(source.header.origin.has_value());
  out.put(source.header.origin.value_or(Point{}));
  out.put(source.header.unit.has_value());
  out.put_text(source.header.unit.value_or(""));
  out.put(source.raw_factor);
  out.put(source.header.no_data.size());
  for (const double marker : source.header.no_data) out.put(marker);
  out.put(source.header.history.size());
  for (const std::string& step : source.header.history) out.put_text(step);
  out.put_text(source.pitch_hint);
  out.put(source.camera_pixel);
  out.put_values(source.values);
}

MapSource source_of(Reader& in) {
  MapSource source;
  source.rows = in.get<Index>();
  source.cols = in.get<Index>();
  const bool has_pitch = in.get<char>() != 0;
  const Point pitch = in.get<Point>();
  if (has_pitch) source.header.pitch = pitch;
  const bool has_origin = in.get<char>() != 0;
  const Point origin = in.get<Point>();
  if (has_origin) source.header.origin = origin;
  const bool has_unit = in.get<char>() != 0;
  const std::string unit = in.text();
  if (has_unit) source.header.unit = unit;
  source.raw_factor = in.get<double>();
  for (auto markers = in.get<std::size_t>(); markers > 0; --markers) {
    source.header.no_data.push_back(in.get<double>());
  }
  for (auto steps = in.get<std::size_t>(); steps > 0; --steps) source.header.history.push_back(in.text());
  source.pitch_hint = in.text();
  source.camera_pixel = in.get<Point>();
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

}  // namespace

MapSource read_isolated(const std::function<MapSource()>& read, std::size_t bytes, const std::string& format,
                        const std::string& where) {
  constexpr double kSeconds = 2.0, kBytesPerSecond = 4e6;
  constexpr std::size_t kMemory = std::size_t{4} << 30, kMemoryPerByte = 16;
  const ChildLimits limits{kSeconds + static_cast<double>(bytes) / kBytesPerSecond, kMemory + kMemoryPerByte * bytes};
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
