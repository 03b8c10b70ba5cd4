#include "bench/results.h"

#include <fmt/format.h>

#include <cmath>

#include "bench/json_access.h"

namespace dwell::bench {

nlohmann::json to_json(const Computer& m) {
  return {{"processor", m.processor}, {"cores", m.cores},   {"memory_gib", m.memory}, {"compiler", m.compiler},
          {"flags", m.flags},         {"commit", m.commit}, {"fftw", m.fftw},         {"date", m.date}};
}

nlohmann::json to_json(const MicroResult& r) {
  return {{"name", r.name},       {"size", r.size},       {"threads", r.threads}, {"repetitions", r.repetitions},
          {"seconds", r.seconds}, {"fastest", r.fastest}, {"slowest", r.slowest}, {"over_fft", r.over_fft}};
}

std::string micro_table(const nlohmann::json& micro) {
  std::string text =
      "| what | size | threads | median ms | band ms | fastest over its bare FFTW pair "
      "|\n|---|---:|---:|---:|---:|---:|\n";
  for (const auto& r : micro) {
    const double over = r.at("over_fft").get<double>();
    text += fmt::format("| {} | {} | {} | {:.3f} | {:.3f} to {:.3f} | {} |\n", r.at("name").get<std::string>(),
                        r.at("size").get<long>(), r.at("threads").get<int>(), 1e3 * r.at("seconds").get<double>(),
                        1e3 * r.at("fastest").get<double>(), 1e3 * r.at("slowest").get<double>(),
                        over > 0.0 ? fmt::format("{:.2f}", over) : "");
  }
  return text;
}

std::string certificate_table(const nlohmann::json& certificates) {
  std::string text =
      "| scenario | solver | certificate | | pairs: fine + coarse | by the clock | s | gradient at the end | ended by "
      "|\n|---|---|---:|---|---:|---:|---:|---:|---|\n";
  for (const auto& run : certificates) {
    text +=
        fmt::format("| {} | {} | {:.0e} |", text_of(run, "scenario"), text_of(run, "solver"), number(run, "tolerance"));
    if (!run.contains("certificate")) {
      if (run.contains("skipped")) text += fmt::format(" skipped: {} | | | | | |\n", text_of(run, "skipped"));
      for (const char* why : {"refused", "late", "failed"}) {
        if (run.contains(why)) text += fmt::format(" {} | | | | | |\n", text_of(run, why));
      }
      continue;
    }
    const double fine = 0.5 * number(run, "applications"), coarse = number(run, "coarse_pairs");
    text += fmt::format(" {} | {:.0f} + {:.0f} = {:.0f} | {:.0f} | {:.3g} | {:.1e} | {} |\n",
                        run.at("certified").get<bool>() ? "reached" : "not reached", fine, coarse, fine + coarse,
                        number(run, "seconds") / number(run, "pair_seconds"), number(run, "seconds"),
                        number(run.at("certificate"), "projected_gradient"), text_of(run, "status"));
  }
  return text;
}

std::string plan_table(const nlohmann::json& plans) {
  std::string text =
      "| plan | what | threads | dwell points | s | of these solving | CPU s | GiB | residual nm | total s | solver |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---|\n";
  for (const auto& plan : plans) {
    text +=
        fmt::format("| {} | {} | {} |", text_of(plan, "name"), text_of(plan, "what"), plan.at("threads").get<int>());
    if (plan.contains("to_exit_seconds")) {
      text += fmt::format(" ended {:.2f} s after the interrupt | | | | | | | |\n", number(plan, "to_exit_seconds"));
      continue;
    }
    if (!plan.contains("seconds")) {
      const char* why = plan.contains("failed") ? "failed" : "skipped";
      text += fmt::format(" {}: {} | | | | | | | |\n", why, text_of(plan, why));
      continue;
    }
    const bool solved = plan.contains("solver_seconds");
    text += fmt::format(" {} | {:.3g} | {} | {:.3g} | {:.2f} | {:.4g} | {:.5g} | {} |\n",
                        solved ? fmt::format("{}", plan.at("points").get<long>()) : "", number(plan, "seconds"),
                        solved ? fmt::format("{:.3g}", number(plan, "solver_seconds")) : "",
                        number(plan, "cpu_seconds"), number(plan, "peak_memory") / 0x1p30, number(plan, "residual_rms"),
                        number(plan, "total_dwell"), solved ? text_of(plan, "status") : "simulated");
  }
  return text;
}

std::string blemish_table(const nlohmann::json& plans) {
  std::string text =
      "| udo-raster, RMS nm, piston and tilt removed | all pixels | without blemishes | total s "
      "|\n|---|---:|---:|---:|\n"
      // Public data, its README: no program of ours made these two.
      "| published dwell, as its authors state it (a dot a point; without the speck alone) | 0.2048 | 0.1585 | 488.7 "
      "|\n";
  for (const auto& plan : plans) {
    if (!text_of(plan, "name").starts_with("udo-") || !plan.contains("residual_rms")) continue;
    const double without = number(plan, "without_blemishes");
    text += fmt::format("| {} | {:.4f} | {} | {:.1f} |\n", text_of(plan, "what"), number(plan, "residual_rms"),
                        std::isfinite(without) ? fmt::format("{:.4f}", without) : "none found",
                        number(plan, "total_dwell"));
  }
  return text;
}

}  // namespace dwell::bench
