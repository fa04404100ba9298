#include "recording/thinned_recording.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "recording/read_recording.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

constexpr double every = 1e-3, duration = 0.1;  // s

std::vector<double> times_in(const std::string& file) {
  std::vector<double> times;
  read_recording(file, [&](const Snapshot& bed) { times.push_back(bed.time); });
  return times;
}

class OfAFallingGrain : public testing::Test {
 protected:
  OfAFallingGrain() {
    Scene scene = Bench().place(0, 0.05).scene;
    scene.run.duration = duration;
    const Model model = with_step(prepare(scene), 5e-5);
    Simulation run(model, 1);
    thinned_.emplace(model), whole_.emplace(model);
    const auto look = [&](Simulation& now) { thinned_->add(now), whole_->add(now); };
    look(run);
    run.watch(every, look);
    while (!run.at_end()) run.step();
    look(run);
  }

  std::optional<ThinnedRecording> thinned_;
  std::optional<Recording> whole_;
};

TEST_F(OfAFallingGrain, EveryFrameIsKeptWhereThereIsRoom) {
  EXPECT_EQ(thinned_->file(whole_->file().size()), whole_->file());
}

TEST_F(OfAFallingGrain, FewerFramesEvenlyAndTheLastWhereThereIsLess) {
  const std::vector<double> all = times_in(whole_->file());
  std::size_t frames = all.size(), fewer = 0;
  for (std::size_t most = whole_->file().size(); !thinned_->file(most).empty(); most -= 10) {
    EXPECT_LE(thinned_->file(most).size(), most);
    const std::vector<double> times = times_in(thinned_->file(most));
    EXPECT_LE(times.size(), frames);
    fewer += times.size() < frames ? 1 : 0;
    frames = times.size();
    EXPECT_EQ(times.front(), 0);
    EXPECT_EQ(times.back(), all.back());
    for (std::size_t k = 2; k + 1 < times.size(); ++k) EXPECT_NEAR(times[k] - times[k - 1], times[1], 1e-9);
  }
  EXPECT_EQ(frames, 2U);
  EXPECT_GE(fewer, 8U);
}

}  // namespace
}  // namespace vibrosow
