#include "core/base/number_text.h"
#include "runs/programs/shipped_templates.h"
#include "runs/programs/template_reader.h"
#include "tests/fuzz/fuzz_reader.h"

/// The shipped template whose name stands in the first line reads the others; what it reads is whole.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return dwell::fuzz::read(data, size, [](std::string_view bytes) {
    const std::size_t end = bytes.find('\n');
    const std::string name(dwell::trim(bytes.substr(0, end)));
    if (end == std::string_view::npos || !dwell::is_shipped_template(name)) return;
    const dwell::ProgramTemplate layout = dwell::find_program_template(name);
    const dwell::Program program = dwell::read_by_template(bytes.substr(end + 1), "program", layout);
    dwell::fuzz::require(!program.steps.empty());
    for (const dwell::ProgramStep& step : program.steps) {
      dwell::fuzz::require(step.removes ? step.seconds > 0.0 : step.seconds == 0.0);
      dwell::fuzz::require(!layout.speeds || step.speeds || step.length() == 0.0 || !step.removes);
    }
  });
}
