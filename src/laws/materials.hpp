#pragma once

#include <optional>

namespace vibrosow {

/// What a seed is made of, as far as any law asks.
struct SeedMaterial {
  double radius;             // m
  double weight;             // N
  double shell_compression;  // eps / r under that weight
  double youngs_modulus;     // Pa
  double poisson_ratio;
};

/// What something elastic is made of; where it is optional, none is rigid.
struct ElasticMaterial {
  double youngs_modulus;  // Pa
  double poisson_ratio;
};

/// A seed and what it rubs on: another seed or the walls, none where they are rigid.
struct RubbingMaterials {
  SeedMaterial a;
  std::optional<ElasticMaterial> b;
};

}  // namespace vibrosow
