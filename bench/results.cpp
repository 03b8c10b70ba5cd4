#include "bench/results.h"

#include <fmt/format.h>

namespace dwell::bench {

nlohmann::json to_json(const Machine& m) {
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

}  // namespace dwell::bench
