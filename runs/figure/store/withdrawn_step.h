#pragma once

#include <string>

#include "runs/figure/store/figure_state.h"
#include "runs/figure/store/run_folder.h"

namespace dwell {

/// Takes a measurement back: a step is added that marks it, and it stays where it is. The run is then as before that
/// measurement, and the plan that it was of waits for another. `number` is the step's, as status shows it. The caller
/// holds the run's lock. Throws InputError for a step that is no measurement or is withdrawn already, and for one on
/// which a later measurement rests.
const RunStep& withdraw_measurement(RunFolder& run, const FigureState& state, int number, const std::string& why);

}  // namespace dwell
