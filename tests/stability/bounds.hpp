#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "report/csv.hpp"
#include "stability/hard_cases.hpp"
#include "support/report_file.hpp"

namespace vibrosow {

/// What every hard case was held to, and what came of it: written as stability.csv where $VIBROSOW_REPORTS says,
/// sorted, of what is held to one bound many times the worst.
class StabilityReport {
 public:
  using Key = std::array<std::string, 7>;  // case, space, law, scheme, friction, quantity, relation
  struct Row {
    double bound, measured;
    std::string unit;
    double margin;
  };

  static StabilityReport& instance() {
    static StabilityReport report;
    return report;
  }
  void add(const Key& key, const Row& row) {
    const auto [known, is_new] = rows_.emplace(key, row);
    if (!is_new && !(row.margin >= known->second.margin)) known->second = row;
  }

 private:
  StabilityReport() = default;
  ~StabilityReport() {
    CsvTable table({"case", "space", "law", "scheme", "friction", "quantity", "is_to_be", "bound", "measured", "unit",
                    "margin", "inside"});
    for (const auto& [key, row] : rows_) {
      std::vector<CsvField> fields(key.begin(), key.end());
      fields.insert(fields.end(), {csv_number(row.bound), csv_number(row.measured), row.unit, csv_number(row.margin),
                                   row.margin >= 0 ? "yes" : "no"});
      table.add_row(fields);
    }
    write_report("stability.csv", table.text());
  }

  std::map<Key, Row> rows_;
};

/// Holds one hard case to its bounds: each is an expectation and a row of the report. The margin is what is left of a
/// bound, over the bound.
///
///     Bounds bounds("pile at rest", GetParam(), scene.contact);
///     bounds.at_most("kinetic energy of a grain", energy, 1e-8 * weight, "J");
class Bounds {
 public:
  Bounds(std::string name, const Setting& setting, const Contact& contact)
      : name_(std::move(name)), setting_(setting), friction_(friction_of(contact)) {}

  void at_most(const std::string& quantity, double measured, double bound, const std::string& unit = "") const {
    EXPECT_LE(measured, bound) << name_ << ": " << quantity << ", " << setting_ << ", " << friction_;
    note(quantity, "at most", bound, measured, unit, margin(bound - measured, bound));
  }
  void at_least(const std::string& quantity, double measured, double bound, const std::string& unit = "") const {
    EXPECT_GE(measured, bound) << name_ << ": " << quantity << ", " << setting_ << ", " << friction_;
    note(quantity, "at least", bound, measured, unit, margin(measured - bound, bound));
  }
  void just(const std::string& quantity, double measured, double wanted) const {
    EXPECT_EQ(measured, wanted) << name_ << ": " << quantity << ", " << setting_ << ", " << friction_;
    note(quantity, "just", wanted, measured, "", measured == wanted ? 0 : -1);
  }

  /// A run that went to its end with every grain that was put in.
  void sound(const Run& run) const {
    EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
    just("grains lost", static_cast<double>(run.balance.lost), 0);
    just("grains spilled", static_cast<double>(run.balance.spilled), 0);
    just("grains inside and counted, less those put in",
         static_cast<double>(run.balance.inside + run.balance.counted - run.balance.put_in), 0);
    EXPECT_TRUE(std::isfinite(run.energy.kinetic));
  }
  /// A run that its guard ended, for what its reason says, before a grain was lost.
  void stopped(const std::optional<std::string>& reason, const std::string& because, const Balance& balance) const {
    const bool so = reason && reason->find(because) != std::string::npos;
    EXPECT_TRUE(so) << name_ << ": \"" << because << "\" is not in: " << reason.value_or("it was not stopped");
    just("stopped with its reason", so ? 1 : 0, 1);
    just("grains lost", static_cast<double>(balance.lost), 0);
  }

 private:
  static std::string friction_of(const Contact& contact) {
    if (contact.seed.friction == 0 && contact.wall.friction == 0) return "none";
    return contact.friction_model == FrictionModel::spring ? "spring" : "sliding";
  }
  static double margin(double left, double bound) {
    if (std::isnan(left)) return -std::numeric_limits<double>::infinity();
    if (bound != 0) return left / std::abs(bound);
    return left == 0 ? 0 : std::copysign(1, left);
  }
  void note(const std::string& quantity, const std::string& relation, double bound, double measured,
            const std::string& unit, double margin) const {
    StabilityReport::instance().add({name_, setting_.name_of_space(), setting_.name_of_law(), setting_.name_of_scheme(),
                                     friction_, quantity, relation},
                                    {bound, measured, unit, margin});
  }

  std::string name_;
  Setting setting_;
  std::string friction_;
};

}  // namespace vibrosow
