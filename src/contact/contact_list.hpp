#pragma once

#include <cstddef>
#include <vector>

namespace vibrosow {

/// Candidate pairs (grain, partner), sorted by grain and then by partner; partner < grain but across a boundary. The
/// order of summation follows from it, whatever found the pairs.
struct PairList {
  std::vector<int> grain, partner;

  std::size_t size() const { return partner.size(); }
  void clear() { grain.clear(), partner.clear(); }
  void add(int i, int j) { grain.push_back(i), partner.push_back(j); }
};

/// A grain near a wall segment.
struct WallCandidate {
  int grain;
  int wall;     // index of the scene's wall segment
  double side;  // sign of the side that the grain's centre came from: NearestPoint::side
};

}  // namespace vibrosow
