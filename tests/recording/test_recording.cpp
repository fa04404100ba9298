#include "recording/recording.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "recording/read_recording.hpp"
#include "scene/input_error.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::json;

/// Reads the format as docs/RECORDING.md tells it.
class Reader {
 public:
  explicit Reader(const std::string& file) {
    EXPECT_EQ(file.substr(0, 8), "VBSWREC1");
    std::uint32_t size = 0;
    std::memcpy(&size, file.data() + 8, 4);
    header = Json::parse(file.substr(12, size));
    for (const Json& block : header["blocks"])
      read_block(file.substr(12 + size + block["offset"].get<std::size_t>(), block["bytes"]), block["frames"]);
  }

  struct Frame {
    double time;
    std::vector<std::array<double, 4>> vessels;
    std::vector<std::int64_t> id;
    std::vector<std::vector<std::int64_t>> counts;  // [field][grain]
  };
  struct Entered {
    int lot;
    float radius;
    std::array<float, 3> start;
  };
  Json header;
  std::vector<Frame> frames;
  std::map<std::int64_t, Entered> entered;

 private:
  template <class Value>
  Value take() {
    Value value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  void read_block(const std::string& packed, int count) {
    bytes_.assign(100000000, '\0');
    uLongf size = bytes_.size();
    ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                         packed.size()),
              Z_OK);
    at_ = 0;
    std::map<std::int64_t, std::vector<std::vector<std::int64_t>>> past;  // of each grain in this block, by frame
    std::vector<std::int64_t> ids;
    for (int k = 0; k < count; ++k) {
      Frame frame{take<double>(), {}, {}, {}};
      for (std::size_t v = 0; v < header["vessels"].size(); ++v)
        frame.vessels.push_back({take<double>(), take<double>(), take<double>(), take<double>()});
      const auto leaving = take<std::uint32_t>(), entering = take<std::uint32_t>(), present = take<std::uint32_t>();
      std::vector<std::uint32_t> gone;
      for (std::uint32_t i = 0; i < leaving; ++i) gone.push_back(take<std::uint32_t>());
      for (auto i = gone.rbegin(); i != gone.rend(); ++i) ids.erase(ids.begin() + *i);
      for (std::uint32_t i = 0; i < entering; ++i) {
        const auto id = take<std::uint32_t>();
        ids.push_back(id);
        const auto lot = take<std::uint16_t>();
        const auto radius = take<float>();
        entered[id] = {lot, radius, {take<float>(), take<float>(), take<float>()}};
      }
      ASSERT_EQ(ids.size(), present);
      frame.id = ids;
      for (std::size_t f = 0; f < header["fields"].size(); ++f) {
        std::vector<std::int64_t> values;
        for (std::uint32_t i = 0; i < present; ++i) {
          std::uint32_t coded = 0;
          for (std::uint32_t plane = 0; plane < 4; ++plane)
            coded |= std::uint32_t(static_cast<unsigned char>(bytes_[at_ + plane * present + i])) << (8 * plane);
          const auto& seen = past[ids[i]];
          const std::size_t n = seen.size();
          const std::int64_t expected = n == 0 ? 0 : n == 1 ? seen[0][f] : 2 * seen[n - 1][f] - seen[n - 2][f];
          values.push_back(expected + (coded % 2 == 0 ? std::int64_t(coded / 2) : -std::int64_t(coded / 2) - 1));
        }
        at_ += 4 * std::size_t(present);
        frame.counts.push_back(values);
      }
      for (std::uint32_t i = 0; i < present; ++i) {
        std::vector<std::int64_t> own;
        for (const auto& values : frame.counts) own.push_back(values[i]);
        past[ids[i]].push_back(own);
      }
      frames.push_back(frame);
    }
    EXPECT_EQ(at_, size);
  }

  std::string bytes_;
  std::size_t at_ = 0;
};

/// A shaken box that loses grains through its hole and gets others by rain.
Scene open_box(Space space) {
  Scene scene = Bench().scene;
  scene.space = space;
  scene.tray.length = 0.1, scene.tray.height = 0.1;
  scene.tray.holes = {{0.05, 0.04, 0}};
  scene.tray.fill = Fill{40, Packing::layers, 0, false};
  scene.tray.rain = Rain{100, 0.01, 0.09, 0.08};
  scene.tray.motion = HarmonicMotion{0, 0.004, 10, 0.05};
  if (space == Space::three_dimensional) {
    scene.lots[0].shape = Shape::ball;
    scene.tray.depth = 0.05;
    scene.tray.holes[0].across = 0.025, scene.tray.holes[0].across_length = 0.04;
  }
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.run.duration = 0.5;
  return scene;
}

class OfBothSpaces : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Recording, OfBothSpaces, testing::Values(Space::plane, Space::three_dimensional));

