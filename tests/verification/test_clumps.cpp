// Clumps against the mechanics of a rigid body.
#include <gtest/gtest.h>

#include <cmath>

#include "grains/size_distribution.hpp"
#include "grains/turning_clump.hpp"
#include "scene/cross_product.hpp"
#include "support/bench.hpp"
#include "support/solid_clumps.hpp"
#include "verification/tables.hpp"

namespace vibrosow {
namespace {

constexpr double clump_mass = 1e-3;

/// Lot 0 is a dipole of two discs of 4 mm radius, 12 mm apart, or another clump.
Bench bench_of(std::vector<ClumpDisc> discs) {
  Bench bench;
  bench.scene.lots.clear();
  bench.add_clump(std::move(discs), clump_mass);
  return bench;
}

std::vector<ClumpDisc> dipole_discs() {
  return dipole(8e-3, 12e-3);
}

/// Three unlike discs: no symmetry.
std::vector<ClumpDisc> odd_discs() {
  return {{0, 0, 5e-3}, {6e-3, 1e-3, 3e-3}, {-3e-3, 5e-3, 2e-3}};
}

double angular_momentum(const Grains& g) {
  double sum = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    sum += g.kind(i).mass * (g.x[i] * g.vy[i] - g.y[i] * g.vx[i]) + g.omega[i] / g.kind(i).inverse_inertia;
  return sum;
}

TEST(Clump, ADipoleInFreeFlightKeepsItsMomentaAndEnergy) {
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5}) {
    Bench bench = bench_of(dipole_discs());
    bench.scene.numerics.integrator = integrator;
    bench.place(0.3, 0.5, 0.2, 0.1, 50);
    Simulation& run = bench.start(1e-4);
    const double energy = kinetic_energy(run.grains()), momentum = angular_momentum(run.grains());
    run.steps(10000);
    EXPECT_NEAR(kinetic_energy(run.grains()), energy, 1e-14 * energy);
    // 10^4 sums, each rounded to the last bit of a place below 1 m
    EXPECT_NEAR(angular_momentum(run.grains()), momentum, 1e4 * 0x1p-53 * clump_mass * 0.3);
    EXPECT_NEAR(run.grains().angle[0], 50, 1e-9);
    EXPECT_NEAR(run.grains().x[0], 0.5, 1e-10);
  }
}

// Two dipoles collide off centre: momentum and angular momentum are kept with friction and damping, the energy without.
TEST(Clump, CollidingClumpsKeepTheirMomenta) {
  for (const bool loses : {false, true})
    for (const FrictionModel model : {FrictionModel::sliding, FrictionModel::spring}) {
      Bench bench = bench_of(odd_discs());
      if (loses) bench.scene.contact.seed = {0.4, 0.6};
      bench.scene.contact.friction_model = model;
      bench.place(0.48, 0.5, 0.3, 0.02, 30, 0, 0.4).place(0.52, 0.502, -0.2, 0, -10, 0, 2.1);
      Simulation& run = bench.start(1e-6);
      const double energy = kinetic_energy(run.grains()), momentum = angular_momentum(run.grains());
      run.steps(150000);
      ASSERT_GT(run.statistics().contacts, 100);
      const Grains& g = run.grains();
      EXPECT_NEAR(clump_mass * (g.vx[0] + g.vx[1]), clump_mass * 0.1, 1e-13 * clump_mass);
      EXPECT_NEAR(angular_momentum(g), momentum, 1e-9 * clump_mass * 0.3 * 0.01);
      if (loses)
        EXPECT_LT(kinetic_energy(g), 0.99 * energy);
      else
        EXPECT_NEAR(kinetic_energy(g), energy, 1e-5 * energy);
    }
}

