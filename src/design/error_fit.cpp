#include "design/error_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <map>
#include <set>

#include "grains/random.hpp"

namespace vibrosow {
namespace {

constexpr int draws = 5000;
constexpr Eigen::Index most_terms = 16;
constexpr double rounding = 1e-9;     // percent
constexpr int enough_equal_runs = 3;  // degrees of freedom of the scatter of equal runs
constexpr std::size_t softnesses_for_two_terms = 4;
constexpr double smallest_pivot = 1e-6;  // of columns of unit length: what is below adds no column

double normal_draw(Random& random) {
  return boost::math::quantile(boost::math::normal(), random.uniform() + 0x1p-54);
}

/// The same normal numbers for every fit: a row for each draw, of one more than `most_terms`.
const Eigen::MatrixXd& normal_draws() {
  static const Eigen::MatrixXd numbers = [] {
    Random random;
    return Eigen::MatrixXd::NullaryExpr(draws, most_terms + 1, [&] { return normal_draw(random); }).eval();
  }();
  return numbers;
}

/// Chi squared over its degrees of freedom, from a normal number (Wilson & Hilferty 1931).
double chi_squared_over(int freedom, double normal) {
  const double part = 2.0 / (9.0 * freedom), root = std::max(0.0, 1 - part + normal * std::sqrt(part));
  return root * root * root;
}

double square(double value) {
  return value * value;
}

Eigen::Index rank_of(const Eigen::MatrixXd& columns) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns.colwise().normalized());
  qr.setThreshold(smallest_pivot);
  return qr.rank();
}

/// kg/s, by the run whose seeds are the heaviest.
double scatter_of_counting(const std::vector<AccuracyRun>& runs) {
  double of_a_seed = 0;
  for (const AccuracyRun& run : runs)
    if (run.mass_rate && run.seeds > 0) of_a_seed = std::max(of_a_seed, *run.mass_rate / run.seeds);
  return of_a_seed / std::sqrt(12);
}

template <class Part>
std::size_t levels_of(const std::vector<AccuracySetting>& settings, Part part) {
  std::set<double> levels;
  for (const AccuracySetting& setting : settings) levels.insert(setting.*part);
  return levels.size();
}

}  // namespace

double ErrorFit::Term::value(const AccuracySetting& setting) const {
  switch (source) {
    case ErrorSource::softness:
      return (overlap ? setting.overlap_at_rest : setting.contact_duration) / scale;
    case ErrorSource::slip_speed:
      return setting.slip_speed / scale;
    case ErrorSource::step:
    case ErrorSource::scheme:
      break;
  }
  return setting.integrator == integrator ? 1 / setting.steps_per_contact / scale : 0;
}

Eigen::VectorXd ErrorFit::terms_of(const AccuracySetting& setting) const {
  Eigen::VectorXd values(1 + static_cast<Eigen::Index>(terms_.size()));
  values[0] = 0;  // the limit is no part of an error
  for (std::size_t k = 0; k < terms_.size(); ++k) values[1 + static_cast<Eigen::Index>(k)] = terms_[k].value(setting);
  return values;
}

void ErrorFit::choose_terms(const std::vector<AccuracySetting>& observed) {
  std::vector<Term> wanted = {{.source = ErrorSource::softness}};
  if (levels_of(observed, &AccuracySetting::contact_duration) >= softnesses_for_two_terms)
    wanted.push_back({.source = ErrorSource::softness, .overlap = true});
  wanted.push_back({.source = ErrorSource::slip_speed});
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5})
    wanted.push_back({.source = ErrorSource::step, .integrator = integrator});

  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(observed.size()), 1);
  for (Term term : wanted) {
    double largest = 0;
    for (const AccuracySetting& setting : observed) largest = std::max(largest, term.value(setting));
    if (!(largest > 0)) continue;
    term.scale = largest;
    Eigen::MatrixXd more(columns.rows(), columns.cols() + 1);
    more.leftCols(columns.cols()) = columns;
    for (Eigen::Index i = 0; i < more.rows(); ++i)
      more(i, columns.cols()) = term.value(observed[static_cast<std::size_t>(i)]);
    if (rank_of(more) < more.cols()) continue;
    columns = more;
    terms_.push_back(term);
  }
}

