#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/grid_limit.h"

namespace dwell {

struct Hdf5Member;

/// A small value in an HDF5 file: an attribute or a table. Numbers of any type as doubles, strings without padding; of
/// several elements (or numbers of variable length) all, one after the other. Members of a compound by name.
struct Hdf5Value {
  std::vector<double> numbers;
  std::size_t floating_bytes = 0;  // of each number in the file if these are floating-point, else 0
  bool enumerated = false;         // the numbers stand for words, mostly no and yes
  std::vector<std::string> texts;
  std::vector<Hdf5Member> members;

  /// The member of this name, or null.
  const Hdf5Value* member(std::string_view name) const;
};

struct Hdf5Member {
  std::string name;
  Hdf5Value value;
};

/// How the numbers of a data set are stored.
struct Hdf5Numbers {
  bool floating = false;       // or integers,
  bool with_sign = false;      // which may have one
  std::size_t bytes = 0;       // of each
  std::optional<double> fill;  // what stands where nothing was written, if whoever made the data set chose it
};

/// A two-dimensional array of numbers, row-major.
struct Hdf5Matrix {
  std::size_t rows = 0, cols = 0;
  Hdf5Numbers numbers;
  std::vector<double> values;
};

/// An HDF5 file in memory, open for reading. Only core/hdf5_* knows the HDF5 library.
/// The library is not safe against corrupt files (1.10.8 crashes on one in fifty of a real one with a few bytes
/// changed), so this is for a process of its own (core/formats/isolated_reader.h): it also silences the library's error
/// stack and turns off its plugins and links to other files for good. Throws InputError beginning with `where`.
class Hdf5File {
 public:
  /// `bytes` must outlive the file; they are not copied.
  Hdf5File(std::string_view bytes, std::string where);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Paths of the data sets directly in a group, in order of name; none if there is no such group.
  std::vector<std::string> data_sets_in(const std::string& group) const;

  /// Paths of the two-dimensional data sets of numbers in the whole file, in order of name, each data set once.
  std::vector<std::string> matrices() const;

  /// Paths of the data sets that were attached to an axis of a data set as its scales: 0 = rows, 1 = columns.
  std::vector<std::string> scales_of(const std::string& path, unsigned axis) const;

  /// Names of the attributes of a data set or group, in order; "/" is the file's own group.
  std::vector<std::string> attributes(const std::string& path) const;

  bool has_attribute(const std::string& path, const std::string& name) const;

  /// The attribute of a data set or group; nothing if there is none or it is of a type that has no Hdf5Value.
  std::optional<Hdf5Value> attribute(const std::string& path, const std::string& name) const;

  /// All of a small data set; nothing as for attributes. For tables of names, not for measurements.
  std::optional<Hdf5Value> table(const std::string& path) const;

  /// Reads a data set. Refused: what is no data set, not two-dimensional, not of integers or floating-point numbers;
  /// what is kept in other files, or packed by a filter that is not built in; sizes beyond the limit or of a file that
  /// was made to fill the memory (core/formats/unpacked_size.h); and sizes that the file cannot hold: data or a chunk
  /// of more than 1032 bytes for every byte of the file, which is the most that deflate can pack (1032:1).
  Hdf5Matrix matrix(const std::string& path, const PixelLimit& limit = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What to write: one matrix with its attributes.
struct Hdf5Content {
  std::string path;  // of the data set; groups on the way are made
  std::size_t rows = 0, cols = 0;
  std::span<const double> values;
  std::vector<std::pair<std::string, std::vector<double>>> numbers;
  std::vector<std::pair<std::string, std::string>> texts;
  std::vector<std::pair<std::string, std::vector<std::string>>> lists;  // empty ones are left out
};

/// The bytes of an HDF5 file of that content: 64-bit floating point, contiguous, no times in it, so that equal contents
/// are equal bytes. Throws std::runtime_error if the library fails.
std::string hdf5_bytes(const Hdf5Content& content);

}  // namespace dwell
