#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "runs/job/job.h"

namespace dwell {

/// What a job aims at: to remove a fraction of the error, form terms aside.
struct CorrectionAim {
  double fraction = 1.0;
  double would_remain_rms = 0.0;  // on the part if the aim were met exactly [nm], about the mean
  const char* about = "";         // says so in words where that is another than about zero
};

CorrectionAim correction_aim(const Job& job);

/// The line of a table that says so, beginning with "aim" and ending with a new line; empty where all of the error is
/// to be removed.
std::string aim_line(const CorrectionAim& aim);

/// "fraction", "would_remain_rms_nm".
nlohmann::ordered_json aim_block(const CorrectionAim& aim);

}  // namespace dwell
