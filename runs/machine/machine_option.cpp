#include "runs/machine/machine_option.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "runs/machine/machine_file.h"
#include "runs/machine/machine_table.h"

namespace dwell {

bool is_inline_machine(std::string_view option) { return trim(option).starts_with('{'); }

NamedMachine machine_of_option(const std::string& option) {
  if (!is_inline_machine(option)) return read_machine_file(option);
  constexpr const char* kSource = "machine";
  try {
    const toml::table table = toml::parse(fmt::format("{} = {}", kSource, trim(option)));
    if (const toml::table* machine = table[kSource].as_table(); machine != nullptr && table.size() == 1)
      return machine_of_table(*machine, "the fields", false);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: {}", trim(option), std::string(error.description())));
  }
  throw InputError(fmt::format("{}: required one table in braces", trim(option)));
}

}  // namespace dwell
