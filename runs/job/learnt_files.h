#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/grid.h"
#include "core/map/height_map.h"

namespace dwell {

/// The files of a plan's folder that hold what logs have taught of its path.
inline constexpr const char* kLateFile = "learnt.csv";
inline constexpr const char* kLearntRemovalFile = "learnt_removal.npy";
inline constexpr const char* kLearntRemovalSidecar = "learnt_removal.npy.json";

/// What a plan's folder says of what logs have taught: of every step of its program by how much it takes longer than
/// the machine is thought to need [s], and what its motion removes beyond that [nm].
struct LearntFiles {
  std::vector<double> late;
  HeightMap removal;
  int logs = 0;
  std::string machine_sha256;  // of the machine beyond which it is (sha256_of_machine)
};

/// A plan's program, which is as the plan has left it.
struct PlanOnDisk {
  std::filesystem::path program;
  std::string program_sha256;
};

/// The text of kLateFile. `stroke`, `late`: of every step of the program [s]; strokes count from 0, in the file from 1.
std::string late_text(const std::vector<Index>& stroke, const std::vector<double>& late);

/// The same read: of every step [s]. Throws InputError naming `file`, line, value and what is required.
std::vector<double> parse_late_text(std::string_view text, const std::string& file);

/// Throws InputError for a folder that is no plan's, and for a program that has changed since the plan was made.
PlanOnDisk read_plan_on_disk(const std::filesystem::path& folder);

/// What a plan's folder has learnt; nothing where its summary says nothing of it. Throws InputError for a folder that
/// is no plan's, and for files that are not there or have changed since the plan was made.
std::optional<LearntFiles> read_learnt_files(const std::filesystem::path& folder);

}  // namespace dwell
