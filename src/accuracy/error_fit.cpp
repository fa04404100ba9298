#include "accuracy/error_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "distributions/distributions.hpp"
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
  return normal_quantile(random.uniform() + 0x1p-54);
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

std::vector<CountedRate> rates_of(const std::vector<AccuracyRun>& runs) {
  std::vector<CountedRate> rates;
  for (const AccuracyRun& run : runs)
    if (run.mass_rate) rates.push_back({*run.mass_rate, run.seeds});
  return rates;
}

/// A sum of squares and its degrees of freedom.
struct Squares {
  double sum = 0;
  int freedom = 0;
};

/// Of the residuals of equal runs about their mean.
Squares about_their_means(const std::vector<AccuracyRun>& runs, const Eigen::VectorXd& residuals) {
  std::map<std::pair<std::size_t, double>, std::vector<double>> equal;
  for (std::size_t i = 0; i < runs.size(); ++i)
    equal[{runs[i].setting, runs[i].window}].push_back(residuals[static_cast<Eigen::Index>(i)]);
  Squares squares;
  for (const auto& [setting, members] : equal) {
    double mean = 0;
    for (const double member : members) mean += member;
    mean /= static_cast<double>(members.size());
    for (const double member : members) squares.sum += square(member - mean);
    squares.freedom += static_cast<int>(members.size()) - 1;
  }
  return squares;
}

AccuracySetting with_softness_of(const AccuracySetting& softness, const AccuracySetting& base) {
  AccuracySetting setting = softness;
  setting.integrator = base.integrator;
  setting.steps_per_contact = base.steps_per_contact;
  setting.slip_speed = base.slip_speed;
  return setting;
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

void ErrorFit::choose_terms(const std::vector<AccuracyRun>& runs) {
  std::vector<AccuracySetting> observed;
  std::set<double> softnesses;
  for (const AccuracyRun& run : runs) {
    observed.push_back(settings_[run.setting]);
    softnesses.insert(observed.back().contact_duration);
  }
  std::vector<Term> wanted = {{.source = ErrorSource::softness}};
  if (softnesses.size() >= softnesses_for_two_terms)
    wanted.push_back({.source = ErrorSource::softness, .overlap = true});
  wanted.push_back({.source = ErrorSource::slip_speed});
  for (const auto& [integrator, steps] : steps_)
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

namespace {

std::map<Integrator, std::set<double>> steps_by_scheme(const std::vector<AccuracySetting>& settings,
                                                       const std::vector<AccuracyRun>& runs) {
  std::map<Integrator, std::set<double>> steps;
  for (const AccuracyRun& run : runs)
    if (run.mass_rate) steps[settings[run.setting].integrator].insert(settings[run.setting].steps_per_contact);
  return steps;
}

/// Whether runs of both varied do not tell the effect of the one from that of the other.
bool steps_go_with_softness(const std::vector<AccuracySetting>& settings, const std::vector<AccuracyRun>& runs,
                            const std::map<Integrator, std::set<double>>& steps) {
  std::vector<AccuracySetting> observed;
  for (const AccuracyRun& run : runs)
    if (const AccuracySetting& setting = settings[run.setting];
        run.mass_rate && steps.at(setting.integrator).size() > 1)
      observed.push_back(setting);
  const auto varied = std::ranges::count_if(steps, [](const auto& one) { return one.second.size() > 1; });
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(observed.size()), 2 + varied);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const AccuracySetting& setting = observed[static_cast<std::size_t>(i)];
    columns(i, 0) = 1, columns(i, 1) = setting.contact_duration;
    Eigen::Index column = 2;
    for (const auto& [integrator, numbers] : steps) {
      if (numbers.size() < 2) continue;
      if (integrator == setting.integrator) columns(i, column) = 1 / setting.steps_per_contact;
      ++column;
    }
  }
  return rank_of(columns) < columns.cols();
}

}  // namespace

std::string_view part_of_one_value(const std::vector<AccuracySetting>& settings, const std::vector<AccuracyRun>& runs) {
  std::set<double> softnesses;
  for (const AccuracyRun& run : runs)
    if (run.mass_rate) softnesses.insert(settings[run.setting].contact_duration);
  if (softnesses.empty()) return "";
  if (softnesses.size() < 2) return "softness";
  const auto steps = steps_by_scheme(settings, runs);
  if (std::ranges::all_of(steps, [](const auto& one) { return one.second.size() < 2; }))
    return "number of steps a contact";
  return steps_go_with_softness(settings, runs, steps) ? "number of steps a contact for each softness" : "";
}

bool ErrorFit::tells(std::size_t setting) const {
  return steps_.empty() || steps_.contains(settings_[setting].integrator);
}

