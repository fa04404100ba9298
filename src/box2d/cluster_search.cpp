#include "box2d/cluster_search.hpp"

namespace vibrosow {

void walls_in(const b2World& world, const b2AABB& box, std::vector<int>& walls) {
  struct Query : b2QueryCallback {
    explicit Query(std::vector<int>& found_walls) : walls(found_walls) {}
    bool ReportFixture(b2Fixture* fixture) override {
      walls.push_back(static_cast<int>(fixture->GetUserData().pointer));
      return true;
    }
    std::vector<int>& walls;
  } query(walls);
  walls.clear();
  world.QueryAABB(&query, box);
  std::ranges::sort(walls);
  walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
}

}  // namespace vibrosow
