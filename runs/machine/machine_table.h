#pragma once

#include <toml++/toml.h>

#include <string>

#include "runs/machine/machine_fields.h"

namespace dwell {

/// The machine of a table with the fields of a machine file, from that file or from the section `machine` of another;
/// `source` begins messages, in which the line comes next if `says_lines`. Throws InputError naming source, line,
/// field, value and what is accepted: an unknown field or section, a value of another type or out of range, two fields
/// that contradict each other.
NamedMachine machine_of_table(const toml::table& table, const std::string& source, bool says_lines = true);

/// Such a table as a text in one line, in braces, with every value as it stands there.
std::string inline_machine_text(const toml::table& table);

}  // namespace dwell
