#include "report/plan_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "picture/escaped_text.hpp"
#include "report/printed_page.hpp"
#include "report/terminal_text.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

constexpr double seeds_wanted = 1000, least_catch = 10;  // in a weighing; s

std::string title_of(const PlanPage& page) {
  std::string crops;
  for (const PlannedLot& lot : page.source.lots) crops += (crops.empty() ? "" : " and ") + lot.crop;
  const SowingTask& task = page.source.plan.task;
  return fmt::format("Settings card: {}, {} kg/ha, rows every {} cm", crops,
                     to_digits(task.sowing_rate / kilogram_per_hectare, 3), to_digits(task.pace.row_spacing * 100, 3));
}

std::string tray_text(const PlanCard& card) {
  const TableTray& tray = card.tray;
  return fmt::format(
      "The tray: {} round hole{} of {} mm for {} row{}, level, shaken along its length by {} mm to either side, its "
      "bed "
      "{} mm deep.",
      tray.holes, tray.holes == 1 ? "" : "s", to_digits(tray.at.width * tray.seed.diameter / millimetre, 3), card.rows,
      card.rows == 1 ? "" : "s", to_digits(tray.amplitude / millimetre, 3),
      to_digits(tray.at.depth * tray.seed.diameter / millimetre, 2));
}

std::string cell(const std::string& text, const char* of_class = "") {
  return fmt::format("<td{}>{}</td>", of_class, escaped_text(text));
}

std::string range(double low, double high, double unit) {
  return fmt::format("{} to {}", to_digits(low / unit, 2), to_digits(high / unit, 2));
}

/// kg/ha that a rate (kg/s) of all holes is at the speed of a row.
double sown_at(const PlanPage& page, const CardRow& row, double mass_rate) {
  return page.source.plan.task.sowing_rate * mass_rate / row.needed;
}

std::string card_row(const PlanPage& page, const CardRow& row) {
  std::string text =
      "<tr>" + cell(to_digits(row.speed / kilometre_per_hour, 3)) + cell(to_digits(row.needed / gram, 3));
  if (!row.setting) return text + "<td class=\"say\" colspan=\"4\">not with this tray</td></tr>\n";
  const CorrectedSetting& set = *row.setting;
  text += cell(fmt::format("{:.3g}", set.frequency)) +
          cell(to_digits(set.width / millimetre, 3) + (row.is_other_width ? "*" : "") + (row.clogs ? " clogs" : "")) +
          cell(range(set.low, set.high, gram)) +
          cell(range(sown_at(page, row, set.low), sown_at(page, row, set.high), kilogram_per_hectare));
  return text + "</tr>\n";
}

std::string card_table(const PlanPage& page) {
  std::string text =
      "<div class=\"table\"><table><thead><tr><th>speed<br>km/h</th><th>needed<br>g/s</th><th>set<br>Hz</th>"
      "<th>hole<br>mm</th><th>expect<br>g/s</th><th>expect<br>kg/ha</th></tr></thead>\n";
  for (const CardRow& row : page.card->lines) text += card_row(page, row);
  return text + "</table></div>\n";
}

/// How the card is to be read.
std::string reading_text(const PlanCard& card) {
  const auto by_frequency = [](const CardRow& row) { return row.setting && !row.is_other_width; };
  const auto& lines = card.lines;
  std::string text =
      "g/s are of all holes of the tray; what is expected is a range that holds the true value in 95 % of cases.";
  if (const auto one = std::ranges::find_if(lines, by_frequency); one != lines.end())
    text += fmt::format(" Where the drill goes faster shake {}.", one->setting->more_by_faster ? "faster" : "slower");
  if (std::ranges::any_of(lines, &CardRow::is_other_width))
    text += fmt::format(
        " *: no frequency of the tray's own holes gives the rate. Change the holes, or open a slide over them as wide, "
        "and "
        "shake at {:.3g} Hz. A slide's opening is not round: weigh it.",
        card.tray.frequency);
  if (std::ranges::any_of(lines, &CardRow::clogs))
    text += fmt::format(
        " clogs: narrower than {:g} of the largest seeds, {} mm, so not a setting to sow with; drive faster, or feed "
        "more "
        "rows from a hole.",
        kept_open_from, to_digits(kept_open_from * card.tray.seed.largest_diameter() / millimetre, 3));
  return text;
}