std::optional<ErrorFit> ErrorFit::of(const std::vector<AccuracySetting>& settings,
                                     const std::vector<AccuracyRun>& runs) {
  ErrorFit fit;
  fit.settings_ = settings;
  std::vector<AccuracySetting> observed;
  std::vector<double> rates, weights;
  std::map<std::pair<std::size_t, double>, std::vector<std::size_t>> equal;
  for (const AccuracyRun& run : runs) {
    if (!run.mass_rate) continue;
    equal[{run.setting, run.window}].push_back(rates.size());
    observed.push_back(settings[run.setting]);
    rates.push_back(*run.mass_rate);
    weights.push_back(run.window);  // a longer window scatters less, by its root
  }
  fit.choose_terms(observed);
  const auto count = static_cast<Eigen::Index>(rates.size()), terms = 1 + static_cast<Eigen::Index>(fit.terms_.size());
  if (count < terms + 2) return std::nullopt;

  Eigen::MatrixXd design(count, terms);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto run = static_cast<std::size_t>(i);
    const double weight = std::sqrt(weights[run]);
    design.row(i) = weight * fit.terms_of(observed[run]).transpose();
    design(i, 0) = weight;
    values[i] = weight * rates[run];
  }
  fit.coefficients_ = design.colPivHouseholderQr().solve(values);
  fit.covariance_ = (design.transpose() * design).ldlt().solve(Eigen::MatrixXd::Identity(terms, terms));
  const Eigen::VectorXd residuals = values - design * fit.coefficients_;
  const double squares = residuals.squaredNorm();
  fit.degrees_of_freedom_ = fit.spread_freedom_ = static_cast<int>(count - terms);
  fit.scatter_ = fit.spread_ = std::sqrt(squares / fit.degrees_of_freedom_);
  if (!(fit.coefficients_[0] > 0)) return std::nullopt;
  const double least_scatter = scatter_of_counting(runs);

  double equal_squares = 0;
  for (const auto& [setting, members] : equal) {
    double mean = 0;
    for (const std::size_t i : members) mean += residuals[static_cast<Eigen::Index>(i)];
    mean /= static_cast<double>(members.size());
    for (const std::size_t i : members) equal_squares += square(residuals[static_cast<Eigen::Index>(i)] - mean);
  }
  const int equal_freedom = static_cast<int>(rates.size() - equal.size());
  const int lack_freedom = fit.degrees_of_freedom_ - equal_freedom;
  if (equal_freedom >= enough_equal_runs && lack_freedom > 0 && equal_squares > 0) {
    const double lack = std::max(0.0, squares - equal_squares) / lack_freedom, chance = equal_squares / equal_freedom;
    fit.lack_of_fit_ =
        boost::math::cdf(boost::math::complement(boost::math::fisher_f(lack_freedom, equal_freedom), lack / chance));
    if (!fit.fits()) {
      fit.scatter_ = std::sqrt(chance), fit.degrees_of_freedom_ = equal_freedom;
      fit.spread_ = std::sqrt(lack), fit.spread_freedom_ = lack_freedom;
    }
  }
  fit.scatter_ = std::max(fit.scatter_, least_scatter);
  fit.spread_ = std::max(fit.spread_, least_scatter);
  fit.limit_ = {fit.coefficients_[0],
                student_t_95(fit.spread_freedom_) * fit.spread_ * std::sqrt(fit.covariance_(0, 0))};
  fit.simultaneous_ = fit.simultaneous_factor();
  return fit;
}

/// Of the error over the limit, by the coefficients.
Eigen::VectorXd ErrorFit::gradient_of(const Eigen::VectorXd& terms) const {
  const double limit = coefficients_[0], error = terms.dot(coefficients_);
  Eigen::VectorXd gradient = terms / limit;
  gradient[0] = -error / square(limit);
  return gradient;
}

RateError ErrorFit::error_of(const Eigen::VectorXd& terms, double factor) const {
  const Eigen::VectorXd gradient = gradient_of(terms);
  const double deviation = spread_ * std::sqrt(std::max(0.0, gradient.dot(covariance_ * gradient)));
  const double percent = 100 * terms.dot(coefficients_) / coefficients_[0];
  return {std::abs(percent) < rounding ? 0 : percent, 100 * factor * deviation};
}