// A clump comes down on the floor with one disc, off its centre of mass: the impulse is J = (1 + e) u / (1/m + (r x
// n)^2 / I), u the approach of the point that touches; the velocity changes by J/m, the spin by (r x n) J / I.
// Frictionless, elastic, and stiff enough for the arm to stay what it is.
TEST(Clump, AnImpactOffCentreIsThatOfARigidBody) {
  VerificationReport report("clump_impact",
                            "a clump falls on the floor with one disc, frictionless; change of velocity "
                            "and spin against the rigid body's",
                            {"law", "clump", "angle_deg", "spin_rad_per_s", "restitution_asked", "restitution",
                             "velocity_change_theory_m_per_s", "velocity_change_m_per_s", "velocity_deviation_percent",
                             "spin_change_theory_rad_per_s", "spin_change_rad_per_s", "spin_deviation_percent"});
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const bool is_dipole : {true, false})
      for (const double degrees : {10.0, 30.0, 60.0, 140.0})
        for (const double spin : {0.0, 20.0})
          for (const double restitution : {1.0, 0.5}) {
            Bench bench = bench_of(is_dipole ? dipole_discs() : odd_discs());
            bench.scene.contact.law = law;
            bench.scene.contact.shell_compression = 1e-8;
            bench.scene.contact.youngs_modulus = 1e13;  // stiff enough to turn by nothing during the contact
            bench.scene.contact.wall.restitution = restitution;
            const SeedLot lot = bench.scene.lots[0];
            const double angle = degrees * Bench::pi / 180, speed = 0.5;
            double lowest = 1, arm = 0;  // of the disc that touches; from the centre of mass along x
            for (const ClumpDisc& disc : lot.discs) {
              const double bottom = std::sin(angle) * disc.x + std::cos(angle) * disc.y - disc.radius;
              if (bottom < lowest) lowest = bottom, arm = std::cos(angle) * disc.x - std::sin(angle) * disc.y;
            }
            const double dt = 5e-10;
            bench.place(0.5, -lowest + 2.37 * speed * dt, 0, -speed, spin, 0, angle);
            Simulation& run = bench.start(dt);
            const double approach = speed - arm * spin;
            ASSERT_GT(approach, 0);
            std::int64_t touched = 0, free_steps = 0;
            while (free_steps < 10 && run.time() < 1e-3) {
              ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
              const bool pushed = run.field().forces()[0].fy > 0;
              touched += pushed ? 1 : 0;
              free_steps = touched > 0 && !pushed ? free_steps + 1 : 0;
            }
            ASSERT_GT(touched, 100);
            const double inertia = clump_mass * lot.gyration2;
            const double inverse_effective = 1 / clump_mass + arm * arm / inertia;
            const Grains& g = run.grains();
            const double measured = (g.vy[0] + arm * g.omega[0]) / approach;
            const double impulse = (1 + (restitution < 1 ? measured : 1)) * approach / inverse_effective;
            const double velocity = impulse / clump_mass, turn = impulse * arm / inertia;
            SCOPED_TRACE(testing::Message() << is_dipole << " " << degrees << " " << spin << " " << restitution);
            EXPECT_NEAR(g.vy[0] + speed, velocity, 0.005 * velocity);
            EXPECT_NEAR(g.omega[0] - spin, turn, 0.005 * std::abs(turn));
            EXPECT_EQ(g.vx[0], 0);
            report.add(law == Law::hertz ? "hertz" : "elastic_shell", is_dipole ? "dipole" : "three discs", degrees,
                       spin, restitution, measured, velocity, g.vy[0] + speed, 100 * ((g.vy[0] + speed) / velocity - 1),
                       turn, g.omega[0] - spin, 100 * ((g.omega[0] - spin) / turn - 1));
          }
}

// The same in 3D, turned at random: the impulse along n at r changes the velocity by J n / m and the spin by I^-1 (r
// x n) J, J = (1 + e) u / (1/m + (r x n) I^-1 (r x n)).
TEST(Clump, AnImpactOfAClumpOfBallsIsThatOfARigidBody) {
  VerificationReport report(
      "clump_impact_3d",
      "a clump of balls falls on the floor with one ball, frictionless, turned at random; change of "
      "velocity and spin against the rigid body's",
      {"law", "clump", "turned", "restitution_asked", "restitution", "velocity_change_theory_m_per_s",
       "velocity_change_m_per_s", "velocity_deviation_percent", "spin_change_theory_rad_per_s",
       "spin_deviation_percent"});
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const bool is_dipole : {true, false})
      for (const double restitution : {1.0, 0.5}) {
        Random random(5);
        for (int turned = 1; turned <= 4; ++turned) {
          const SeedLot lot = solid_lot(is_dipole ? dipole_discs() : odd_balls(), clump_mass);
          Scene scene = clump_scene(lot);
          scene.contact.law = law;
          scene.contact.shell_compression = 1e-8;
          scene.contact.youngs_modulus = 1e13;  // stiff enough to turn by nothing during the contact
          scene.contact.wall.restitution = restitution;
          constexpr double dt = 5e-10, speed = 0.5;
          Model model = with_step(prepare(scene), dt);
          model.gravity = {0, 0};
          const Orientation q = draw_orientation(random);
          const Eigen::Matrix3d axes = rotation_matrix(q);
          double lowest = 1;
          Eigen::Vector3d arm = Eigen::Vector3d::Zero();  // of the ball that touches
          for (const ClumpDisc& ball : lot.discs) {
            const Eigen::Vector3d at = axes * centre_of(ball);
            if (at.y() - ball.radius < lowest) lowest = at.y() - ball.radius, arm = at;
          }
          const Eigen::Vector3d spin(3, -20, 10), up(0, 1, 0);
          const Eigen::Vector3d inertia = clump_mass * Eigen::Vector3d(lot.gyration2_x, lot.gyration2_y, lot.gyration2);
          const Eigen::Vector3d lever = cross(arm, up);
          const Eigen::Vector3d turn = axes * (axes.transpose() * lever).cwiseQuotient(inertia);  // by a unit impulse
          const double approach = speed - up.dot(cross(spin, arm));
          ASSERT_GT(approach, 0);
          Simulation run(model,
                         start_of(model, {{{0.5, 2.37 * approach * dt - lowest, 0.5}, {0, -speed, 0}, spin, q}}));
          std::int64_t touched = 0, free_steps = 0;
          while (free_steps < 10 && run.time() < 1e-3) {
            ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
            const bool pushed = run.field().forces_3d()[0].y > 0;
            touched += pushed ? 1 : 0;
            free_steps = touched > 0 && !pushed ? free_steps + 1 : 0;
          }
          ASSERT_GT(touched, 100);
          const Grains& g = run.grains();
          const Eigen::Vector3d spin_change = turning_of(g, 0) - spin;
          const double measured = (g.vy[0] + up.dot(cross(turning_of(g, 0), arm))) / approach;
          const double impulse = (1 + (restitution < 1 ? measured : 1)) * approach / (1 / clump_mass + lever.dot(turn));
          SCOPED_TRACE(testing::Message() << is_dipole << " " << turned << " " << restitution);
          EXPECT_NEAR(g.vy[0] + speed, impulse / clump_mass, 0.005 * impulse / clump_mass);
          const double off = (spin_change - impulse * turn).norm();
          EXPECT_NEAR(off, 0, 0.005 * impulse * turn.norm());
          EXPECT_EQ(Eigen::Vector2d(g.vx[0], g.vz[0]), Eigen::Vector2d(0, 0));
          report.add(law == Law::hertz ? "hertz" : "elastic_shell", is_dipole ? "dipole" : "four balls", turned,
                     restitution, measured, impulse / clump_mass, g.vy[0] + speed,
                     100 * ((g.vy[0] + speed) * clump_mass / impulse - 1), impulse * turn.norm(),
                     100 * off / (impulse * turn.norm()));
        }
      }
}

