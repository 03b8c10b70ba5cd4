#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/axis_letters.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/listed_file.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

/// A file of a plan's program.
struct WrittenProgram {
  std::string file;  // its name in the plan's folder
  std::string bytes;
  std::string word{};  // of its format (ProgramFormat), or of the parts of program.nc
};

/// The two kinds of files that hold one stretch of work each, from one lift of the tool to the next: controllers take
/// them without a height, so that the tool is moved, lowered and lifted between them by other means.
enum class StretchKind { XpsTrajectory, PmacProgram };

/// The stretches of a table as numbered files (program_001.trj, program_001.pmc), and before them their list (xps.csv,
/// pmac.csv): where each begins, how long the lifted way there takes, its time, and the SHA-256 of its file.
std::vector<WrittenProgram> written_stretches(StretchKind kind, const PvtTable& table, const FeedTable& made,
                                              const Progress& progress = {}, AxisLetters letters = {});

/// Whether a text is such a list.
bool is_stretch_list(std::string_view text, StretchKind kind);

/// Reads a list and the files that it names, which lie beside it. Throws InputError naming file, line and what is
/// accepted: another column, a name that is none of a file beside it, a file whose SHA-256 or time is not that of the
/// list, and as the readers of the files.
PvtTable parse_stretch_list(std::string_view text, const std::string& file, StretchKind kind, const ReadBeside& beside,
                            const Progress& progress = {}, AxisLetters letters = {});

}  // namespace dwell
