#include "outflow/doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace vibrosow {
namespace {

using enum Severity;

/// By kind.
constexpr std::array<DoubtWords, 34> doubt_words = {{
    {"outside the model", serious, "do not use it: take a step that is not too long and the guard's own limits"},
    {"ran dry", serious, "put in more seeds, or measure before"},
    {"drained in the window", serious, "keep the tray topped up (fill.keep), or measure a shorter time"},
    {"stopped flowing", serious, "the time without flow counts in the rate; take wider holes, or measure before"},
    {"seeds lost through walls", serious, "take more steps a contact or a stiffer shell"},
    {"the feeder fell behind", serious, "leave more room for what is fed, or feed less"},
    {"the guard warned", serious, "make contacts stiffer or steps shorter, as it says, and run again"},
    {"stopped", serious, "the guard's reason says what to change"},
    {"interrupted", serious, "the same command resumes"},
    {"ended before the measuring window", serious, "run longer, or measure earlier"},
    {"few seeds", mild, "run longer"},
    {"a part of a period", serious, "measure over whole periods of the drive: run longer"},
    {"clogged", mild, "the figures are of the runs that flowed; wider holes clog less often"},
    {"wide interval", mild, "allow more replicates"},
    {"skewed runs", mild, "run more replicates before the interval is trusted"},
    {"unlikely scene", serious, "look at the key that it names"},
    {"tolerance outside the table", mild, "weigh the tray as it is built"},
    {"beyond the levels", mild, "take accuracy = \"draft\" or a finer level, or find its error with vibrosow accuracy"},
    {"runs left out", mild, "the table of the runs says why"},
    {"two kinds of run", serious, "take wider holes, or run longer"},
    {"errors that act on each other", mild, "go to finer settings for narrower bands"},
    {"no limit", mild, "allow more replicates"},
    {"the error of 2D", mild, "add it with --depth"},
    {"nothing fitted", serious, "look for what else is wrong than what was fitted, in the table or in the seeder"},
    {"misfit", serious, "look for what else is wrong than what was fitted, or state a larger noise (--noise)"},
    {"not told apart", mild, "use the two together, or measure what tells them apart (vibrosow bench-sheet)"},
    {"little learned", mild, "measure what depends on it (vibrosow bench-sheet)"},
    {"at the edge of its range", serious, "give it a wider range (--fit)"},
    {"wider than its range", mild, "take values from posterior.csv, which go together"},
    {"few points", mild, "give narrower ranges (--fit)"},
    {"nothing held out", mild, "measure more conditions, or give --hold-out"},
    {"seeds spilled", mild, "raise the walls, or put what feeds the tray over it"},
    {"the flow changed in the window", serious, "look at its rate over time, and measure where it is steady"},
    {"sizes drawn far from those asked for", mild, "put in more seeds"},
}};
static_assert(doubt_words.size() == static_cast<std::size_t>(last_doubt_kind) + 1);

/// Whether a doubt was counted over single runs; another says all there is to say in its own text.
bool is_of_runs(int of) {
  return of > 0;
}

}  // namespace

const DoubtWords& words_of(DoubtKind kind) {
  return doubt_words.at(static_cast<std::size_t>(kind));
}

std::string numbers_text(std::string_view noun, const std::vector<int>& numbers) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from < numbers.size();) {
    std::size_t to = from;
    while (to + 1 < numbers.size() && numbers[to + 1] == numbers[to] + 1) ++to;
    if (to - from < 2)
      for (; from <= to; ++from) parts.push_back(fmt::format("{}", numbers[from]));
    else
      parts.push_back(fmt::format("{} to {}", numbers[from], numbers[to]));
    from = to + 1;
  }
  return fmt::format("{}{} {}", noun, numbers.size() == 1 ? "" : "s", fmt::join(parts, ", "));
}

std::vector<CountedDoubt> counted_doubts(const std::vector<const std::vector<Doubt>*>& runs) {
  std::vector<CountedDoubt> counted;
  for (const std::vector<Doubt>* run : runs) {
    std::vector<DoubtKind> of_run;  // a run counts once for each
    for (const Doubt& doubt : *run) {
      if (std::ranges::find(of_run, doubt.kind) != of_run.end()) continue;
      of_run.push_back(doubt.kind);
      const auto known = std::ranges::find(counted, doubt.kind, &CountedDoubt::kind);
      if (known == counted.end())
        counted.push_back({doubt.kind, 1, static_cast<int>(runs.size()), doubt.text});
      else
        ++known->runs;
    }
  }
  return counted;
}

std::string doubt_text(const CountedDoubt& doubt) {
  if (!is_of_runs(doubt.of)) return doubt.text;
  return fmt::format("{} in {} of {} runs", words_of(doubt.kind).name, doubt.runs, doubt.of);
}

std::string doubts_text(const std::vector<CountedDoubt>& doubts) {
  std::vector<std::string> texts;
  for (const CountedDoubt& doubt : doubts) texts.push_back(doubt_text(doubt));
  return fmt::format("{}", fmt::join(texts, "; "));
}

bool is_serious(const std::vector<CountedDoubt>& doubts) {
  return std::ranges::any_of(
      doubts, [](const CountedDoubt& doubt) { return words_of(doubt.kind).severity == Severity::serious; });
}

std::vector<SharedDoubt> shared_doubts(const std::vector<LayoutDoubts>& layouts) {
  std::vector<SharedDoubt> shared;
  for (const LayoutDoubts& layout : layouts)
    for (const CountedDoubt& doubt : layout.doubts) {
      const auto is_same = [&](const SharedDoubt& known) {
        return known.kind == doubt.kind && is_of_runs(known.of) == is_of_runs(doubt.of) &&
               (is_of_runs(doubt.of) || known.text == doubt.text);
      };
      auto known = std::ranges::find_if(shared, is_same);
      if (known == shared.end()) known = shared.insert(shared.end(), {doubt.kind, {}, 0, 0, doubt.text});
      if (layout.layout > 0) known->layouts.push_back(layout.layout);
      known->runs += doubt.runs, known->of += doubt.of;
    }
  std::ranges::stable_sort(shared, {},
                           [](const SharedDoubt& doubt) { return words_of(doubt.kind).severity == Severity::mild; });
  return shared;
}

Remark remark_of(const SharedDoubt& doubt, std::string_view noun) {
  const DoubtWords& words = words_of(doubt.kind);
  std::string text = noun.empty() || doubt.layouts.empty() ? "" : numbers_text(noun, doubt.layouts) + ": ";
  if (is_of_runs(doubt.of)) {
    text += fmt::format("{} in {} of {} runs", words.name, doubt.runs, doubt.of);
    if (doubt.text != words.name) text += fmt::format(" ({})", doubt.text);
  } else {
    text += doubt.text;
  }
  return {words.severity, std::move(text), std::string(words.advice)};
}

Remark remark_of(const Doubt& doubt) {
  return remark_of(SharedDoubt{doubt.kind, {}, 0, 0, doubt.text}, "");
}

std::string sentence_of(const Remark& remark) {
  std::string text = remark.severity == Severity::serious ? "Doubtful: " : "Note: ";
  text += remark.text;
  if (!text.ends_with('.')) text += '.';
  return remark.what_to_do.empty() ? text : fmt::format("{} What to do: {}.", text, remark.what_to_do);
}

}  // namespace vibrosow
