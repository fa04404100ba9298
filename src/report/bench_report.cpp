#include "report/bench_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "input/key_units.hpp"
#include "picture/escaped_text.hpp"
#include "report/answer_doubts.hpp"
#include "report/printed_page.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

constexpr double worth_naming = 0.2;  // of a contraction

/// A reading to be taken.
struct Reading {
  const BenchSource* source;
  const BenchCandidate* candidate;
  int repeat;
};

/// Round by round: what setting something again is worth shows between the repeats.
std::vector<Reading> readings(const BenchSource& source) {
  std::vector<Reading> result;
  for (int repeat = 1; repeat <= source.plan.repeats; ++repeat)
    for (const BenchCandidate* candidate : source.plan.chosen()) result.push_back({&source, candidate, repeat});
  return result;
}

template <class Row, class Get>
Columns<Row> condition_columns(const std::vector<std::string>& keys, Get candidate_of) {
  Columns<Row> columns;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto unit = column_unit(keys[k]);
    columns.push_back(
        {{condition_column(keys[k]), unit ? std::string(unit->unit) : "", "to be set"},
         [k, candidate_of](const Row& row) { return CsvField(candidate_of(row).conditions[k].text, true); }});
  }
  return columns;
}

Columns<Reading> reading_columns(const std::vector<std::string>& keys) {
  Columns<Reading> columns =
      condition_columns<Reading>(keys, [](const Reading& r) -> const BenchCandidate& { return *r.candidate; });
  append(columns, {text_column<Reading>("repeat", "of the condition, 1..", [](const Reading& r) { return r.repeat; }),
                   quantity_column<Reading>("duration_s", seconds, "for which seeds are caught",
                                            [](const Reading& r) { return r.source->plan.catch_time; }),
                   text_column<Reading>("caught_g", "to be filled in: mass caught in that time, of all holes, in g",
                                        [](const Reading&) { return std::string(); })});
  return columns;
}

Columns<BenchCandidate> candidate_columns(const std::vector<std::string>& keys) {
  using Row = const BenchCandidate&;
  Columns<BenchCandidate> columns = condition_columns<BenchCandidate>(keys, std::identity{});
  append(columns,
         {text_column<BenchCandidate>("place", "in the order in which it was chosen; empty: it was not",
                                      [](Row r) { return r.place ? fmt::format("{}", *r.place) : std::string(); }),
          quantity_column<BenchCandidate>("rate_g_per_s", grams_per_second,
                                          "expected, geometric mean over what is not known; of the 2D slice in 2D",
                                          [](Row r) { return r.mass_rate; }),
          quantity_column<BenchCandidate>("chance_percent", percent, "standard deviation of one reading",
                                          [](Row r) { return r.chance; })});
  return columns;
}

