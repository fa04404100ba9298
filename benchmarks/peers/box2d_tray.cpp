// Scene A by Box2D's own rigid solver: no shells, contacts by sequential impulses. Prints one line of JSON.
//   box2d_tray START HOLES RATE_HZ LEAD_S WINDOW_S REST_S
// START has lines "x y" in metres; HOLES is 0 or 3. Continuous collision is off: it costs 6-7 times as much, and at
// these rates no grain crosses a wall in one step. Lengths are in units of 1 cm, as Box2D wants moving bodies of 0.1 to
// 10 units.
#include <box2d/box2d.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <numbers>
#include <vector>

namespace {

constexpr double unit = 0.01;  // m
constexpr double radius = 4e-3, mass = 0.6e-3, gravity = 9.81, friction = 0.3, restitution = 0.5;
constexpr double amplitude = 0.01, frequency = 9, count_at = -0.02;
constexpr int velocity_iterations = 8, position_iterations = 3;  // Box2D's own suggestion

float scaled(double length) {
  return static_cast<float>(length / unit);
}

/// A block from (left, bottom) to (right, top): thick, or grains would pass a thin line at the lowest rate.
void add_block(b2Body& tray, double left, double right, double bottom, double top) {
  b2PolygonShape block;
  block.SetAsBox(scaled((right - left) / 2), scaled((top - bottom) / 2),
                 {scaled((left + right) / 2), scaled((bottom + top) / 2)}, 0);
  b2FixtureDef fixture;
  fixture.shape = &block;
  fixture.friction = static_cast<float>(friction);
  fixture.restitution = static_cast<float>(restitution);
  tray.CreateFixture(&fixture);
}

b2Body& add_tray(b2World& world, bool holes) {
  b2BodyDef definition;
  definition.type = b2_kinematicBody;
  b2Body& tray = *world.CreateBody(&definition);
  constexpr double deep = -0.01, high = 0.6, thick = 0.04;
  add_block(tray, -thick, 0, deep, high), add_block(tray, 0.5, 0.5 + thick, deep, high);
  if (!holes) {
    add_block(tray, 0, 0.5, deep, 0);
  } else {
    add_block(tray, 0, 0.113, deep, 0), add_block(tray, 0.137, 0.238, deep, 0);
    add_block(tray, 0.262, 0.363, deep, 0), add_block(tray, 0.387, 0.5, deep, 0);
  }
  return tray;
}

void add_grain(b2World& world, double x, double y) {
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  definition.position.Set(scaled(x), scaled(y));
  b2CircleShape circle;
  circle.m_radius = scaled(radius);
  b2FixtureDef fixture;
  fixture.shape = &circle;
  fixture.density = static_cast<float>(mass / (std::numbers::pi * circle.m_radius * circle.m_radius));
  fixture.friction = static_cast<float>(friction);
  fixture.restitution = static_cast<float>(restitution);
  world.CreateBody(&definition)->CreateFixture(&fixture);
}

int touching(const b2World& world) {
  int count = 0;
  for (const b2Contact* contact = world.GetContactList(); contact; contact = contact->GetNext())
    count += contact->IsTouching() ? 1 : 0;
  return count;
}

/// Takes out grains below the counting line; returns how many.
int take_out(b2World& world) {
  int taken = 0;
  for (b2Body* body = world.GetBodyList(); body;) {
    b2Body* const next = body->GetNext();
    if (body->GetType() == b2_dynamicBody && body->GetPosition().y < scaled(count_at)) world.DestroyBody(body), ++taken;
    body = next;
  }
  return taken;
}

/// Steps the world and sums what the comparison needs.
class Loop {
 public:
  Loop(b2World& world, b2Body& tray, double rate) : world_(world), tray_(tray), rate_(rate) {}

  void run(double duration) {
    const std::clock_t begin = std::clock();
    std::clock_t counting = 0;
    grain_steps_ = 0, contacts_ = 0;
    steps_ = std::lround(duration * rate_);
    for (long k = 0; k < steps_; ++k) {
      step();
      const std::clock_t looked = std::clock();
      contacts_ += touching(world_);
      counting += std::clock() - looked;
    }
    cpu_ = static_cast<double>(std::clock() - begin - counting) / CLOCKS_PER_SEC;
  }

  void print() const {
    std::printf("RESULT {\"cpu_s\": %.6f, \"grain_steps\": %ld, \"contacts\": %.3f, \"steps\": %ld, ", cpu_,
                grain_steps_, static_cast<double>(contacts_) / static_cast<double>(steps_), steps_);
  }
  int out() const { return out_; }

 private:
  void step() {
    const double next = amplitude * std::sin(2 * std::numbers::pi * frequency * static_cast<double>(++step_) / rate_);
    tray_.SetLinearVelocity({static_cast<float>((next / unit - tray_.GetPosition().x) * rate_), 0});
    grain_steps_ += world_.GetBodyCount() - 1;
    world_.Step(static_cast<float>(1 / rate_), velocity_iterations, position_iterations);
    out_ += take_out(world_);
  }

  b2World& world_;
  b2Body& tray_;
  double rate_, cpu_ = 0;
  long step_ = 0, steps_ = 0, grain_steps_ = 0, contacts_ = 0;
  int out_ = 0;
};

}  // namespace

int main(int count, char** arguments) {
  if (count == 2) {
    std::puts(BOX2D_VERSION);
    return 0;
  }
  if (count != 7) {
    std::fprintf(stderr, "box2d_tray --version\nbox2d_tray START HOLES RATE_HZ LEAD_S WINDOW_S REST_S\n");
    return 2;
  }
  b2World world({0, -scaled(gravity)});
  world.SetAllowSleeping(false);
  world.SetContinuousPhysics(false);
  b2Body& tray = add_tray(world, std::atoi(arguments[2]) > 0);
  std::ifstream start(arguments[1]);
  for (double x, y; start >> x >> y;) add_grain(world, x, y);
  const int number = world.GetBodyCount() - 1;
  Loop loop(world, tray, std::atof(arguments[3]));
  loop.run(std::atof(arguments[4]));
  loop.run(std::atof(arguments[5]));
  loop.print();
  loop.run(std::atof(arguments[6]));
  std::printf("\"out\": %d, \"number\": %d}\n", loop.out(), number);
}
