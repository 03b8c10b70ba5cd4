#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/formats/map_io.h"
#include "core/map/height_map.h"
#include "runs/base/input_file.h"

namespace dwell {

/// One argument of a step.
struct MapStepArgument {
  enum class Kind {
    Number,  // finite
    Word,
    Flag,   // given by its name alone
    File,   // the name of a map's file
    Files,  // one or more of them, each standing alone
  };
  std::string name;
  Kind kind;
  std::string value;     // what stands for it in help: "MM"
  std::string help;      // with unit
  std::string fallback;  // what is taken if it is not given; empty = see help
  bool required = false;
};

struct MapStepRecord;

/// A step as a user gave it: known by name, its arguments by theirs, not yet done.
struct MapStep {
  const MapStepRecord* record;
  std::string area;                                        // of a step that takes one
  std::vector<std::pair<std::string, std::string>> given;  // argument and value; a flag's value is empty

  bool has(const std::string& name) const;
  /// The value given, else the fallback of the table, which may be empty.
  std::string word(const std::string& name) const;
  std::optional<double> optional_number(const std::string& name) const;
  /// Throws InputError if neither given nor with a fallback.
  double number(const std::string& name) const;
  /// A whole number from `least` to `most`; throws InputError naming step, argument and value.
  Index whole(const std::string& name, Index least, Index most) const;
  /// "X/Y" [mm].
  std::optional<Point> point(const std::string& name) const;
  /// A pixel pitch [mm]: one number of square pixels, or "X/Y".
  std::optional<Point> pitch(const std::string& name) const;
  std::vector<std::string> values(const std::string& name) const;
  /// Throws InputError that begins with the step as given.
  [[noreturn]] void refuse(const std::string& why) const;
};

/// What a step may need besides the map.
struct MapStepContext {
  MapReadOptions read;             // how the map was read: other maps are read so unless the step says otherwise
  std::vector<InputFile>* inputs;  // files read are appended
  int threads = 1;
  Progress progress;

  const PixelLimit& limit() const { return read.limit; }
};

/// A step that prepares a map. One table (runs/map_steps/map_steps.h) feeds parser, help and documents.
struct MapStepRecord {
  std::string name;
  std::string area;  // what stands for the area that is its one argument; empty = arguments by name
  std::string help;
  std::string example;
  std::vector<MapStepArgument> arguments;
  /// Does it, in place; returns what it did, with counts and units.
  std::string (*run)(HeightMap&, const MapStep&, MapStepContext&);
};

/// Reads "NAME", "NAME:AREA" or "NAME:VALUE,KEY=VALUE,FLAG,...": values without a key are those of the arguments in
/// the order of the table. Throws InputError naming the step and what is accepted.
MapStep parse_map_step(const std::string& text, const std::vector<MapStepRecord>& table);

/// The step as text that parses to it again: with `all`, the arguments in force, fallbacks too.
std::string to_string(const MapStep& step, bool all);

}  // namespace dwell
