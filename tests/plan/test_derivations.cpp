// What follows from a scene is worked out once a run. The linker leads each call of a derivation from another object
// file through a counter here (tests/CMakeLists.txt lists the same names for its option --wrap).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "plan/contact_parameters.hpp"
#include "plan/effects.hpp"
#include "plan/model.hpp"
#include "plan/touching_kinds.hpp"
#include "simulation/simulate.hpp"

namespace vibrosow {
namespace {

std::map<std::string, int> calls;

}  // namespace

#define COUNTED(function, symbol, result, parameters, arguments) \
  result real_##function parameters asm("__real_" symbol);       \
  result counted_##function parameters asm("__wrap_" symbol);    \
  result counted_##function parameters {                         \
    ++calls[#function];                                          \
    return real_##function arguments;                            \
  }

using Lots = std::vector<SeedLot>;
using Sizes = std::vector<SeedSizes>;
using Materials = std::vector<SeedMaterial>;
using Kinds = std::vector<GrainKind>;

COUNTED(traits_of, "_ZN8vibrosow9traits_ofENS_3LawE", const LawTraits&, (Law law), (law))
COUNTED(meeting_surfaces, "_ZN8vibrosow16meeting_surfacesERKNS_7ContactEm", Surfaces,
        (const Contact& contact, std::size_t lots), (contact, lots))
COUNTED(sizes_of, "_ZN8vibrosow8sizes_ofERKSt6vectorINS_7SeedLotESaIS1_EE", Sizes, (const Lots& lots), (lots))
COUNTED(seed_materials, "_ZN8vibrosow14seed_materialsERKNS_7ContactERKSt6vectorINS_7SeedLotESaIS4_EE", Materials,
        (const Contact& contact, const Lots& lots), (contact, lots))
COUNTED(grain_kinds,
        "_ZN8vibrosow11grain_kindsERKSt6vectorINS_7SeedLotESaIS1_EERKS0_INS_12SeedMaterialESaIS6_EERKNS_9LawTraitsE",
        Kinds, (const Lots& lots, const Materials& materials, const LawTraits& law), (lots, materials, law))
COUNTED(touching_kinds,
        "_ZN8vibrosow14touching_kindsERKSt6vectorINS_7SeedLotESaIS1_EERKS0_INS_9SeedSizesESaIS6_EERKS0_INS_"
        "9GrainKindESaISB_EERKNS_9LawTraitsE",
        Kinds, (const Lots& lots, const Sizes& sizes, const Kinds& kinds, const LawTraits& law),
        (lots, sizes, kinds, law))
COUNTED(effects_of, "_ZN8vibrosow10effects_ofERKNS_5SceneERKNS_8SurfacesERKNS_9LawTraitsE", EffectSet,
        (const Scene& scene, const Surfaces& surfaces, const LawTraits& law), (scene, surfaces, law))
COUNTED(contact_parameters,
        "_ZN8vibrosow18contact_parametersERKNS_7ContactERKNS_8SurfacesERKSt6vectorINS_12SeedMaterialESaIS7_EERKNS_"
        "9LawTraitsE",
        ContactParameters,
        (const Contact& contact, const Surfaces& surfaces, const Materials& materials, const LawTraits& law),
        (contact, surfaces, materials, law))
COUNTED(bed_loads,
        "_ZN8vibrosow9bed_loadsERKSt6vectorINS_7SeedLotESaIS1_EERKS0_INS_9SeedSizesESaIS6_EERKS0_INS_6VesselESaISB_"
        "EERKNS_7RunPlanENS_5SpaceE",
        BedLoads,
        (const Lots& lots, const Sizes& sizes, const std::vector<Vessel>& vessels, const RunPlan& run, Space space),
        (lots, sizes, vessels, run, space))
COUNTED(plan_step, "_ZN8vibrosow9plan_stepERKNS_9StepBasisE", StepPlan, (const StepBasis& basis), (basis))
COUNTED(predict_overlap, "_ZN8vibrosow15predict_overlapERKNS_9StepBasisE", PredictedOverlap, (const StepBasis& basis),
        (basis))

namespace {

/// Two lots with surfaces of their own, in a tray and the hopper above it, both shaken; two holes, one with a gate;
/// rain.
Scene full_scene() {
  Scene scene;
  scene.lots = {{"ball", 4e-3, 40e-6, Shape::ball, 0.5}, {"disc", 3e-3, 20e-6, Shape::disc, 0.5}};
  scene.contact.shell_compression = 1e-4;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.overrides = {{0, -1, {0.2, 0.4}}};
  scene.tray.name = "tray";
  scene.tray.length = 0.1, scene.tray.height = 0.1;
  scene.tray.fill = Fill{60, Packing::poured, 0, false};
  scene.tray.holes = {{0.03, 0.012}, {0.07, 0.012}};
  scene.tray.holes[1].open_at = 0.01;
  scene.tray.motion = HarmonicMotion{0, 0.005, 9, 0};
  scene.hopper = scene.tray;
  scene.hopper->name = "hopper";
  scene.hopper->origin = {0, 0.15};
  scene.hopper->rain = Rain{.rate = 100, .from = 0.01, .to = 0.09, .height = 0.09, .start = 0, .stop = 0.05};
  scene.run.duration = 0.05;
  return scene;
}

TEST(Derivations, EachOnceARun) {
  calls.clear();
  const vibrosow::Run run = simulate(full_scene());
  EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
  EXPECT_GT(run.force_evaluations, 0);
  std::map<std::string, int> once;
  for (const char* derivation :
       {"traits_of", "meeting_surfaces", "sizes_of", "seed_materials", "grain_kinds", "touching_kinds", "effects_of",
        "contact_parameters", "bed_loads", "plan_step", "predict_overlap"})
    once[derivation] = 1;
  EXPECT_EQ(calls, once);
}

}  // namespace
}  // namespace vibrosow
