#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace dwell::bench {

/// What a run has measured so far, each measurement under a name such as "plans/udo-raster". With a file, each finished
/// one is written to it at once, whole or not at all, so that a run which was ended, however it was, goes on from
/// there.
class Measurements {
 public:
  /// Kept in memory alone.
  Measurements() = default;
  /// Kept in `file` as well. What it holds is taken over if it was measured under the same `circumstances` (an object:
  /// machine, commit, options), as figures of two programs or machines must not stand in one table. Throws InputError
  /// naming the file and the first circumstance that differs, with both values, or what is wrong with the file.
  Measurements(std::filesystem::path file, nlohmann::json circumstances);

  /// The result under that name: the one that the file held, or else that of `measure`, which is kept. What `measure`
  /// throws is passed on, and nothing kept.
  nlohmann::json take(const std::string& name, const std::function<nlohmann::json()>& measure);

  /// How many results the file held at the beginning.
  std::size_t taken_over() const { return taken_over_; }
  /// How long the measurements took whose names begin like this, those taken over included [s].
  double seconds(const std::string& prefix) const;

 private:
  std::filesystem::path file_;  // empty = memory alone
  nlohmann::json circumstances_;
  nlohmann::json kept_ = nlohmann::json::object();
  std::size_t taken_over_ = 0;
};

}  // namespace dwell::bench