std::string setting_text(const BenchCandidate& candidate) {
  std::vector<std::string> parts;
  for (const Condition& condition : candidate.conditions) {
    const auto unit = column_unit(condition.key);
    parts.push_back(fmt::format("{}{}", condition.text, unit ? fmt::format(" {}", unit->unit) : ""));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string expectation(const BenchSource& source) {
  std::vector<std::string> told, untold;
  for (std::size_t k = 0; k < source.task.keys.size(); ++k) {
    const double contraction = source.plan.contraction[k];
    const std::string& key = source.task.keys[k].key;
    if (contraction >= worth_naming)
      told.push_back(fmt::format("{} ({:.0f} %)", key, 100 * contraction));
    else
      untold.push_back(key);
  }
  std::string text = told.empty() ? "These readings would say little about any of the fitted numbers."
                                  : fmt::format("Expected to reduce the uncertainty of {}.", fmt::join(told, ", "));
  if (!untold.empty() && !told.empty())
    text += fmt::format(" They would say little about {}.", fmt::join(untold, ", "));
  return text;
}

double minutes(const BenchSource& source) {
  return source.plan.readings() * (source.plan.catch_time + source.limits.handling) / 60;
}

constexpr double shortest_by_hand = 5;  // s; a hand with a stopwatch errs by some tenths
constexpr const char* too_short =
    "So short a catch cannot be timed by hand to 2 %: time it by a switch, or have the seeder keep its tray filled up "
    "(a hopper with fill.keep), which allows longer ones.";

bool is_caught_by_hand(const BenchSource& source) {
  return source.plan.catch_time >= shortest_by_hand;
}

/// What a person needs to do before the table.
std::string instructions(const BenchSource& source) {
  std::string text = "<p>";
  for (const char* field : {"Date", "Seed lot", "Thousand-grain weight"}) text += line_to_write(field);
  text += fmt::format(
      "</p>\n<p>{} readings of {:g} s, about {:.0f} minutes with {:g} s for setting, filling and weighing. Use the "
      "seed that will be sown, and a balance that shows 0.1 g.</p>\n{}<ol>\n",
      source.plan.readings(), source.plan.catch_time, minutes(source), source.limits.handling,
      is_caught_by_hand(source) ? "" : fmt::format("<p><strong>{}</strong></p>\n", too_short));
  for (const char* step :
       {"Fill as the tray is filled in work, the same for every reading.",
        "Set what the row says. Let it run until the flow is even, three seconds at least.",
        "Catch what leaves all holes for the time stated, and weigh it.",
        "Write the grams here and into bench.csv. Take the rows in order: the repeats are settings made again.",
        "A reading that went wrong (an empty tray, a clogged hole) is taken again, or its row is deleted."})
    text += fmt::format("<li>{}</li>\n", step);
  return text + "</ol>\n";
}

std::string reading_table(const BenchSource& source) {
  std::string text = "<table><thead><tr><th>no.</th>";
  for (const std::string& key : source.task.measured.table.condition_keys) {
    const auto unit = column_unit(key);
    text += fmt::format("<th>{}{}</th>", escaped_text(key), unit ? fmt::format("<br>{}", unit->unit) : "");
  }
  text += "<th>repeat</th><th>time<br>s</th><th>caught<br>g</th></tr></thead>\n";
  int number = 0;
  for (const Reading& reading : readings(source)) {
    text += fmt::format("<tr><td>{}</td>", ++number);
    for (const Condition& condition : reading.candidate->conditions)
      text += fmt::format("<td>{}</td>", escaped_text(condition.text));
    text +=
        fmt::format("<td>{}</td><td>{:g}</td><td class=\"write\"></td></tr>\n", reading.repeat, source.plan.catch_time);
  }
  return text + "</table>\n";
}

std::string page(const BenchSource& source) {
  std::string text = instructions(source) + reading_table(source);
  for (const Remark& remark : doubt_remarks(source.plan.doubts, "", all_doubts)) text += paragraph(sentence_of(remark));
  for (const std::string& choice : source.choices) text += paragraph(choice);
  text += paragraph(expectation(source)) + fmt::format("<p>Then: <code>{}</code></p>\n", escaped_text(source.command));
  return printed_page(fmt::format("Bench sheet: {}", source.task.seeder.stem().string()), text);
}

}  // namespace

std::string bench_table(const BenchSource& source) {
  std::vector<std::string> names;
  for (const std::string& key : source.task.measured.table.condition_keys) names.push_back(key);
  std::string text =
      doubts_paragraph(source.plan.doubts, "", all_doubts) +
      wrapped(fmt::format("{} readings of {:g} s, each condition {} times: {:.0f} minutes", source.plan.readings(),
                          source.plan.catch_time, source.plan.repeats, minutes(source)));
  text += wrapped(fmt::format("to set ({}):", fmt::join(names, ", ")));
  for (const BenchCandidate* candidate : source.plan.chosen())
    text += fmt::format("  {:<40} a reading is off by {:.2g} %\n", setting_text(*candidate), 100 * candidate->chance);
  for (const std::string& choice : source.choices) text += wrapped(choice);
  text += wrapped(expectation(source));
  if (!is_caught_by_hand(source)) text += wrapped(too_short);
  return text + wrapped(fmt::format("then: {}", source.command));
}

std::vector<FileText> bench_file_texts() {
  const std::vector<std::string> any{"KEY"};
  return {
      {"bench-sheet.html", "a page to print: what to set, how long to run, what to weigh", {}},
      file_text("bench.csv", "one row per reading to be taken; filled in, `vibrosow calibrate` reads it",
                reading_columns(any)),
      doubts_file_text(),
      file_text("bench_candidates.csv", "one row per combination of settings that was tried", candidate_columns(any))};
}

std::vector<OutputFile> bench_files(const BenchSource& source, CsvFormat format) {
  const std::vector<std::string>& keys = source.task.measured.table.condition_keys;
  return {{"bench-sheet.html", page(source)},
          {"bench.csv", csv_of(reading_columns(keys), readings(source), format)},
          {"bench_candidates.csv", csv_of(candidate_columns(keys), source.plan.candidates, format)},
          doubts_file(source.plan.doubts)};
}

}  // namespace vibrosow
