#include "solvers/matched/time_price.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "solvers/matched/dwell_model.h"
#include "solvers/native/bounded_lbfgs.h"

namespace dwell {
namespace {

// The first price, of the one from which on the least dwell is optimal: time hardly counts, yet the optimum is one.
constexpr double kNoWorth = 1e-6;
// Rounds at the first price: a round that lowers the objective by less than this share is the last.
constexpr double kLittleGain = 0.003;
constexpr int kMostRounds = 5;
// A price is found when its worth is this near; and at most so many steps towards it, and returns to the full problem.
constexpr double kSamePrice = 0.005;
constexpr int kMostSteps = 30;
constexpr int kMostReturns = 2;
constexpr double kSameAfterReturn = 0.02;
// A model is at rest when the last third of its products has lowered it by less than this share of all of them.
constexpr double kAtRest = 0.01;
constexpr long kFirstLook = 12;
// Products with the model at a price: so much work on variables, and within these limits. A price need not be as exact
// as a plan, and every step goes on from where the last one ended.
constexpr double kWorkAPrice = 6e6;
constexpr long kFewestProducts = 20, kMostProducts = 200;
constexpr double kModelTolerance = 1e-8;  // of the gradient, relative to that at the least dwell

class Search {
 public:
  Search(DwellProblem& problem, const TimeWorth& worth, const Progress& progress)
      : p_(problem), worth_(worth), progress_(progress), objective_(problem) {}

  TimePrice run() {
    start();
    if (!(highest_ > 0.0)) return found_;  // nothing descends: no dwell pays at any price
    progress_.step("setting up the model of the time price");
    make_model();
    at_no_worth();
    for (int k = 0; k < kMostReturns; ++k) {
      find_on_model();
      move_to_model();
      if (near(worth_of_time(worth_, least_, here()).price, price_, kSameAfterReturn)) break;
    }
    find_on_model();
    const double price = price_;
    progress_.step("time price: estimating what other prices would give");
    found_.here = estimate(price);  // once more, or what is still to gain at this price would count for the others
    found_.twice = estimate(2.0 * price);
    found_.half = estimate(0.5 * price);
    const PricedTradeOff best = estimate(kNoWorth * highest_);
    if (best.trade_off.residual_rms < found_.best.trade_off.residual_rms) found_.best = best;
    progress_.step("time price: estimating what less smoothness would give");
    estimate_unsmoothed();
    set_price(price);
    found_.price = price;
    return found_;
  }

 private:
  static bool near(double a, double b, double share) { return std::abs(a - b) <= share * b; }

  double pixels() const { return static_cast<double>(std::max<Index>(1, p_.pixels())); }
  void set_price(double price) {
    price_ = price;
    p_.gamma = price * pixels();
  }

  /// The least dwell: what it leaves and takes, and what the steepest second there is worth.
  void start() {
    set_price(0.0);
    t_ = p_.lower;
    clip_to_bounds(p_, t_);
    value_ = objective_.evaluate(t_, r_, gradient_);
    found_.applications += 2;
    least_ = here();
    found_.least = trade_off(least_.half_mean_square);
    highest_ = std::max(0.0, -gradient_.minCoeff() / pixels());
    check_finite(value_);
  }

  static void check_finite(double value) {
    if (!std::isfinite(value)) throw std::runtime_error("the search of the time price met a value that is not finite");
  }

  void make_model() {
    model_ = make_dwell_model(p_, objective_);
    lower_.setZero(model_->size());
    most_products_ = std::clamp(std::lround(kWorkAPrice / static_cast<double>(std::max<Index>(1, model_->size()))),
                                kFewestProducts, kMostProducts);
    upper_ = model_->largest();
    lbfgs_ = std::make_unique<BoundedLbfgs>(lower_, upper_, p_.threads());
    s_.setZero(model_->size());
    Vector prices = Vector::Zero(p_.points());
    add_prices(p_, 1.0, prices);
    model_->restrict_to(prices, seconds_);
    return_to_full();
    tolerance_ = kModelTolerance * point_.gradient.norm();
  }

  /// The plan as the full problem knows it.
  LeftAndTotal here() const { return {0.5 * r_.squaredNorm() / pixels(), priced_total(p_, t_)}; }
  TradeOff trade_off(double half_mean_square) const {
    return {std::sqrt(2.0 * half_mean_square), priced_total(p_, t_), step_rms(p_, t_)};
  }

  /// The model about the plan, from the full problem's residual.
  void return_to_full() {
    point_.x = s_;
    point_.value = value_;
    model_->gradient(r_, t_, point_.gradient);
  }

  /// Lets the model's point feel another price.
  void price_model(double price) {
    const double change = price * pixels() - p_.gamma;
    point_.gradient += change * seconds_;
    point_.value += change * total_of_model();
    set_price(price);
  }
  double total_of_model() const { return priced_total(p_, t_) + seconds_.dot(point_.x - s_); }

