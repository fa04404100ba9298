#include "vibrosow/evaluate.hpp"

#include <string>

#include "library/convert.hpp"
#include "study/evaluate.hpp"

namespace vibrosow::api {
namespace {

std::string reason_of(const vibrosow::Evaluation& own) {
  return own.reason.empty() ? own.end_reason : own.reason;
}

Doubt converted(const vibrosow::Doubt& own) {
  const DoubtWords& words = words_of(own.kind);
  return {std::string(words.name), words.severity == Severity::serious, own.text, std::string(words.advice)};
}

int hole_of(const std::string& own) {
  return own == "all" ? all_holes : std::stoi(own);
}

}  // namespace

Balance converted(const vibrosow::Balance& own) {
  return {own.put_in, own.inside, own.counted, own.spilled, own.lost};
}

Evaluation converted(const vibrosow::Evaluation& own) {
  const std::optional<Unevenness> unevenness = unevenness_of({&own.outflow});
  Evaluation evaluation{.finished = own.finished(),
                        .reason = reason_of(own),
                        .doubts = {},
                        .outside_the_model = own.outside_the_model,
                        .end_time = own.end_time,
                        .balance = converted(own.balance),
                        .holes = {},
                        .unevenness_cv = unevenness ? unevenness->cv : std::nullopt,
                        .depth_factor = own.outflow.depth_factor};
  for (const vibrosow::Doubt& doubt : own.outflow.doubts) evaluation.doubts.push_back(converted(doubt));
  for (const vibrosow::HoleOutflow& row : own.outflow.holes)
    evaluation.holes.push_back(
        {hole_of(row.hole), row.lot, row.grains, row.seeds_per_s, row.mass_rate, row.longest_pause});
  return evaluation;
}

Evaluation evaluate(const Scene& scene, std::uint64_t random_seed, int threads) {
  SimulationOptions options;
  options.random_seed = random_seed;
  options.threads = threads;
  return converted(vibrosow::evaluate(prepare(scene.value()), options));
}

}  // namespace vibrosow::api
