// Convergence order of the integrators: where the force is smooth (a grain that never leaves a vibrating floor, with
// drag and normal damping), with a tangential spring that stays stuck, and across one impact.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "support/bench.hpp"
#include "verification/tables.hpp"

namespace vibrosow {
namespace {

constexpr Integrator every_integrator[] = {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5};

std::string name_of(Integrator integrator) {
  return integrator == Integrator::rk2_midpoint ? "rk2-midpoint"
         : integrator == Integrator::gear5      ? "gear5"
                                                : "velocity-verlet";
}

std::string name_of(Law law) {
  return law == Law::hertz ? "hertz" : "elastic_shell";
}

/// Errors of runs with ever halved steps; the order between each two.
struct Convergence {
  std::vector<std::int64_t> steps;
  std::vector<double> error;

  double order(std::size_t k) const { return std::log2(error[k - 1] / error[k]); }
};

/// All orders go into one report, when the whole program runs.
class Order : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    report_.emplace(
        "order",
        "order of convergence. smooth: a grain that stays on a vibrating floor, with drag and damping; tangential "
        "spring: a disc rolls down a slope on a spring that never slips (both against an independent solution); one "
        "impact: speed after an elastic impact on a wall, root mean square over 64 moments of touch, steps per contact",
        std::vector<std::string>{"problem", "law", "integrator", "steps", "relative_error", "order"});
  }
  static void TearDownTestSuite() { report_.reset(); }

  static void tell(const std::string& problem, Law law, Integrator integrator, const Convergence& runs) {
    for (std::size_t k = 0; k < runs.steps.size(); ++k)
      report_->add(problem, name_of(law), name_of(integrator), static_cast<int>(runs.steps[k]), runs.error[k],
                   k == 0 ? std::nan("") : runs.order(k));
  }

 private:
  static inline std::optional<VerificationReport> report_;
};

