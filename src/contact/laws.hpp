#pragma once

#include "contact/elastic_shell.hpp"
#include "contact/hertz.hpp"
#include "scene/contact_choices.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// The registration table: which formulas a law of the scene stands for.
template <Law law>
struct Registered;
template <>
struct Registered<Law::elastic_shell> {
  using Formulas = ElasticShell;
};
template <>
struct Registered<Law::hertz> {
  using Formulas = Hertz;
};
template <>
struct Registered<Law::hertz_viscous> {
  using Formulas = HertzViscous;
};

}  // namespace vibrosow::inline VIBROSOW_ISA
