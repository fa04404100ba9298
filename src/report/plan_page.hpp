#pragma once

#include <string>
#include <vector>

#include "agronomy/settings_card.hpp"
#include "agronomy/weighed_plan.hpp"
#include "report/plan_report.hpp"

namespace vibrosow {

/// A settings card: what to set at each speed of the drill.
struct PlanCard {
  TableTray tray;
  int rows = 1;  // that its holes feed
  std::vector<CardRow> lines;
};

/// What a page of a plan shows.
struct PlanPage {
  const PlanSource& source;
  const PlanCard* card = nullptr;        // none: no layout gives the rate
  const WeighedPlan* weighed = nullptr;  // none: nothing was weighed
  std::string command;                   // that asks again, but for --weighed
};

/// The page (printed_page): what is sown, the tray, the card, what to weigh, and how sure it is.
std::string plan_page(const PlanPage& page);

}  // namespace vibrosow
