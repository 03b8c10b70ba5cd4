#include "core/form/form_terms.h"

#include <fmt/format.h>

#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {

FormTerms parse_form_terms(const std::string& text) {
  FormTerms terms;
  if (trim(text) == "none") return terms;
  for (const std::string_view field : split(text, ',')) {
    const std::string_view word = trim(field);
    if (word == "piston") {
      terms.piston = true;
    } else if (word == "tilt") {
      terms.tilt = true;
    } else if (word == "power") {
      terms.power = true;
    } else if (word == "astigmatism") {
      terms.astigmatism = true;
    } else {
      throw InputError(
          fmt::format("form term '{}' in '{}' is unknown; accepted: piston, tilt, power, astigmatism "
                      "separated by commas, or none alone",
                      word, text));
    }
  }
  return terms;
}

std::string to_string(const FormTerms& terms) {
  std::string text;
  const auto add = [&](bool present, const char* word) {
    if (present) text += (text.empty() ? "" : ",") + std::string(word);
  };
  add(terms.piston, "piston");
  add(terms.tilt, "tilt");
  add(terms.power, "power");
  add(terms.astigmatism, "astigmatism");
  return text.empty() ? "none" : text;
}

}  // namespace dwell
