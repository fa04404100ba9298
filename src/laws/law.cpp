#include "laws/law.hpp"

#include <stdexcept>

namespace vibrosow {

template <Law law>
const LawTraits& law_traits();  // law_traits.cpp, compiled for each

const LawTraits& traits_of(Law law) {
  switch (law) {
#define VIBROSOW_TRAITS(name) \
  case Law::name:             \
    return law_traits<Law::name>();
    VIBROSOW_LAWS(VIBROSOW_TRAITS)
#undef VIBROSOW_TRAITS
  }
  throw std::logic_error("a law outside the table");
}

}  // namespace vibrosow