std::optional<ErrorFit> ErrorFit::of(const std::vector<AccuracySetting>& settings,
                                     const std::vector<AccuracyRun>& runs) {
  ErrorFit fit;
  fit.settings_ = settings;
  fit.steps_ = steps_by_scheme(settings, runs);
  std::erase_if(fit.steps_, [](const auto& one) { return one.second.size() < 2; });
  std::vector<AccuracyRun> observed;
  std::ranges::copy_if(runs, std::back_inserter(observed),
                       [&](const AccuracyRun& run) { return run.mass_rate && fit.tells(run.setting); });
  for (const AccuracyRun& run : observed) fit.observed_.push_back(settings[run.setting]);
  fit.choose_terms(observed);
  const auto terms = 1 + static_cast<Eigen::Index>(fit.terms_.size());
  if (static_cast<Eigen::Index>(observed.size()) < terms + 2) return std::nullopt;
  const Eigen::VectorXd residuals = fit.solve(observed);
  if (!(fit.coefficients_[0] > 0)) return std::nullopt;
  fit.judge(observed, residuals);
  fit.limit_ = {fit.coefficients_[0],
                student_t_95(fit.spread_freedom_) * fit.spread_ * std::sqrt(fit.covariance_(0, 0))};
  fit.simultaneous_ = fit.simultaneous_factor();
  return fit;
}

Eigen::VectorXd ErrorFit::solve(const std::vector<AccuracyRun>& runs) {
  const auto count = static_cast<Eigen::Index>(runs.size()), terms = 1 + static_cast<Eigen::Index>(terms_.size());
  Eigen::MatrixXd design(count, terms);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const AccuracyRun& run = runs[static_cast<std::size_t>(i)];
    const double weight = std::sqrt(run.window);  // a longer window scatters less, by its root
    design.row(i) = weight * row_of(run.setting).transpose();
    values[i] = weight * *run.mass_rate;
  }
  coefficients_ = design.colPivHouseholderQr().solve(values);
  covariance_ = (design.transpose() * design).ldlt().solve(Eigen::MatrixXd::Identity(terms, terms));
  return values - design * coefficients_;
}

void ErrorFit::judge(const std::vector<AccuracyRun>& runs, const Eigen::VectorXd& residuals) {
  const double squares = residuals.squaredNorm();
  degrees_of_freedom_ = spread_freedom_ = static_cast<int>(residuals.size() - coefficients_.size());
  scatter_ = spread_ = std::sqrt(squares / degrees_of_freedom_);
  const Squares equal = about_their_means(runs, residuals);
  const int lack_freedom = degrees_of_freedom_ - equal.freedom;
  if (equal.freedom >= enough_equal_runs && lack_freedom > 0 && equal.sum > 0) {
    const double lack = std::max(0.0, squares - equal.sum) / lack_freedom, chance = equal.sum / equal.freedom;
    lack_of_fit_ = fisher_f_above(lack_freedom, equal.freedom, lack / chance);
    if (!fits()) {
      scatter_ = std::sqrt(chance), degrees_of_freedom_ = equal.freedom;
      spread_ = std::sqrt(lack), spread_freedom_ = lack_freedom;
    }
  }
  const double least_scatter = scatter_of_counting(rates_of(runs));
  scatter_ = std::max(scatter_, least_scatter);
  spread_ = std::max(spread_, least_scatter);
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
  const auto extremes = [this](double AccuracySetting::*part) {
    const auto [least, most] = std::ranges::minmax_element(observed_, {}, part);
    return std::pair(*least, *most);
  };
  const auto [stiff, soft] = extremes(&AccuracySetting::contact_duration);
  const auto [slow, fast] = extremes(&AccuracySetting::slip_speed);
  const AccuracySetting base = settings_.front();
  std::vector<MainEffect> effects;
  std::optional<AccuracySetting> first_scheme;
  for (const Term& term : terms_) {
    AccuracySetting from = base, to = base;
    switch (term.source) {
      case ErrorSource::softness:
        if (term.overlap) continue;  // is in the effect of the other term
        from = with_softness_of(stiff, base), to = with_softness_of(soft, base);
        break;
      case ErrorSource::slip_speed:
        from.slip_speed = slow.slip_speed, to.slip_speed = fast.slip_speed;
        break;
      case ErrorSource::step:
      case ErrorSource::scheme:
        from.integrator = to.integrator = term.integrator;
        from.steps_per_contact = *steps_.at(term.integrator).rbegin();
        to.steps_per_contact = *steps_.at(term.integrator).begin();
        if (first_scheme)
          effects.push_back(effect(ErrorSource::scheme, *first_scheme, to));
        else
          first_scheme = to;
    }
    effects.push_back(effect(term.source, from, to));
  }
  std::ranges::stable_sort(effects, {}, &MainEffect::source);
  return effects;
}

MainEffect ErrorFit::effect(ErrorSource source, const AccuracySetting& from, const AccuracySetting& to) const {
  return {source, from, to, error_of(terms_of(to) - terms_of(from), student_t_95(spread_freedom_))};
}

}  // namespace vibrosow
