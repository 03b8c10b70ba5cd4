#include "bench/plan_targets.h"

#include <fmt/format.h>

#include <limits>

#include "bench/json_access.h"

namespace dwell::bench {
namespace {

using Json = nlohmann::json;

constexpr double kUdoSeconds = 0.5, kUdoPlanSeconds = 2.0;
constexpr double kOneProcessorRatio = 1.3;
constexpr double kUdoStep = 0.0040, kUdoResidual = 0.155, kUdoTotal = 425.0;    // [s], [nm], [s]
constexpr double kNarrowSeconds = 20.0, kNarrowGib = 4.0, kWideSeconds = 30.0;  // whole plans of 4096^2
constexpr double kLargestGib = 16.0;                                            // a map of 16384^2
constexpr double kInterruptSeconds = 0.5;
constexpr double kPlanThreadRatio = 1.6;

/// The solve of a whole plan on one thread over that on two.
TargetLine plan_thread_line(const Json& all, const std::string& name) {
  TargetLine line{fmt::format("2 threads against 1, {}, solve of `dwell plan`", name),
                  fmt::format(">= {:g}", kPlanThreadRatio), "", Verdict::NotMeasured};
  const Json one = find_plan(all, name + "-1-thread"), two = find_plan(all, name);
  if (!one.contains("solver_seconds") || !two.contains("solver_seconds")) return line;
  const double ratio = number(one, "solver_seconds") / number(two, "solver_seconds");
  line.seen =
      fmt::format("{:.2f} ({:.3g} s, {:.3g} s)", ratio, number(one, "solver_seconds"), number(two, "solver_seconds"));
  line.verdict = at_least(ratio, kPlanThreadRatio);
  return line;
}

TargetLine interrupt_line(const Json& all, const std::string& name) {
  TargetLine line{"from a running `dwell plan` to its exit after an interrupt",
                  fmt::format("<= {:g} s", kInterruptSeconds), "", Verdict::NotMeasured};
  const Json plan = find_plan(all, name);
  if (!plan.contains("to_exit_seconds")) return line;
  line.seen = fmt::format("{:.2f} s", number(plan, "to_exit_seconds"));
  line.verdict = at_most(number(plan, "to_exit_seconds"), kInterruptSeconds);
  return line;
}

TargetLine udo_line(const Json& all) {
  TargetLine line{"udo-raster: solve to the smooth optimum, 2 threads",
                  fmt::format("<= {:g} s; step <= {:g} s, residual <= {:g} nm, total <= {:g} s", kUdoSeconds, kUdoStep,
                              kUdoResidual, kUdoTotal),
                  "", Verdict::NotMeasured};
  const Json plan = find_plan(all, "udo-raster");
  if (plan.is_null() || !plan.contains("solver_seconds")) return line;
  const double seconds = number(plan, "solver_seconds"), step = number(plan, "step_rms"),
               residual = number(plan, "residual_rms"), total = number(plan, "total_dwell");
  line.seen = fmt::format("{:.3g} s; {:.4f} s, {:.4f} nm, {:.1f} s", seconds, step, residual, total);
  line.verdict = worse(worse(at_most(seconds, kUdoSeconds), at_most(step, kUdoStep)),
                       worse(at_most(residual, kUdoResidual), at_most(total, kUdoTotal)));
  return line;
}

TargetLine plan_line(const Json& all, const std::string& name, double seconds_limit, double gib_limit) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  TargetLine line{fmt::format("whole `dwell plan`, {}", name), "", "", Verdict::NotMeasured};
  const bool memory = gib_limit < kAny;
  line.target = seconds_limit < kAny ? fmt::format("<= {:g} s", seconds_limit) : "done";
  if (memory) line.target += fmt::format(", <= {:g} GiB", gib_limit);
  const Json plan = find_plan(all, name);
  if (!plan.contains("seconds") && !plan.contains("failed")) return line;
  if (plan.contains("failed")) {
    line.seen = text_of(plan, "failed");
    line.verdict = Verdict::Missed;
    return line;
  }
  const double seconds = number(plan, "seconds"), gib = number(plan, "peak_memory") / 0x1p30;
  line.seen = memory ? fmt::format("{:.1f} s, {:.2f} GiB", seconds, gib) : fmt::format("{:.2f} s", seconds);
  line.verdict = at_most(seconds, seconds_limit);
  if (memory) line.verdict = worse(line.verdict, at_most(gib, gib_limit));
  return line;
}

TargetLine one_processor_line(const Json& all) {
  TargetLine line{"2 threads over 1 where one processor is to be had, CPU seconds of a plan",
                  fmt::format("<= {:g}", kOneProcessorRatio), "", Verdict::NotMeasured};
  const Json one = find_plan(all, "one-processor-1-thread"), two = find_plan(all, "one-processor-2-threads");
  if (!one.contains("cpu_seconds") || !two.contains("cpu_seconds")) return line;
  const double alone = number(one, "cpu_seconds"), both = number(two, "cpu_seconds");
  line.seen = fmt::format("{:.2f} ({:.2f} s, {:.2f} s)", both / alone, both, alone);
  line.verdict = at_most(both / alone, kOneProcessorRatio);
  return line;
}

}  // namespace

Json find_plan(const Json& all, const std::string& name) {
  for (const Json& plan : list_of(all, "plans")) {
    if (text_of(plan, "name") == name) return plan;
  }
  return {};
}

std::vector<TargetLine> plan_target_lines(const Json& all) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  return {plan_line(all, "4096-narrow-moving", kNarrowSeconds, kNarrowGib),
          plan_line(all, "4096-wide-stop", kWideSeconds, kAny),
          plan_line(all, "4096-wide-moving", kWideSeconds, kAny),
          plan_thread_line(all, "4096-narrow-moving"),
          plan_thread_line(all, "4096-wide-moving"),
          plan_line(all, "16384-every-16", kAny, kLargestGib),
          interrupt_line(all, "4096-interrupted"),
          udo_line(all),
          plan_line(all, "udo-raster", kUdoPlanSeconds, kAny),
          one_processor_line(all)};
}

}  // namespace dwell::bench
