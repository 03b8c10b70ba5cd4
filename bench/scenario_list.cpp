#include "bench/scenario_list.h"

#include "bench/made_up_mirrors.h"
#include "bench/measured_mirrors.h"

namespace dwell::bench {

std::vector<Scenario> scenarios(const std::filesystem::path& data) {
  std::vector<Scenario> all;
  append_made_up_mirrors(all);
  append_measured_mirrors(all, data);
  return all;
}

}  // namespace dwell::bench
