#include "runs/job/option_flags.h"

#include <algorithm>

namespace dwell {

std::string flag_of(const std::string& plain_name) {
  std::string flag = "--" + plain_name;
  std::replace(flag.begin(), flag.end(), ' ', '-');
  return flag;
}

InputError with_flags(const InputError& error) { return error.renamed(flag_of); }

}  // namespace dwell
