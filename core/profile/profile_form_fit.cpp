#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/errors.h"
#include "core/numerics/dense_solve.h"
#include "core/profile/profile_form.h"

namespace dwell {
namespace {

constexpr double kPerMillionth = 1e6;  // mm -> nm, rad -> urad

/// What is fitted: a curve with parameters (none: known), and beside it Legendre polynomials up to a degree.
struct FormModel {
  std::function<double(const Eigen::VectorXd& parameters, double x)> curve;  // in the unit of the values
  Eigen::VectorXd start, scale;  // of the parameters; what counts as a large change of each
  int polynomials = 0;           // how many: degrees 0 to polynomials - 1
};

struct FormFit {
  Eigen::VectorXd parameters, polynomials;
  std::vector<double> rest;
  double square = 0.0;  // weighted sum
};

/// The profile as the fit sees it.
struct FitPlaces {
  const std::vector<double>& x;
  const std::vector<double>& values;
  std::vector<double> weights;  // square roots of lengths
  double middle, half;          // [mm]
  std::string form;             // for messages

  Eigen::Index size() const { return static_cast<Eigen::Index>(x.size()); }
  double t(std::size_t i) const { return (x[i] - middle) / half; }
};

/// Legendre polynomials of degree 0 to columns - 1, by their recurrence.
Eigen::MatrixXd legendre_columns(const FitPlaces& places, int columns) {
  Eigen::MatrixXd basis(places.size(), columns);
  for (Eigen::Index i = 0; i < places.size(); ++i) {
    const double t = places.t(static_cast<std::size_t>(i));
    double before = 0.0, now = 1.0;
    for (int k = 0; k < columns; ++k) {
      basis(i, k) = now;
      const double next = ((2.0 * k + 1.0) * t * now - k * before) / (k + 1.0);
      before = std::exchange(now, next);
    }
  }
  return basis;
}

Eigen::VectorXd curve_at(const FitPlaces& places, const FormModel& model, const Eigen::VectorXd& parameters) {
  Eigen::VectorXd values(places.size());
  for (Eigen::Index i = 0; i < places.size(); ++i)
    values[i] = model.curve(parameters, places.x[static_cast<std::size_t>(i)]);
  return values;
}

/// Derivatives of the curve by its parameters, for a change of `scale`, by central differences.
Eigen::MatrixXd curve_derivatives(const FitPlaces& places, const FormModel& model, const Eigen::VectorXd& parameters) {
  constexpr double kStep = 1e-4;
  Eigen::MatrixXd columns(places.size(), parameters.size());
  for (Eigen::Index k = 0; k < parameters.size(); ++k) {
    Eigen::VectorXd low = parameters, high = parameters;
    low[k] -= kStep * model.scale[k];
    high[k] += kStep * model.scale[k];
    columns.col(k) = (curve_at(places, model, high) - curve_at(places, model, low)) / (2.0 * kStep);
  }
  return columns;
}

Eigen::MatrixXd weighted(const FitPlaces& places, const Eigen::MatrixXd& columns) {
  const Eigen::Map<const Eigen::VectorXd> weights(places.weights.data(), places.size());
  return weights.asDiagonal() * columns;
}

/// Least squares with columns of one size, so that the rank does not depend on units. Throws if it falls short.
Eigen::VectorXd solve_columns(const FitPlaces& places, const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  constexpr double kRounding = 1e-12;
  Eigen::MatrixXd a = weighted(places, columns);
  Eigen::VectorXd sizes = a.colwise().norm();
  for (Eigen::Index k = 0; k < sizes.size(); ++k) {
    if (sizes[k] > 0.0) a.col(k) /= sizes[k];
  }
  const LeastSquares solution = least_squares(a, weighted(places, values), kRounding);
  if (solution.rank < columns.cols() || !solution.x.allFinite()) {
    throw InputError(fmt::format("form \"{}\": the profile does not determine it; fit less", places.form));
  }
  return solution.x.col(0).cwiseQuotient(sizes);
}

/// The fit of the polynomials beside the curve with these parameters; square NaN where the curve has no value.
FormFit fit_with(const FitPlaces& places, const FormModel& model, const Eigen::MatrixXd& basis,
                 const Eigen::VectorXd& parameters) {
  FormFit fit{parameters, {}, {}, std::nan("")};
  const Eigen::Map<const Eigen::VectorXd> values(places.values.data(), places.size());
  Eigen::VectorXd rest = values - curve_at(places, model, parameters);
  if (!rest.allFinite()) return fit;
  if (basis.cols() > 0) {
    fit.polynomials = solve_columns(places, basis, rest);
    rest -= basis * fit.polynomials;
  }
  fit.rest.assign(rest.data(), rest.data() + rest.size());
  fit.square = weighted(places, rest).squaredNorm();
  return fit;
}

/// One step of Gauss and Newton, halved until it does not make the fit worse; how far it went, in scales.
double step_fit(const FitPlaces& places, const FormModel& model, const Eigen::MatrixXd& basis, FormFit& fit) {
  constexpr int kHalvings = 30;
  Eigen::MatrixXd columns(places.size(), basis.cols() + fit.parameters.size());
  columns << basis, curve_derivatives(places, model, fit.parameters);
  if (!columns.allFinite()) throw InputError(fmt::format("form \"{}\": it ends within the profile", places.form));
  const Eigen::Map<const Eigen::VectorXd> rest(fit.rest.data(), places.size());
  Eigen::VectorXd step = solve_columns(places, columns, rest).tail(fit.parameters.size());
  for (int k = 0; k < kHalvings; ++k, step *= 0.5) {
    FormFit next = fit_with(places, model, basis, fit.parameters + step.cwiseProduct(model.scale));
    if (!(next.square <= fit.square * (1.0 + 1e-12))) continue;
    fit = std::move(next);
    return step.cwiseAbs().maxCoeff();
  }
  return 0.0;  // no smaller step is better: the minimum, to rounding
}

FormFit fit_model(const FitPlaces& places, const FormModel& model) {
  constexpr int kMostSteps = 100;
  constexpr double kConverged = 1e-9;
  if (places.size() < model.polynomials + model.start.size() + 1) {
    throw InputError(fmt::format("form \"{}\": {} parameters, and the profile has {} places; more are required",
                                 places.form, model.polynomials + model.start.size(), places.size()));
  }
  const Eigen::MatrixXd basis = legendre_columns(places, model.polynomials);
  FormFit fit = fit_with(places, model, basis, model.start);
  if (!std::isfinite(fit.square)) {
    throw InputError(fmt::format("form \"{}\": it does not reach from x = {:.6g} to {:.6g} mm, as the profile does",
                                 places.form, places.x.front(), places.x.back()));
  }
  if (model.start.size() == 0) return fit;
  for (int k = 0; k < kMostSteps; ++k) {
    if (step_fit(places, model, basis, fit) <= kConverged) return fit;
  }
  throw InputError(fmt::format("form \"{}\": its fit does not converge; give at=MM or a radius", places.form));
}

/// A sphere: one parameter, its curvature [1/mm], unless the radius is known.
FormModel sphere_model(const FitPlaces& places, const ProfileForm& form, bool slope) {
  const double middle = places.middle;
  const auto value = [middle, slope](double curvature, double x) {
    const double u = x - middle, root = std::sqrt(1.0 - curvature * curvature * u * u);
    return kPerMillionth * curvature * u * (slope ? 1.0 / root : u / (1.0 + root));
  };
  if (form.radius) {
    const double curvature = 1.0 / *form.radius;
    return {[value, curvature](const Eigen::VectorXd&, double x) { return value(curvature, x); }, {}, {}, 0};
  }
  // A plane to begin with; the scale is a sag of a thousandth of the half length.
  return {[value](const Eigen::VectorXd& p, double x) { return value(p[0], x); }, Eigen::VectorXd::Zero(1),
          Eigen::VectorXd::Constant(1, 1e-3 / places.half), 0};
}

struct EllipseFit {
  EllipseMirror mirror;
  double pole;
};

EllipseFit ellipse_of(const ProfileForm& form, const Eigen::VectorXd& parameters, double middle) {
  EllipseFit fit{form.mirror, form.pole.value_or(middle)};
  Eigen::Index k = 0;
  if (form.fit_position) fit.pole = parameters[k++];
  if (form.fit_angle) fit.mirror.grazing = parameters[k++];
  return fit;
}

FormModel ellipse_model(const FitPlaces& places, const ProfileForm& form, bool slope) {
  const double middle = places.middle, side = form.source_high ? -1.0 : 1.0;
  std::vector<double> start, scale;
  if (form.fit_position) start.push_back(form.pole.value_or(middle)), scale.push_back(places.half);
  if (form.fit_angle) start.push_back(form.mirror.grazing), scale.push_back(form.mirror.grazing);
  const auto size = static_cast<Eigen::Index>(start.size());
  return {[form, middle, side, slope](const Eigen::VectorXd& parameters, double x) {
            const EllipseFit fit = ellipse_of(form, parameters, middle);
            const EllipsePoint point = ellipse_at(fit.mirror, side * (x - fit.pole));
            return kPerMillionth * (slope ? side * point.slope : point.height);
          },
          Eigen::Map<Eigen::VectorXd>(start.data(), size), Eigen::Map<Eigen::VectorXd>(scale.data(), size), 0};
}

FormModel model_of(const FitPlaces& places, const ProfileForm& form, bool slope) {
  using Kind = ProfileForm::Kind;
  FormModel model{[](const Eigen::VectorXd&, double) { return 0.0; }, {}, {}, 0};
  if (form.kind == Kind::Sphere) model = sphere_model(places, form, slope);
  if (form.kind == Kind::Ellipse) model = ellipse_model(places, form, slope);
  const int degree = form.kind == Kind::Polynomial ? form.degree : form.kind == Kind::None ? -1 : 1;
  model.polynomials = std::max(slope ? degree : degree + 1, 0);
  return model;
}

FormFit fit_form(const LineProfile& profile, const std::vector<double>& values, const ProfileForm& form) {
  const double first = profile.x.front(), last = profile.x.back();
  FitPlaces places{profile.x, values, place_lengths(profile.x), 0.5 * (first + last), 0.5 * (last - first), form.text};
  for (double& weight : places.weights) weight = std::sqrt(weight);
  const FormModel model = model_of(places, form, profile.measured == ProfileQuantity::Slope);
  FormFit fit = fit_model(places, model);
  if (form.kind == ProfileForm::Kind::Ellipse && form.fit_position) {
    const double pole = ellipse_of(form, fit.parameters, places.middle).pole;
    if (std::abs(pole - places.middle) > 3.0 * places.half) {
      throw InputError(fmt::format(
          "form \"{}\": the fit puts its pole at x = {:.6g} mm, more than a length beside the profile; give at=MM, and "
          "look at the sign of the values and which end of x looks to the source (source=high)",
          form.text, pole));
    }
  }
  return fit;
}

/// What would fit an ellipse at least twice as well: another sign of the values, or the source at the other end.
std::vector<std::string> hints_of(const LineProfile& profile, const ProfileForm& form, double rms) {
  constexpr double kClearly = 0.5;
  const char* const unit = profile.measured == ProfileQuantity::Slope ? "urad" : "nm";
  const std::vector<double> lengths = place_lengths(profile.x);
  std::vector<double> negative = profile.values();
  for (double& value : negative) value = -value;
  std::vector<std::string> hints;
  for (const bool turned : {false, true}) {
    for (const bool other_end : {false, true}) {
      if (!turned && !other_end) continue;
      ProfileForm other = form;
      if (other_end) other.source_high = !form.source_high;
      try {
        const double left =
            rms_about_mean(fit_form(profile, turned ? negative : profile.values(), other).rest, lengths);
        if (!(left < kClearly * rms)) continue;
        const std::string instead = std::isfinite(rms) ? fmt::format(", not {:.4g}", rms) : "";
        hints.push_back(fmt::format("{}{}{} would leave {:.4g} {} RMS{}", turned ? "the other sign of the values" : "",
                                    turned && other_end ? " and " : "",
                                    other_end ? fmt::format("source={}", other.source_high ? "high" : "low") : "", left,
                                    unit, instead));
      } catch (const InputError&) {
        continue;  // it does not fit at all
      }
    }
  }
  return hints;
}

/// What shows that a mirror's form is still in the heights: they span far more than errors of a figure do, and a
/// parabola explains most of it. Nothing where a curved form is taken out.
std::optional<std::string> curved_hint(const LineProfile& profile, const ProfileForm& form) {
  constexpr double kClearly = 0.5, kFigure = 1000.0;  // [nm]
  if (form.kind != ProfileForm::Kind::None && (form.kind != ProfileForm::Kind::Polynomial || form.degree > 1))
    return std::nullopt;
  const auto without = [&profile](int degree) {
    ProfileForm polynomial;
    polynomial.degree = degree;
    return fit_form(profile, profile.values(), polynomial).rest;
  };
  if (profile.x.size() < 5) return std::nullopt;  // a parabola fits too few places whatever they are
  const std::vector<double> lengths = place_lengths(profile.x), level = without(1);
  const double span = profile_figures(line_profile(profile.measured, profile.x, level)).height_pv;
  if (!(span > kFigure) || !(rms_about_mean(without(2), lengths) < kClearly * rms_about_mean(level, lengths)))
    return std::nullopt;
  return fmt::format(
      "the heights span {:.4g} um about a straight line, far more than errors of a figure, and most of it is a curve: "
      "the form of the mirror seems to be in them; take out its sphere, or its ellipse with p, q and angle",
      1e-3 * span);
}

}  // namespace

ProfileRest remove_profile_form(const LineProfile& profile, const ProfileForm& form) {
  using Kind = ProfileForm::Kind;
  const bool slope = profile.measured == ProfileQuantity::Slope;
  FormFit fit;
  try {
    fit = fit_form(profile, profile.values(), form);
  } catch (const InputError& error) {
    const std::vector<std::string> hints = form.kind == Kind::Ellipse
                                               ? hints_of(profile, form, std::numeric_limits<double>::infinity())
                                               : std::vector<std::string>{};
    if (hints.empty()) throw;
    throw InputError(fmt::format("{}; {}", error.what(), hints.front()));
  }
  const double middle = 0.5 * (profile.x.front() + profile.x.back()), half = profile.x.back() - middle;
  ProfileRest rest{line_profile(profile.measured, profile.x, fit.rest), {}, {}, {}, {}, {}};
  const bool level =
      form.kind == Kind::Sphere || form.kind == Kind::Ellipse || (form.kind == Kind::Polynomial && form.degree == 1);
  if (level) rest.tilt = slope ? fit.polynomials[0] : fit.polynomials[1] / half;
  if (form.kind == Kind::Sphere) rest.radius = form.radius ? *form.radius : 1.0 / fit.parameters[0];
  if (form.kind == Kind::Ellipse) {
    const EllipseFit found = ellipse_of(form, fit.parameters, middle);
    rest.pole = found.pole;
    rest.angle = found.mirror.grazing;
    rest.hints = hints_of(profile, form, rms_about_mean(fit.rest, place_lengths(profile.x)));
  }
  if (auto hint = curved_hint(profile, form)) rest.hints.push_back(std::move(*hint));
  return rest;
}

}  // namespace dwell