RateError ErrorFit::error(std::size_t setting) const {
  return error_of(terms_of(settings_[setting]), simultaneous_);
}

double ErrorFit::band_with(std::size_t setting, const Eigen::MatrixXd& covariance) const {
  const Eigen::VectorXd gradient = gradient_of(setting);
  return 100 * simultaneous_ * spread_ * std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

Eigen::VectorXd ErrorFit::row_of(std::size_t setting) const {
  Eigen::VectorXd row = terms_of(settings_[setting]);
  row[0] = 1;
  return row;
}

double ErrorFit::simultaneous_factor() const {
  const Eigen::MatrixXd root = covariance_.llt().matrixL();
  Eigen::MatrixXd directions(static_cast<Eigen::Index>(settings_.size()), covariance_.cols());
  Eigen::Index used = 0;
  for (const AccuracySetting& setting : settings_) {
    const Eigen::VectorXd direction = root.transpose() * gradient_of(terms_of(setting));
    if (direction.norm() > 0) directions.row(used++) = direction.normalized().transpose();
  }
  if (used == 0) return 0;
  const Eigen::MatrixXd moduli =
      (normal_draws().leftCols(covariance_.cols()) * directions.topRows(used).transpose()).cwiseAbs();
  std::vector<double> largest;
  for (Eigen::Index draw = 0; draw < draws; ++draw)
    largest.push_back(moduli.row(draw).maxCoeff() /
                      std::sqrt(chi_squared_over(spread_freedom_, normal_draws()(draw, most_terms))));
  const auto place = largest.begin() + draws * 95 / 100;
  std::ranges::nth_element(largest, place);
  return *place;
}

std::vector<MainEffect> ErrorFit::effects() const {
  const double factor = student_t_95(spread_freedom_);
  std::vector<MainEffect> effects;
  const auto add = [&](ErrorSource source, const AccuracySetting& from, const AccuracySetting& to) {
    const Eigen::VectorXd difference = terms_of(to) - terms_of(from);
    if (difference.norm() > 0) effects.push_back({source, from, to, error_of(difference, factor)});
  };
  const auto by = [](auto part) {
    return [part](const AccuracySetting& a, const AccuracySetting& b) { return a.*part < b.*part; };
  };
  const auto [stiff, soft] = std::ranges::minmax_element(settings_, by(&AccuracySetting::contact_duration));
  const auto [slow, fast] = std::ranges::minmax_element(settings_, by(&AccuracySetting::slip_speed));
  const auto [few, many] = std::ranges::minmax_element(settings_, by(&AccuracySetting::steps_per_contact));
  const AccuracySetting base = settings_.front();
  const auto varied = [&](ErrorSource source) {
    return std::ranges::any_of(terms_, [source](const Term& term) { return term.source == source; });
  };
  if (varied(ErrorSource::softness)) {
    AccuracySetting from = *stiff, to = *soft;
    for (AccuracySetting* one : {&from, &to})
      one->integrator = base.integrator, one->steps_per_contact = base.steps_per_contact,
      one->slip_speed = base.slip_speed;
    add(ErrorSource::softness, from, to);
  }
  if (varied(ErrorSource::slip_speed)) {
    AccuracySetting from = base, to = base;
    from.slip_speed = slow->slip_speed, to.slip_speed = fast->slip_speed;
    add(ErrorSource::slip_speed, from, to);
  }
  std::vector<Integrator> schemes;
  for (const Term& term : terms_)
    if (term.source == ErrorSource::step) schemes.push_back(term.integrator);
  for (const Integrator scheme : schemes) {
    AccuracySetting from = base, to = base;
    from.integrator = to.integrator = scheme;
    from.steps_per_contact = many->steps_per_contact, to.steps_per_contact = few->steps_per_contact;
    add(ErrorSource::step, from, to);
  }
  for (std::size_t k = 1; k < schemes.size(); ++k) {
    AccuracySetting from = base, to = base;
    from.integrator = schemes.front(), to.integrator = schemes[k];
    from.steps_per_contact = to.steps_per_contact = few->steps_per_contact;
    add(ErrorSource::scheme, from, to);
  }
  return effects;
}

}  // namespace vibrosow
