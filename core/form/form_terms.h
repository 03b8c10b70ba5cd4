#pragma once

#include <string>

namespace dwell {

/// Form terms that a specification does not count: piston (constant), tilt (x and y), power (x^2 + y^2), astigmatism
/// (x^2 - y^2 and 2 x y).
struct FormTerms {
  bool piston = false;
  bool tilt = false;
  bool power = false;
  bool astigmatism = false;

  bool any() const { return piston || tilt || power || astigmatism; }
  friend bool operator==(const FormTerms&, const FormTerms&) = default;
};

/// Parses "piston,tilt,power,astigmatism" in any order, some of them, or "none". Throws InputError naming the unknown
/// word and the accepted ones.
FormTerms parse_form_terms(const std::string& text);
std::string to_string(const FormTerms& terms);  // "piston,tilt", or "none"

}  // namespace dwell
