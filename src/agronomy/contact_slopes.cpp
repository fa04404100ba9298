#include "agronomy/contact_slopes.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

namespace vibrosow {
namespace {

using HoleSetting = std::tuple<double, double, double>;
HoleSetting hole_setting_of(const HoleRecord& record) {
  return {record.at.width, record.at.peak_speed, record.at.depth};
}

}  // namespace

/// What ln(outflow) is linear in.
ContactSlopes::Values ContactSlopes::terms_of(const SeedContact& contact) {
  return {std::log(contact.friction), contact.wall_friction, contact.rolling_friction, contact.restitution};
}

ContactSlopes::ContactSlopes(const std::vector<HoleRecord>& records) {
  if (records.empty()) throw std::invalid_argument("there are no runs with other contacts");
  std::map<double, std::vector<const HoleRecord*>> by_aspect;
  const Values first = terms_of(records.front().contact);
  for (std::size_t k = 0; k < count; ++k) known_[k] = {first[k], first[k]};
  for (const HoleRecord& record : records) {
    by_aspect[record.at.aspect].push_back(&record);
    const Values terms = terms_of(record.contact);
    for (std::size_t k = 0; k < count; ++k) known_[k] = known_[k].with(terms[k]);
  }
  for (const auto& [aspect, of_shape] : by_aspect) fits_.push_back(fitted(aspect, of_shape));
}

/// Each setting has a level of its own. The covariance is by the residuals, so that what the slopes miss counts as well
/// as chance.
ContactSlopes::Fit ContactSlopes::fitted(double aspect, const std::vector<const HoleRecord*>& records) {
  std::set<HoleSetting> settings;
  for (const HoleRecord* record : records) settings.insert(hole_setting_of(*record));
  const auto rows = static_cast<Eigen::Index>(records.size());
  const auto columns = static_cast<Eigen::Index>(count + settings.size());
  Eigen::MatrixXd terms = Eigen::MatrixXd::Zero(rows, columns);
  Eigen::VectorXd outflows(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const HoleRecord& record = *records[static_cast<std::size_t>(i)];
    const auto own = terms_of(record.contact);
    for (std::size_t k = 0; k < count; ++k) terms(i, static_cast<Eigen::Index>(k)) = own[k];
    const auto setting = std::distance(settings.begin(), settings.find(hole_setting_of(record)));
    terms(i, static_cast<Eigen::Index>(count) + setting) = 1;
    outflows(i) = std::log(record.outflow);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(terms);
  if (solver.rank() < columns || rows <= columns)
    throw std::invalid_argument(
        fmt::format("the runs of aspect {:g} do not determine what each part of a contact does", aspect));
  const Eigen::VectorXd found = solver.solve(outflows);
  const double variance = (outflows - terms * found).squaredNorm() / static_cast<double>(rows - columns);
  const Eigen::MatrixXd covariance = variance * (terms.transpose() * terms).inverse();
  Fit fit{.aspect = aspect};
  for (std::size_t k = 0; k < count; ++k) {
    fit.slopes[k] = found(static_cast<Eigen::Index>(k));
    for (std::size_t l = 0; l < count; ++l)
      fit.covariance[k][l] = covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
  }
  return fit;
}

bool ContactSlopes::holds(const SeedContact& contact) const {
  return nearest(contact) == terms_of(contact);
}

ContactSlopes::Values ContactSlopes::nearest(const SeedContact& contact) const {
  Values terms = terms_of(contact);
  for (std::size_t k = 0; k < count; ++k) terms[k] = known_[k].nearest(terms[k]);
  return terms;
}

/// Of a shape between two, whose fits err independently of each other.
ContactSlopes::Fit ContactSlopes::at(double aspect) const {
  const auto above = std::ranges::lower_bound(fits_, aspect, {}, &Fit::aspect);
  if (above == fits_.begin()) return fits_.front();
  if (above == fits_.end()) return fits_.back();
  const Fit& below = *(above - 1);
  const double way = (aspect - below.aspect) / (above->aspect - below.aspect);
  Fit fit{.aspect = aspect};
  for (std::size_t k = 0; k < count; ++k) {
    fit.slopes[k] = std::lerp(below.slopes[k], above->slopes[k], way);
    for (std::size_t l = 0; l < count; ++l)
      fit.covariance[k][l] = (1 - way) * (1 - way) * below.covariance[k][l] + way * way * above->covariance[k][l];
  }
  return fit;
}

ContactFactor ContactSlopes::between(double aspect, const SeedContact& from, const SeedContact& to,
                                     const SeedContactError& error) const {
  const Fit fit = at(aspect);
  const Values before = nearest(from), after = nearest(to);
  const Values unknown{error.log_friction, 0, error.rolling_friction, 0};  // of the terms
  double log = 0, variance = 0;
  for (std::size_t k = 0; k < count; ++k) {
    log += fit.slopes[k] * (after[k] - before[k]);
    variance += std::pow(fit.slopes[k] * unknown[k], 2);
    for (std::size_t l = 0; l < count; ++l)
      variance += (after[k] - before[k]) * fit.covariance[k][l] * (after[l] - before[l]);
  }
  return {log, std::sqrt(std::max(0.0, variance))};
}

}  // namespace vibrosow
