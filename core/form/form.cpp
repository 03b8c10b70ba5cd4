#include "core/form/form.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/form/form_polynomials.h"

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

Eigen::MatrixXd form_basis(const Grid& grid, const std::vector<Index>& pixels, const FormTerms& terms,
                           const std::vector<double>& weights, int threads) {
  if (!weights.empty() && weights.size() != pixels.size()) {
    throw std::invalid_argument(
        fmt::format("form_basis: {} weights for {} pixels; one a pixel, or none", weights.size(), pixels.size()));
  }
  return FormPolynomials(grid, pixels, terms, weights, threads).columns();
}

void remove_form(const Eigen::MatrixXd& basis, Eigen::Ref<Eigen::VectorXd> v) {
  // Twice is enough (Giraud et al. 2005): the second pass takes out what rounding in the first left behind.
  for (int pass = 0; pass < 2; ++pass) v -= basis * (basis.transpose() * v);
}

}  // namespace dwell
