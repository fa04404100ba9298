#include "study/layout_standing.hpp"

#include <array>
#include <cstddef>

namespace vibrosow {
namespace {

struct StandingWords {
  std::string_view name;
  bool is_compared;
};

/// By standing.
constexpr std::array<StandingWords, 19> standing_words = {{
    {"ok", true},
    {"doubtful", true},
    {"outside the model", false},
    {"stopped", false},
    {"incomplete", false},
    {"best", true},
    {"not shown to be worse", true},
    {"undecided", true},
    {"worse", true},
    {"ruled out by drafts", false},
    {"on the front", true},
    {"may be on the front", true},
    {"dominated", true},
    {"spills", false},
    {"misses the rate or spills", false},
    {"misses the rate", false},
    {"clogs", false},
    {"failed", false},
    {"invalid", false},
}};
static_assert(standing_words.size() == static_cast<std::size_t>(LayoutStanding::invalid) + 1);

const StandingWords& words_of(LayoutStanding standing) {
  return standing_words.at(static_cast<std::size_t>(standing));
}

}  // namespace

std::string_view name_of(LayoutStanding standing) {
  return words_of(standing).name;
}

bool is_compared(LayoutStanding standing) {
  return words_of(standing).is_compared;
}

}  // namespace vibrosow
