#include "agronomy/settings_card.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "agronomy/weighed_plan.hpp"
#include "support/made_up_hole_table.hpp"

namespace vibrosow {
namespace {

class Card : public testing::Test {
 protected:
  Card() {
    task.seed = {4e-3, 40e-6, 1};
    task.pace = {0.25, 8 * kilometre_per_hour};
    task.sowing_rate = 100 * task.seed.mass / (task.pace.row_spacing * task.pace.speed);
    plan = plan_sowing(task, table, model);
  }
  TrayRates planned(const PlannedLayout& layout) const { return TrayRates(table_tray(task, layout), table, model); }
  /// kg/s by the law itself.
  double given(const TableTray& tray, const CorrectedSetting& set) const {
    HoleConditions at = tray.at;
    at.width = set.width / tray.seed.diameter;
    at.peak_speed *= set.frequency / tray.frequency;
    return tray.holes * tray.seed.mass * table.at(at)->outflow / std::sqrt(tray.seed.diameter / standard_gravity);
  }

  const HoleTable table{made_up_records()};
  const ModelError model{0.2, 5, 1};
  SowingTask task;
  SowingPlan plan;
};

TEST_F(Card, IsOfFourToFourteenKilometresAnHour) {
  const std::vector<double> speeds = card_speeds();
  ASSERT_EQ(speeds.size(), 11U);
  EXPECT_NEAR(speeds.front(), 4 / 3.6, 1e-12);
  EXPECT_NEAR(speeds.back(), 14 / 3.6, 1e-12);
}

TEST_F(Card, EachSettingGivesWhatItsSpeedNeeds) {
  const PlannedLayout& best = plan.layouts.front();
  const TrayRates rates = planned(best);
  int by_frequency = 0, by_width = 0;
  for (const CardRow& row : settings_card(rates, task, best.feed.rows, best.more_by_faster)) {
    EXPECT_NEAR(row.needed, best.feed.rows * task.row_mass_rate() * row.speed / task.pace.speed, 1e-12);
    if (!row.setting) continue;
    EXPECT_NEAR(given(rates.tray(), *row.setting) / row.needed, 1, 1e-4);
    EXPECT_LT(row.setting->low, row.needed);
    EXPECT_GT(row.setting->high, row.needed);
    if (row.is_other_width) {
      EXPECT_NEAR(row.setting->frequency, best.frequency, 1e-9);
      EXPECT_FALSE(best.speeds.holds(row.speed)) << "a frequency would have given it";
    } else {
      EXPECT_NEAR(row.setting->width, best.width, 1e-12);
      EXPECT_EQ(row.setting->more_by_faster, best.more_by_faster);
    }
    ++(row.is_other_width ? by_width : by_frequency);
  }
  EXPECT_GE(by_frequency, 1);
  EXPECT_GE(by_width, 1);
}

/// At the speed that was planned for the card says what the plan says.
TEST_F(Card, AgreesWithThePlan) {
  for (std::size_t i = 0; i < 3; ++i) {
    const PlannedLayout& layout = plan.layouts[i];
    const CardRow row = settings_card(planned(layout), task, layout.feed.rows, layout.more_by_faster)[4];
    ASSERT_TRUE(row.setting);
    EXPECT_NEAR(row.setting->frequency / layout.frequency, 1, 1e-4);
    const FactorRange range = expected_range(layout.error);
    EXPECT_NEAR(row.setting->low / row.needed, range.low, 0.01 * range.low);
    EXPECT_NEAR(row.setting->high / row.needed, range.high, 0.01 * range.high);
  }
}

/// Where nobody says which way the driver turns it, it is the way that serves more speeds.
TEST_F(Card, TurnsTheWayThatServesMoreSpeeds) {
  bool differs = false;
  for (std::size_t i = 0; i < 2; ++i) {
    const PlannedLayout& layout = plan.layouts[i];
    const auto served = [&](const std::optional<bool>& more_by_faster) {
      int rows = 0;
      for (const CardRow& row : settings_card(planned(layout), task, layout.feed.rows, more_by_faster))
        rows += row.setting && !row.is_other_width ? 1 : 0;
      return rows;
    };
    EXPECT_EQ(served(std::nullopt), std::max(served(true), served(false)));
    differs = differs || served(true) != served(false);
  }
  EXPECT_TRUE(differs);
}

/// What was weighed is in the card: of a tray that gives a fifth more, the settings give a fifth less by the table.
TEST_F(Card, OfAWeighedTrayIsCorrectedAndNarrower) {
  const PlannedLayout& best = plan.layouts.front();
  const TableTray tray = table_tray(task, best);
  const std::vector<WeighedTray> weighed(1, {tray, 1.2 * predicted_rate(tray, table), 0.01});
  const TrayRates rates = weighed_rates(weighed.front().tray, weighed, table, model);
  const std::vector<CardRow> before = settings_card(planned(best), task, best.feed.rows);
  const std::vector<CardRow> after = settings_card(rates, task, best.feed.rows);
  int compared = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (!after[i].setting || !before[i].setting) continue;
    EXPECT_LT(given(tray, *after[i].setting), 0.95 * after[i].needed);
    EXPECT_GT(given(tray, *after[i].setting), 0.8 * after[i].needed);
    const auto width = [](const CorrectedSetting& set) { return std::log(set.high / set.low); };
    EXPECT_LT(width(*after[i].setting), width(*before[i].setting));
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

/// Slow drills need less than the tray's own holes give: other widths serve, down to such as clog.
TEST_F(Card, WidthsThatClogAreSaidTo) {
  const TrayRates rates = planned(plan.layouts.front());
  const auto clogging = [&](double largest) {
    SowingTask mixed = task;
    mixed.seed.largest = largest;
    int count = 0;
    for (const CardRow& row : settings_card(rates, mixed, plan.layouts.front().feed.rows)) {
      EXPECT_EQ(row.clogs, row.setting && row.setting->width < kept_open_from * std::max(largest, 4e-3));
      count += row.clogs ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(clogging(1), 0) << "nothing is wide for seeds of a metre";
  EXPECT_LE(clogging(0), clogging(6e-3));
}

TEST_F(Card, SaysWhereTheTableHasNothing) {
  task.sowing_rate *= 1000;
  const PlannedLayout& best = plan.layouts.front();
  for (const CardRow& row : settings_card(planned(best), task, best.feed.rows)) EXPECT_FALSE(row.setting);
}

}  // namespace
}  // namespace vibrosow