  void minimise_model() {
    progress_.check();
    long products = 0, next_look = kFirstLook;
    const double start = point_.value;
    double seen = start;
    auto shown = std::chrono::steady_clock::now();
    lbfgs_->minimise(model_->form(), tolerance_, point_, [&](const QuadraticPoint& now) {
      constexpr std::chrono::milliseconds kQuarter{250};
      if (std::chrono::steady_clock::now() - shown >= kQuarter) {
        shown = std::chrono::steady_clock::now();
        if (progress_.stop_asked()) return false;
      }
      if (++products >= most_products_) return false;
      if (products < next_look) return true;
      next_look = products + products / 2;
      const double lately = seen - now.value, all = start - now.value;
      seen = now.value;
      return lately > kAtRest * all;
    });
    ++found_.models;
    progress_.check();
    check_finite(point_.value);
  }

  /// What the model says of its point.
  LeftAndTotal on_model(double& step) {
    d_of_model();
    d_ += t_;
    step = step_rms(p_, d_);
    return {std::max(0.0, point_.value - penalty(p_, d_)) / pixels(), priced_total(p_, d_)};
  }
  void d_of_model() {
    const Vector change = point_.x - s_;
    model_->prolong(change, d_);
  }

  /// Moves to the minimiser of the full objective on the way to the model's point.
  void move_to_model() {
    d_of_model();
    objective_.gradient(r_, t_, gradient_);
    const double slope = gradient_.dot(d_);
    ++found_.applications;
    if (slope < 0.0) {
      objective_.image(d_, image_);
      ++found_.applications;
      const double curvature = objective_.curvature(d_, image_);
      const double a = curvature > 0.0 ? std::min(1.0, -slope / curvature) : 1.0;
      t_ += a * d_;
      clip_to_bounds(p_, t_);  // rounding only
      s_ += a * (point_.x - s_);
      objective_.advance(a, image_, r_);
    }
    value_ = objective_.value(r_, t_);
    check_finite(value_);
    return_to_full();
  }

  /// The plan at the first price, on the full problem.
  void at_no_worth() {
    price_model(kNoWorth * highest_);
    value_ = objective_.value(r_, t_);
    for (int k = 0; k < kMostRounds; ++k) {
      progress_.step(fmt::format("time price: round {} with next to none, residual {:.4g} nm RMS", k + 1,
                                 std::sqrt(2.0 * here().half_mean_square)));
      const double before = value_;
      minimise_model();
      move_to_model();
      if (before - value_ <= kLittleGain * std::abs(before)) break;
    }
    found_.best = {price_, trade_off(here().half_mean_square)};
  }

  /// Steps on the model from the present price to one that is its own worth.
  void find_on_model() {
    for (int k = 0; k < kMostSteps; ++k) {
      double step = 0.0;
      const LeftAndTotal plan = on_model(step);
      const RuledPrice ruled = worth_of_time(worth_, least_, plan);
      found_.rule = ruled.rule;
      progress_.step(fmt::format("time price: {:.4g} nm^2/s, {:.4g} nm RMS in {:.5g} s", price_,
                                 std::sqrt(2.0 * plan.half_mean_square), plan.total));
      if (near(ruled.price, price_, kSamePrice)) return;
      price_model(std::min(ruled.price, highest_));
      minimise_model();
    }
  }

  /// What the best plan would be without smoothness, by a model of its own, about the plan that was found.
  void estimate_unsmoothed() {
    const auto parts = p_.parts;
    const double alpha = p_.alpha;
    if (!(smoothness_term(p_, t_) > 0.0)) return;
    p_.alpha = 0.0;
    for (DwellPart& part : p_.parts) part.alpha.reset();
    set_price(kNoWorth * highest_);
    value_ = objective_.value(r_, t_);
    const Vector s = s_;  // in the variables of the model, which smoothness does not change
    make_model();
    if (s.size() != s_.size()) throw std::logic_error("the variables of a dwell model depend on its smoothness");
    s_ = s;
    return_to_full();
    minimise_model();
    double step = 0.0;
    const LeftAndTotal plan = on_model(step);
    found_.unsmoothed = {price_, {std::sqrt(2.0 * plan.half_mean_square), plan.total, step}};
    p_.parts = parts;
    p_.alpha = alpha;
  }

  PricedTradeOff estimate(double price) {
    price_model(price);
    minimise_model();
    double step = 0.0;
    const LeftAndTotal plan = on_model(step);
    return {price, {std::sqrt(2.0 * plan.half_mean_square), plan.total, step}};
  }

  DwellProblem& p_;
  const TimeWorth& worth_;
  const Progress& progress_;
  DwellObjective objective_;
  std::unique_ptr<DwellModel> model_;
  std::unique_ptr<BoundedLbfgs> lbfgs_;
  TimePrice found_;
  LeftAndTotal least_;
  long most_products_ = kMostProducts;  // with the model at a price
  double price_ = 0.0, highest_ = 0.0, tolerance_ = 0.0;
  Vector t_, r_, gradient_, d_, image_;  // the plan on the full problem
  double value_ = 0.0;
  Vector s_, lower_, upper_, seconds_;  // the plan in the model's variables, their bounds, and P' prices [s]
  QuadraticPoint point_;                // of the model
};

}  // namespace

TimePrice find_time_price(DwellProblem& problem, const TimeWorth& worth, const Progress& progress) {
  validate(problem);
  return Search(problem, worth, progress).run();
}

}  // namespace dwell