/// y' = f(t, y) by the classical fourth-order scheme with extended precision and many steps: the solution that runs are
/// compared with, made from the equations of motion and from nothing of the program.
template <std::size_t n>
std::array<double, n> reference(
    std::array<long double, n> y, double duration, int steps,
    const std::function<void(long double, const std::array<long double, n>&, std::array<long double, n>&)>& rate) {
  using State = std::array<long double, n>;
  const long double h = static_cast<long double>(duration) / steps;
  const auto ahead = [](const State& from, const State& k, long double by) {
    State to = from;
    for (std::size_t i = 0; i < n; ++i) to[i] += by * k[i];
    return to;
  };
  for (int step = 0; step < steps; ++step) {
    const long double t = h * step;
    State k1, k2, k3, k4;
    rate(t, y, k1);
    rate(t + h / 2, ahead(y, k1, h / 2), k2);
    rate(t + h / 2, ahead(y, k2, h / 2), k3);
    rate(t + h, ahead(y, k3, h), k4);
    for (std::size_t i = 0; i < n; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  std::array<double, n> end;
  for (std::size_t i = 0; i < n; ++i) end[i] = static_cast<double>(y[i]);
  return end;
}

/// A grain that never leaves a floor shaken up and down, with drag and normal damping.
struct SmoothProblem {
  Law law;

  static constexpr double duration = 0.02, amplitude = 2e-6, frequency = 60, drag = 0.02;  // 0.03 g
  static constexpr double eps = 0.01 * Bench::radius, modulus = 2e5, poisson = 0.3, damping_rate = 300;

  double hertz_stiffness() const { return 4.0 / 3 * modulus / (1 - poisson * poisson) * std::sqrt(Bench::radius); }
  double resting() const {
    const double weight = Bench::mass * standard_gravity;
    return law == Law::elastic_shell ? eps : std::pow(weight / hertz_stiffness(), 2.0 / 3);
  }

  Bench bench() const {
    Bench bench;
    bench.gravity = {0, -standard_gravity};
    bench.scene.contact.law = law == Law::elastic_shell ? law : Law::hertz_viscous;
    bench.scene.contact.shell_compression = 0.01;
    bench.scene.contact.youngs_modulus = modulus;
    bench.scene.contact.poisson_ratio = poisson;
    bench.scene.contact.wall.restitution = 0.6;
    bench.scene.contact.damping_rate = damping_rate;
    bench.scene.contact.drag = drag;
    bench.scene.tray.motion = HarmonicMotion{1.5707963267948966, amplitude, frequency, 0};
    bench.place(0.5, Bench::radius - 0.9 * resting());
    return bench;
  }

  std::array<double, 2> exact() const {
    const double m = Bench::mass, w = 2 * Bench::pi * frequency, linear = m * standard_gravity / eps;
    // Of the shell: damping ratio of restitution 0.6 for a force that never pulls, from exp(-z (pi - 2 asin z) / sqrt(1
    // - z^2)) = 0.6 by bisection.
    double low = 0, high = 0.9;
    for (int k = 0; k < 100; ++k) {
      const double z = 0.5 * (low + high);
      (std::exp(-z * (Bench::pi - 2 * std::asin(z)) / std::sqrt(1 - z * z)) > 0.6 ? low : high) = z;
    }
    const double dashpot = law == Law::elastic_shell ? 2 * low * std::sqrt(linear * m) : damping_rate * m;
    const auto rate = [&](long double t, const std::array<long double, 2>& y, std::array<long double, 2>& d) {
      const long double overlap = Bench::radius + amplitude * std::sin(w * t) - y[0];
      const long double approach = amplitude * w * std::cos(w * t) - y[1];
      const long double elastic =
          law == Law::elastic_shell ? linear * overlap : hertz_stiffness() * overlap * std::sqrt(overlap);
      d[0] = y[1];
      d[1] = (elastic + dashpot * approach - drag * y[1]) / m - static_cast<long double>(standard_gravity);
    };
    return reference<2>({Bench::radius - 0.9 * resting(), 0}, duration, 20000, rate);
  }

  Convergence run(Integrator integrator, std::int64_t from, std::int64_t to) const {
    const std::array<double, 2> end = exact();
    const double omega = std::sqrt(standard_gravity / resting());
    Convergence runs;
    for (std::int64_t steps = from; steps <= to; steps *= 2) {
      Bench b = bench();
      b.scene.numerics.integrator = integrator;
      Simulation& run = b.start(duration / static_cast<double>(steps));
      run.steps(steps);
      const double dy = run.grains().y[0] - end[0], dv = run.grains().vy[0] - end[1];
      runs.steps.push_back(steps);
      runs.error.push_back(std::hypot(dy * omega, dv) / (0.1 * resting() * omega));
    }
    return runs;
  }
};

TEST_F(Order, OnASmoothProblemWithDragDampingAndAMovingWall) {
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const Integrator integrator : every_integrator) {
      const bool gear = integrator == Integrator::gear5;
      const Convergence runs = SmoothProblem{law}.run(integrator, gear ? 64 : 256, gear ? 1024 : 4096);
      tell("smooth", law, integrator, runs);
      for (std::size_t k = 1; k < runs.steps.size(); ++k) {
        SCOPED_TRACE(testing::Message() << name_of(law) << " " << name_of(integrator) << " " << runs.steps[k]
                                        << " steps, error " << runs.error[k]);
        EXPECT_GE(runs.order(k), gear ? 4.8 : 1.9);
        EXPECT_LE(runs.order(k), gear ? 5.2 : 2.2);
      }
    }
}

/// A disc on a slope with a tangential spring that holds, while it swings up and down on its elastic shell: x, y, vx,
/// vy, omega and the spring's displacement.
struct StuckProblem {
  Law law;

  static constexpr double duration = 0.02, tangent = 0.1, drag = 0.02, tangential_ratio = 14.0 / 17,
                          tangential_damping = 0.5;
  static constexpr double damping_rate = 300;

  SmoothProblem normal() const { return {law}; }

  Bench bench() const {
    Bench b = normal().bench();
    b.scene.tray.motion.reset();
    const double theta = std::atan(tangent);
    b.gravity = standard_gravity * Eigen::Vector2d(std::sin(theta), -std::cos(theta));
    b.scene.contact.wall.friction = 0.8;
    b.scene.contact.friction_model = FrictionModel::spring;
    b.scene.contact.tangential_damping = tangential_damping;
    return b;
  }

  std::array<double, 5> exact() const {
    const double m = Bench::mass, r = Bench::radius, theta = std::atan(tangent);
    const double linear = m * standard_gravity / SmoothProblem::eps;
    double low = 0, high = 0.9;
    for (int k = 0; k < 100; ++k) {
      const double z = 0.5 * (low + high);
      (std::exp(-z * (Bench::pi - 2 * std::asin(z)) / std::sqrt(1 - z * z)) > 0.6 ? low : high) = z;
    }
    const bool shell = law == Law::elastic_shell;
    const double dashpot = shell ? 2 * low * std::sqrt(linear * m) : damping_rate * m;
    const double nu = SmoothProblem::poisson, modulus = SmoothProblem::modulus, shear = modulus / (2 * (1 + nu));
    const auto rate = [&](long double, const std::array<long double, 6>& y, std::array<long double, 6>& d) {
      const long double overlap = r - y[1], arm = r - overlap, root = std::sqrt(overlap);
      const long double elastic = shell ? linear * overlap : normal().hertz_stiffness() * overlap * root;
      const long double tangential =
          shell ? tangential_ratio * linear : 8 * shear / (2 - nu) * std::sqrt(static_cast<long double>(r)) * root;
      const long double sliding = y[2] + arm * y[4];
      const long double friction = tangential * y[5] + tangential_damping * dashpot * sliding;
      d[0] = y[2], d[1] = y[3];
      d[2] = (-friction - drag * y[2]) / m + standard_gravity * std::sin(theta);
      d[3] = (elastic - dashpot * y[3] - drag * y[3]) / m - standard_gravity * std::cos(theta);
      d[4] = -arm * friction / (0.5 * m * r * r);
      d[5] = sliding;
    };
    const auto end = reference<6>({0.5, r - 0.9L * normal().resting(), 0, 0, 0, 0}, duration, 20000, rate);
    return {end[0], end[1], end[2], end[3], end[4]};
  }
};

// The memory moves on with the mean sliding speed of a step (Verlet) or its midpoint's (RK2): second order. Gear's
// memory does the same, which makes it second order here too.
TEST_F(Order, OfATangentialSpringThatHolds) {
  for (const Law law : {Law::elastic_shell, Law::hertz}) {
    const StuckProblem problem{law};
    const std::array<double, 5> end = problem.exact();
    for (const Integrator integrator : every_integrator) {
      Convergence runs;
      for (std::int64_t steps = 256; steps <= 4096; steps *= 2) {
        Bench b = problem.bench();
        b.scene.numerics.integrator = integrator;
        Simulation& run = b.start(StuckProblem::duration / static_cast<double>(steps));
        run.steps(steps);
        const Grains& g = run.grains();
        const double speed = end[2];  // every error as a speed, over the speed reached
        const double sum = std::hypot(g.vx[0] - end[2], g.vy[0] - end[3], Bench::radius * (g.omega[0] - end[4]));
        runs.steps.push_back(steps);
        runs.error.push_back(sum / speed);
      }
      tell("tangential spring", law, integrator, runs);
      for (std::size_t k = 1; k < runs.steps.size(); ++k) {
        SCOPED_TRACE(testing::Message() << name_of(law) << " " << name_of(integrator) << " " << runs.steps[k]);
        EXPECT_GE(runs.order(k), 1.9);
      }
    }
  }
}

/// Relative error of the speed after an elastic impact on the floor, the root mean square over moments of touch within
/// the step.
double impact_error(Law law, Integrator integrator, int steps_per_contact) {
  constexpr int phases = 64;
  double sum = 0;
  for (int k = 0; k < phases; ++k) {
    Bench bench;
    bench.scene.contact.law = law;
    bench.scene.contact.youngs_modulus = 1e9;
    bench.scene.numerics.integrator = integrator;
    const double speed = 0.1, modulus = 1e9 / (1 - 0.09);
    const double contact = law == Law::elastic_shell
                               ? bench.contact_time()
                               : HertzImpact(Bench::mass, 4.0 / 3 * modulus * std::sqrt(Bench::radius), speed).duration;
    const double dt = contact / steps_per_contact;
    const double e = wall_impact(bench, speed, 0, dt, 0, 8 + (k + 0.5) / phases).vy / speed - 1;
    sum += e * e;
  }
  return std::sqrt(sum / phases);
}

// The force has a kink at touch, where no scheme keeps its order: stated, and held to what a kink leaves.
TEST_F(Order, AcrossOneImpact) {
  for (const Law law : {Law::elastic_shell, Law::hertz})
    for (const Integrator integrator : every_integrator) {
      Convergence runs;
      for (const int steps : {25, 50, 100, 200, 400, 800})
        runs.steps.push_back(steps), runs.error.push_back(impact_error(law, integrator, steps));
      tell("one impact", law, integrator, runs);
      const double mean_order = std::log2(runs.error.front() / runs.error.back()) / 5;
      EXPECT_GE(mean_order, 1.9) << name_of(law) << " " << name_of(integrator);
    }
}

TEST(Drag, SlowsAFreeGrainExponentially) {
  for (const Integrator integrator : every_integrator) {
    Bench bench;
    bench.scene.numerics.integrator = integrator;
    bench.scene.contact.drag = 3e-3;  // kg/s, mu / m = 5 1/s
    bench.place(0.3, 0.5, 0.5, 0);
    Simulation& run = bench.start(1e-4);
    run.steps(5000);
    EXPECT_NEAR(run.grains().vx[0], 0.5 * std::exp(-5 * 0.5), 1e-6);
  }
}

TEST(FreeFall, IsAParabola) {
  for (const Integrator integrator : every_integrator) {
    Bench bench;
    bench.gravity = {0, -standard_gravity};
    bench.scene.numerics.integrator = integrator;
    bench.place(0.3, 0.9, 0.1, 0);
    Simulation& run = bench.start(1e-4);
    run.steps(3000);
    EXPECT_NEAR(run.grains().y[0], 0.9 - 0.5 * standard_gravity * 0.09, 1e-12);
    EXPECT_NEAR(run.grains().x[0], 0.33, 1e-12);
  }
}

}  // namespace
}  // namespace vibrosow