/// The settings that tell most of the card: by frequency, the slowest speed's, that in the middle, and the fastest's.
std::vector<const CardRow*> to_weigh(const PlanCard& card) {
  std::vector<const CardRow*> reached, chosen;
  for (const CardRow& row : card.lines)
    if (row.setting && !row.is_other_width) reached.push_back(&row);
  if (reached.empty()) return {};
  for (const std::size_t place : {reached.size() / 2, std::size_t{0}, reached.size() - 1})
    if (std::ranges::find(chosen, reached[place]) == chosen.end()) chosen.push_back(reached[place]);
  return chosen;
}

/// s, by fives.
double catch_time(const PlanCard& card, const CardRow& row) {
  const double time = seeds_wanted * card.tray.seed.mass / row.needed;
  return 5 * std::ceil(std::max(least_catch, time) / 5);
}

/// What was weighed at about this frequency.
std::string weighed_before(const PlanPage& page, double frequency) {
  constexpr double same = 0.02;
  if (page.weighed == nullptr) return "";
  for (const WeighedRow& row : page.weighed->rows)
    if (std::abs(row.weighed.tray.frequency / frequency - 1) < same)
      return fmt::format("{} g/s before", to_digits(row.weighed.mass_rate / gram, 3));
  return "";
}

std::string weigh_part(const PlanPage& page) {
  const std::vector<const CardRow*> rows = to_weigh(*page.card);
  std::string text = "<h2>What to weigh</h2>\n";
  if (rows.empty())
    return text + paragraph("No frequency of this tray gives the rate at these speeds: change its holes first.");
  text += "<p>" + line_to_write("Date") + line_to_write("Seed lot") + "</p>\n";
  text += paragraph(
      "Fill the tray as in work, set the frequency, let it run until the flow is even, catch what leaves all holes for "
      "the time stated, weigh it. The first row matters most; each further one narrows the card's ranges.");
  text +=
      "<div class=\"table\"><table><thead><tr><th>set<br>Hz</th><th>catch for<br>s</th><th>expect<br>g</th>"
      "<th>caught<br>g</th></tr></thead>\n";
  for (const CardRow* row : rows) {
    const double time = catch_time(*page.card, *row);
    text += fmt::format("<tr>{}{}{}<td class=\"write\">{}</td></tr>\n",
                        cell(fmt::format("{:.3g}", row->setting->frequency)), cell(fmt::format("{:g}", time)),
                        cell(range(row->setting->low * time, row->setting->high * time, gram)),
                        escaped_text(weighed_before(page, row->setting->frequency)));
  }
  return text + "</table></div>\n" +
         fmt::format(
             "<p>Then, with what each row gave in g/s: <code>{} --weighed \"... g/s at {:.3g} Hz\"</code></p>\n",
             escaped_text(page.command), rows.front()->setting->frequency);
}

std::string sure_part(const PlanPage& page) {
  std::string text = "<h2>How sure</h2>\n";
  if (page.weighed != nullptr) {
    for (const std::string& sentence : weighed_sentences(page.source, page.card->rows, *page.weighed))
      text += paragraph(sentence);
  } else {
    text += paragraph(risk_sentence(page.source.plan));
    for (const std::string& sentence : trust_sentences(page.source)) text += paragraph(sentence);
  }
  return text;
}

}  // namespace

std::string plan_page(const PlanPage& page) {
  std::string body;
  for (const std::string& sentence : need_sentences(page.source)) body += paragraph(sentence);
  body += sure_part(page);  // before any number that it is about
  if (page.card != nullptr)
    body += "<h2>What to set</h2>\n" + paragraph(tray_text(*page.card)) + card_table(page) +
            paragraph(reading_text(*page.card)) + weigh_part(page);
  return printed_page(title_of(page), body);
}

}  // namespace vibrosow
