// Compiled for each law (VIBROSOW_LAW, VIBROSOW_LAW_HEADER), see src/CMakeLists.txt.
#include VIBROSOW_LAW_HEADER

namespace vibrosow {

template <Law law>
const LawTraits& law_traits();

template <>
const LawTraits& law_traits<Law::VIBROSOW_LAW>() {
  static constexpr LawTraits traits = traits_from<FormulasOf<Law::VIBROSOW_LAW>::Type>();
  return traits;
}

}  // namespace vibrosow