TEST_P(OfBothSpaces, EveryFrameIsTheBedToHalfACount) {
  const Model model = with_step(prepare(open_box(GetParam())), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  std::vector<Grains> beds;
  std::vector<double> times;
  std::vector<Pose> poses;
  const auto look = [&](const Simulation& now) {
    recording.add(now);
    beds.push_back(now.grains());
    times.push_back(now.time());
    poses.push_back(now.field().walls().pose(0, now.time()));
  };
  look(run);
  run.watch(0.002, look);
  while (!run.at_end()) ASSERT_TRUE(run.step());
  recording.add(run);  // the last frame is there already
  const Reader read(recording.file());
  ASSERT_EQ(read.frames.size(), beds.size());
  EXPECT_GT(read.header["blocks"].size(), 1u);
  EXPECT_LT(beds.back().id.front(), 40);
  EXPECT_NE(beds.back().id, beds.front().id) << "grains came and went";
  const auto units = read.header["field_units"].get<std::vector<double>>();
  EXPECT_DOUBLE_EQ(units[0], 2 * model.smallest_radius / 200);
  for (std::size_t k = 0; k < beds.size(); ++k) {
    const auto& frame = read.frames[k];
    EXPECT_EQ(frame.time, times[k]);
    ASSERT_EQ(frame.id, beds[k].id);
    EXPECT_EQ(frame.vessels[0][0], model.vessels[0].origin.x() + poses[k].displacement.x());
    for (std::size_t i = 0; i < frame.id.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(frame.counts[0][i]) * units[0], beds[k].x[i], 0.501 * units[0]);
      EXPECT_NEAR(static_cast<double>(frame.counts[1][i]) * units[1], beds[k].y[i], 0.501 * units[1]);
      const double z = units.size() > 2 ? static_cast<double>(frame.counts[2][i]) * units[2] : 0;
      EXPECT_NEAR(z, place_of(beds[k], i).z(), 0.501 * units.back());
      EXPECT_EQ(read.entered.at(frame.id[i]).radius, static_cast<float>(beds[k].kind(i).radius));
    }
  }
  for (std::size_t i = 0; i < beds.front().size(); ++i)
    EXPECT_EQ(read.entered.at(beds.front().id[i]).start[0], static_cast<float>(beds.front().x[i]))
        << "said again in every block";
}

TEST(Recording, AClumpsAngleIsKept) {
  Scene scene = open_box(Space::plane);
  scene.lots = {Bench().add_clump({{-2e-3, 0, 3e-3}, {2e-3, 0, 3e-3}}, Bench::mass).scene.lots.back()};
  const Model model = with_step(prepare(scene), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  run.run_until(0.1);
  recording.add(run);
  const Reader read(recording.file());
  EXPECT_EQ(read.header["fields"], (Json{"x", "y", "angle"}));
  for (std::size_t i = 0; i < run.grains().size(); ++i)
    EXPECT_NEAR(static_cast<double>(read.frames[0].counts[2][i]) * 2 * std::numbers::pi / 1024, run.grains().angle[i],
                1.001 * std::numbers::pi / 1024);
}

TEST_P(OfBothSpaces, IsReadBackAsItsFormatSays) {
  const Model model = with_step(prepare(open_box(GetParam())), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  run.watch(0.002, [&](const Simulation& now) { recording.add(now); });
  while (!run.at_end()) ASSERT_TRUE(run.step());
  const Reader told(recording.file());
  std::size_t k = 0;
  read_recording(recording.file(), [&](const Snapshot& bed) {
    const auto& frame = told.frames.at(k++);
    EXPECT_EQ(bed.time, frame.time);
    ASSERT_EQ(bed.id, frame.id);
    EXPECT_EQ(bed.in_space(), GetParam() == Space::three_dimensional);
    for (std::size_t i = 0; i < bed.size(); ++i) {
      EXPECT_DOUBLE_EQ(bed.y[i], static_cast<double>(frame.counts[1][i]) * told.header["unit_m"].get<double>());
      EXPECT_EQ(bed.radius[i], told.entered.at(bed.id[i]).radius);
    }
  });
  EXPECT_EQ(k, told.frames.size());
}

TEST(Recording, ADamagedFileIsAnErrorOrRead) {
  const Model model = with_step(prepare(open_box(Space::plane)), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  run.watch(0.01, [&](const Simulation& now) { recording.add(now); });
  ASSERT_TRUE(run.run_until(0.1));
  const std::string file = recording.file();
  const auto nothing = [](const Snapshot&) {};
  EXPECT_NO_THROW(read_recording(file, nothing));
  for (std::size_t size = 0; size < file.size(); size += 7)
    EXPECT_THROW(read_recording(file.substr(0, size), nothing), InputError) << size;
  for (std::size_t place = 0; place < file.size(); place += 3) {
    std::string other = file;
    other[place] = static_cast<char>(other[place] ^ 0x20);
    try {
      read_recording(other, nothing);
    } catch (const InputError&) {
    }
  }
}

TEST(Recording, TwentyToFiveHundredFramesByTheNumberOfGrains) {
  Scene scene = open_box(Space::plane);
  scene.run.duration = 4;
  EXPECT_DOUBLE_EQ(frame_interval(prepare(scene)), 4.0 / 500);
  scene.tray.holes.clear(), scene.tray.rain.reset();
  scene.tray.fill->count = 5000;
  EXPECT_NEAR(frame_interval(prepare(scene)), 4.0 / 250, 1e-6);
  scene.tray.fill->count = 1000000;
  EXPECT_DOUBLE_EQ(frame_interval(prepare(scene)), 4.0 / 20);
}

TEST(Recording, OfNoFrameIsAFileToo) {
  const Reader read(Recording(prepare(open_box(Space::plane))).file());
  EXPECT_EQ(read.header["frames"], 0);
}

}  // namespace
}  // namespace vibrosow
