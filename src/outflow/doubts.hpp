#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "result/doubt.hpp"

namespace vibrosow {

/// serious: the figure itself may be wrong; mild: it is less sure than it looks.
enum class Severity { mild, serious };

/// Words for a kind of doubt.
struct DoubtWords {
  std::string_view name;  // "ran dry"
  Severity severity;
  std::string_view advice;  // what to do, a clause without a full stop
};
const DoubtWords& words_of(DoubtKind kind);

/// A doubt of a layout: of how many of its runs.
struct CountedDoubt {
  DoubtKind kind;
  int runs = 0, of = 0;  // both 0: not of single runs
  std::string text;      // of the first of these runs; of what is not of single runs, all there is to say
  bool operator==(const CountedDoubt&) const = default;
};

/// Those of runs (of each its doubts), each kind once, in the order in which they come up.
std::vector<CountedDoubt> counted_doubts(const std::vector<const std::vector<Doubt>*>& runs);

/// "ran dry in 2 of 5 runs", or what is said of what is not of single runs.
std::string doubt_text(const CountedDoubt& doubt);
/// All of them, with "; " between.
std::string doubts_text(const std::vector<CountedDoubt>& doubts);

bool is_serious(const std::vector<CountedDoubt>& doubts);

/// A doubt of an answer: what several layouts have in common.
struct SharedDoubt {
  DoubtKind kind;
  std::vector<int> layouts;  // their numbers, ascending; none: of the answer itself
  int runs = 0, of = 0;      // of all these together
  std::string text;          // of the first
};

struct LayoutDoubts {
  int layout;  // its number; 0: of the answer itself
  std::vector<CountedDoubt> doubts;
};

/// By kind, serious ones first. Texts of a scene are shared by their words.
std::vector<SharedDoubt> shared_doubts(const std::vector<LayoutDoubts>& layouts);

/// "layouts 1 to 18, 20": of ascending numbers.
std::string numbers_text(std::string_view noun, const std::vector<int>& numbers);

/// What is said beside a result.
struct Remark {
  Severity severity;
  std::string text;
  std::string what_to_do{};  // a clause without a full stop; empty where there is nothing to do
};

/// Text: "layouts 1 to 18: the guard warned in 54 of 54 runs (the relative overlap passed 0.05 ..)". `noun`: of what
/// the numbers are; empty: they are not told.
Remark remark_of(const SharedDoubt& doubt, std::string_view noun = "layout");
Remark remark_of(const Doubt& doubt);

/// "Doubtful: ran dry at 3.2 s. What to do: put in more seeds, or measure before."; "Note: " begins a mild one.
std::string sentence_of(const Remark& remark);

}  // namespace vibrosow