// A disc of a clump yields by eps of its own radius under the weight of the whole clump; so does a smaller clump's.
TEST(Clump, EachDiscHasTheStiffnessOfItsOwnRadius) {
  for (const Space space : both_spaces)
    for (const double size : {1.0, 0.5}) {
      const SeedLot lot = [&] {
        if (space == Space::three_dimensional) return solid_lot(odd_discs(), clump_mass);
        return bench_of(odd_discs()).scene.lots[0];
      }();
      Scene scene = clump_scene(lot);
      scene.space = space;
      SeedLot& own = scene.lots[0];
      own.sizes = {SizeDistribution::Kind::uniform, own.diameter, 0, 0.5 * own.diameter, own.diameter, {}, {}};
      Model model = with_step(prepare(scene), 1e-9);
      model.gravity = {0, 0};
      for (const ClumpDisc& disc : lot.discs) {
        // Turned so that this disc is the lowest, it alone touches the floor.
        const Eigen::Vector3d arm = centre_of(disc), down = -Eigen::Vector3d::UnitY(), across = arm.cross(down);
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(arm.norm() + arm.dot(down), across.x(), across.y(), across.z()).normalized();
        const double radius = size * disc.radius, overlap = 1e-6;
        Grains grains = no_grains(model);
        grains.add(Eigen::Vector3d(0.5, size * arm.norm() + radius - overlap, 0.5), Eigen::Vector3d::Zero(), 0,
                   sized_kind(own, *model.law, model.kinds[0], size),
                   {-Bench::pi / 2 - std::atan2(disc.y, disc.x), {turn.w(), turn.x(), turn.y(), turn.z()}});
        Simulation run(model, starting_state(model, 1, grains));
        const double mass = grains.kind(0).mass, expected = mass * standard_gravity / (1e-4 * radius) * overlap;
        EXPECT_NEAR(force_on(run, 0).y(), expected, 1e-6 * expected) << radius;
        EXPECT_EQ(run.statistics().contacts, 1);
      }
    }
}

// A clump of one disc with a ball's moment of inertia is the ball, to the bit.
TEST(Clump, OfOneDiscIsABall) {
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5})
      for (const FrictionModel model : {FrictionModel::sliding, FrictionModel::spring}) {
        const auto trajectory = [&](bool clump) {
          Bench bench;
          bench.gravity = {0, -standard_gravity};
          SeedLot& lot = bench.scene.lots[0];
          lot.shape = Shape::ball;
          if (clump) {
            lot.shape = Shape::clump;
            lot.discs = {{0, 0, Bench::radius}};
            lot.gyration2 = 0.4 * Bench::radius * Bench::radius;
          }
          bench.scene.contact.law = law;
          bench.scene.contact.youngs_modulus = 1e7;
          bench.scene.contact.seed = bench.scene.contact.wall = {0.3, 0.7};
          bench.scene.contact.friction_model = model;
          bench.scene.contact.drag = 1e-4;
          bench.scene.numerics.integrator = integrator;
          bench.place(0.3, 0.02, 0.3, 0, 10).place(0.305, 0.03).place(0.302, 0.045, 0, -0.5);
          Simulation& run = bench.start(2e-5);
          run.steps(20000);
          EXPECT_GT(run.statistics().contacts, 100);
          return run.grains();
        };
        const Grains ball = trajectory(false), clump = trajectory(true);
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_EQ(clump.x[i], ball.x[i]);
          EXPECT_EQ(clump.y[i], ball.y[i]);
          EXPECT_EQ(clump.vx[i], ball.vx[i]);
          EXPECT_EQ(clump.vy[i], ball.vy[i]);
          EXPECT_EQ(clump.omega[i], ball.omega[i]);
        }
      }
}

}  // namespace
}  // namespace vibrosow
