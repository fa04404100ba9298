#include "recording/recording.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "fields/tray_frame.hpp"
#include "recording/read_recording.hpp"
#include "scene/input_error.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::json;

/// Reads the format as docs/reference/recording-format.md tells it.
class Reader {
 public:
  explicit Reader(const std::string& file) {
    EXPECT_EQ(file.substr(0, 8), "VBSWREC1");
    std::uint32_t size = 0;
    std::memcpy(&size, file.data() + 8, 4);
    header = Json::parse(file.substr(12, size));
    for (const Json& block : header["blocks"]) read_block(part(file, block), block["frames"]);
    for (const Json& one : header["contacts"]) read_contacts(part(file, one), one["frame"]);
    for (const std::string name : {"map", "hopper_map"})
      if (header.contains(name)) read_map(part(file, header[name]), header[name], maps[name]);
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
  struct Pair {
    std::uint32_t grain, partner;
    double force;
  };
  struct Touch {
    std::uint32_t grain;
    std::vector<int> place;
    double force;
  };
  struct Map {
    std::vector<float> packing, vx, vy;
  };
  struct Contacts {
    double largest;
    std::vector<Pair> pairs;
    std::vector<Touch> touches;
  };
  Json header;
  std::vector<Frame> frames;
  std::map<int, Contacts> contacts;  // by frame
  std::map<std::string, Map> maps;   // by key of the header
  std::map<std::int64_t, Entered> entered;

 private:
  template <class Value>
  Value take() {
    Value value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  std::string part(const std::string& file, const Json& entry) const {
    std::uint32_t size = 0;
    std::memcpy(&size, file.data() + 8, 4);
    return file.substr(12 + size + entry["offset"].get<std::size_t>(), entry["bytes"]);
  }

  std::size_t unpack(const std::string& packed) {
    bytes_.assign(100000000, '\0');
    uLongf size = bytes_.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                         packed.size()),
              Z_OK);
    at_ = 0;
    return size;
  }

  std::vector<std::uint32_t> take_planes(std::uint32_t count) {
    std::vector<std::uint32_t> values(count, 0);
    for (std::uint32_t plane = 0; plane < 4; ++plane)
      for (std::uint32_t& value : values) value |= std::uint32_t(take<std::uint8_t>()) << (8 * plane);
    return values;
  }

  void read_contacts(const std::string& packed, int frame) {
    const std::size_t size = unpack(packed);
    Contacts& now = contacts[frame];
    now.largest = take<double>();
    now.pairs.resize(take<std::uint32_t>()), now.touches.resize(take<std::uint32_t>());
    const auto pairs = static_cast<std::uint32_t>(now.pairs.size()),
               touches = static_cast<std::uint32_t>(now.touches.size());
    const auto force = [&] { return now.largest * std::pow(10, -take<std::uint8_t>() / 64.0); };
    const auto grains = take_planes(pairs), beyond = take_planes(pairs);
    for (std::size_t k = 0; k < pairs; ++k) {
      now.pairs[k].grain = grains[k] + (k > 0 ? now.pairs[k - 1].grain : 0);
      now.pairs[k].partner = now.pairs[k].grain + beyond[k];
      now.pairs[k].force = force();
    }
    const auto touched = take_planes(touches);
    for (std::size_t k = 0; k < touches; ++k)
      now.touches[k].grain = touched[k] + (k > 0 ? now.touches[k - 1].grain : 0);
    const bool is_3d = std::find(header["fields"].begin(), header["fields"].end(), "z") != header["fields"].end();
    for (int axis = 0; axis < (is_3d ? 3 : 2); ++axis)
      for (Touch& touch : now.touches) touch.place.push_back(take<std::int8_t>());
    for (Touch& touch : now.touches) touch.force = force();
    EXPECT_EQ(at_, size);
  }

  void read_map(const std::string& packed, const Json& head, Map& map) {
    const std::size_t size = unpack(packed);
    const std::size_t cells = head["columns"].get<std::size_t>() * head["rows"].get<std::size_t>();
    for (std::vector<float>* values : {&map.packing, &map.vx, &map.vy})
      for (std::size_t k = 0; k < cells; ++k) values->push_back(take<float>());
    EXPECT_EQ(at_, size);
  }

  void read_block(const std::string& packed, int count) {
    const std::size_t size = unpack(packed);
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
            coded |= std::uint32_t(static_cast<unsigned char>(bytes_[at_ + std::size_t{plane} * present + i]))
                     << (8 * plane);
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
INSTANTIATE_TEST_SUITE_P(Recording, OfBothSpaces, testing::Values(Space::two_dimensional, Space::three_dimensional));

TEST_P(OfBothSpaces, EveryFrameIsTheBedToHalfACount) {
  const Model model = with_step(prepare(open_box(GetParam())), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  std::vector<Grains> beds;
  std::vector<double> times;
  std::vector<Pose> poses;
  const auto look = [&](Simulation& now) {
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

TEST_P(OfBothSpaces, EveryContactIsKeptWithItsForce) {
  const Model model = with_step(prepare(open_box(GetParam())), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  std::vector<std::vector<GrainContact>> contacts;
  std::vector<Grains> beds;
  run.watch(0.002, [&](Simulation& now) {
    contacts.push_back(now.field().contacts());
    beds.push_back(now.grains());
    recording.add(now);
  });
  while (!run.at_end()) ASSERT_TRUE(run.step());
  const Reader read(recording.file());
  EXPECT_GT(read.contacts.size(), 20u);
  EXPECT_LE(read.contacts.size(), 50u);
  std::size_t pairs = 0, touches = 0;
  for (const auto& [frame, kept] : read.contacts) {
    const auto& all = contacts.at(static_cast<std::size_t>(frame));
    const Grains& bed = beds.at(static_cast<std::size_t>(frame));
    ASSERT_EQ(kept.pairs.size() + kept.touches.size(), all.size());
    std::multimap<std::pair<std::int64_t, std::int64_t>, double> of_two;
    std::multimap<std::int64_t, const GrainContact*> alone;
    const auto size = [](const GrainContact& c) {
      return std::hypot(c.normal_force[0], c.normal_force[1], c.normal_force[2]);
    };
    for (const GrainContact& c : all) {
      if (c.partner < 0)
        alone.emplace(c.grain, &c);
      else
        of_two.emplace(std::minmax(c.grain, c.partner), size(c));
    }
    const double error = std::pow(10, 1.001 / 128), least = kept.largest * std::pow(10, -255.0 / 64);
    for (const Reader::Pair& pair : kept.pairs) {
      const auto found = of_two.find({bed.id.at(pair.grain), bed.id.at(pair.partner)});
      ASSERT_NE(found, of_two.end());
      EXPECT_LE(found->second, pair.force * error);
      EXPECT_TRUE(pair.force <= least * error || found->second >= pair.force / error);
      of_two.erase(found);
    }
    for (const Reader::Touch& touch : kept.touches) {  // a grain in a corner touches two walls
      const auto [from, to] = alone.equal_range(bed.id.at(touch.grain));
      const Eigen::Vector3d centre = place_of(bed, touch.grain);
      const double radius = bed.kind(touch.grain).radius;
      const auto is_it = [&](const auto& one) {
        double furthest = 0;
        for (std::size_t axis = 0; axis < touch.place.size(); ++axis)
          furthest = std::max(furthest, std::abs(centre[static_cast<Eigen::Index>(axis)] +
                                                 0.01 * touch.place[axis] * radius - one.second->to[axis]));
        return furthest < 0.00501 * radius && size(*one.second) <= touch.force * error;
      };
      const auto found = std::find_if(from, to, is_it);
      ASSERT_NE(found, to);
      alone.erase(found);
    }
    pairs += kept.pairs.size(), touches += kept.touches.size();
  }
  EXPECT_GT(pairs, 50u);
  EXPECT_GT(touches, 50u);
}

TEST(Recording, AContactAcrossAPeriodicBoundaryIsOneOfEachGrainAlone) {
  Bench bench;
  bench.scene.tray.length = 0.1, bench.scene.tray.height = 0.1, bench.scene.tray.sides = Sides::periodic;
  const double overlap = 1e-5;
  bench.place(Bench::radius - overlap, 0.05).place(0.1 - Bench::radius + overlap, 0.05);
  Simulation& run = bench.start(1e-5);
  Recording recording(run.model());
  recording.add(run);
  const Reader read(recording.file());
  const Reader::Contacts& contacts = read.contacts.at(0);
  EXPECT_TRUE(contacts.pairs.empty());
  ASSERT_EQ(contacts.touches.size(), 2u);
  EXPECT_EQ(contacts.touches[0].place, (std::vector<int>{-100, 0}));
  EXPECT_EQ(contacts.touches[1].place, (std::vector<int>{100, 0}));
  EXPECT_GT(contacts.touches[0].force, 0);
}

TEST_P(OfBothSpaces, ARunThatIsRecordedIsTheSame) {
  const Model model = with_step(prepare(open_box(GetParam())), 5e-5);
  Simulation alone(model, 1), watched(model, 1);
  Recording recording(model);
  for (const Observer& one : recording.observers()) one.observe(watched), watched.watch(one.every, one.observe);
  while (!alone.at_end()) ASSERT_TRUE(alone.step() && watched.step());
  EXPECT_EQ(alone.grains().id, watched.grains().id);
  EXPECT_EQ(alone.grains().x, watched.grains().x);
  EXPECT_EQ(alone.grains().y, watched.grains().y);
  EXPECT_EQ(alone.grains().z, watched.grains().z);
  EXPECT_EQ(alone.grains().omega, watched.grains().omega);
  EXPECT_GT(Reader(recording.file()).contacts.size(), 20u);
}

TEST_P(OfBothSpaces, TheMapIsTheMeanOfTheMeasuringWindow) {
  Scene scene = open_box(GetParam());
  scene.run.measure_from = 0.3;
  const Model model = with_step(prepare(scene), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  EXPECT_FALSE(Reader(recording.file()).header.contains("map"));
  scene.record = Record{{}, 1.5 * scene.lots[0].diameter, MapView::projection};
  MeanMapSum sum(scene);
  const GrainExtents extents(scene.lots);
  for (const Observer& one : recording.observers()) run.watch(one.every, one.observe);
  run.watch(recording.observers()[1].every, [&](Simulation& now) {
    if (now.time() < 0.3) return;
    Snapshot bed = now.frame().bed;
    extents.add_to(bed);
    bed.start_x = bed.x, bed.start_y = bed.y, bed.start_z = bed.z;
    sum.add(in_tray_frame(bed, scene.tray));
  });
  while (!run.at_end()) ASSERT_TRUE(run.step());
  const Reader read(recording.file());
  const MeanMap map = sum.mean();
  EXPECT_EQ(read.header["map"]["looks"], map.looks);
  EXPECT_NEAR(map.looks, 211, 25);  // of whole steps
  EXPECT_GE(read.header["map"]["from_s"].get<double>(), 0.3);
  EXPECT_DOUBLE_EQ(read.header["map"]["cell_m"].get<double>(), scene.record->cell);
  const Reader::Map& kept = read.maps.at("map");
  ASSERT_EQ(kept.packing.size(), map.grid.size());
  for (std::size_t k = 0; k < kept.packing.size(); ++k) {
    EXPECT_EQ(kept.packing[k], static_cast<float>(map.packing[k]));
    EXPECT_TRUE(kept.vy[k] == static_cast<float>(map.vy[k]) || (std::isnan(kept.vy[k]) && map.packing[k] == 0));
  }
  EXPECT_FALSE(read.maps.contains("hopper_map"));
}

/// How many grains of a scene's first lot a map holds.
double grains_in(const Reader::Map& map, const Json& head, const Scene& scene, const Vessel& vessel) {
  const double cell = head["cell_m"], radius = 0.5 * scene.lots[0].diameter;
  const bool is_3d = scene.space == Space::three_dimensional;
  const double room = cell * cell * (is_3d ? *vessel.depth : 1);
  const double grain = std::numbers::pi * radius * radius * (is_3d ? 4.0 / 3 * radius : 1);
  return std::accumulate(map.packing.begin(), map.packing.end(), 0.0) * room / grain;
}

TEST_P(OfBothSpaces, WhatIsInAHopperThatRestsIsInItsOwnMapAlone) {
  Scene scene = open_box(GetParam());
  scene.tray.rain.reset();
  scene.tray.holes.clear();
  scene.tray.fill->count = 9;
  Vessel& hopper = scene.hopper.emplace();
  hopper.name = "hopper", hopper.origin = {0.03, 0.05}, hopper.length = hopper.height = 0.04;  // within the tray
  if (scene.space == Space::three_dimensional) hopper.front = 0.01, hopper.depth = 0.03;
  hopper.fill = Fill{5, Packing::layers, 0, false};
  scene.run.measure_from = 0.3;
  const Model model = with_step(prepare(scene), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  for (const Observer& one : recording.observers()) run.watch(one.every, one.observe);
  while (!run.at_end()) ASSERT_TRUE(run.step());
  const Reader read(recording.file());
  const Reader::Map& own = read.maps.at("hopper_map");
  EXPECT_NEAR(grains_in(own, read.header["hopper_map"], scene, hopper), 5, 1e-3);
  EXPECT_NEAR(grains_in(read.maps.at("map"), read.header["map"], scene, scene.tray), 9, 1e-3);
  EXPECT_EQ(read.header["hopper_map"]["columns"], 4);
  for (std::size_t k = 0; k < own.vx.size(); ++k) {
    if (own.packing[k] == 0) continue;
    EXPECT_NEAR(own.vx[k], 0, 0.02) << "the tray swings at 0.25 m/s";
  }
}

TEST(Recording, AClumpsAngleIsKept) {
  Scene scene = open_box(Space::two_dimensional);
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
  run.watch(0.002, [&](Simulation& now) { recording.add(now); });
  while (!run.at_end()) ASSERT_TRUE(run.step());
  const Reader told(recording.file());
  std::size_t k = 0;
  read_recording(recording.file(), [&](const Snapshot& bed) {
    const auto& frame = told.frames.at(k++);
    EXPECT_EQ(bed.time, frame.time);
    ASSERT_EQ(bed.id, frame.id);
    EXPECT_EQ(bed.is_3d(), GetParam() == Space::three_dimensional);
    for (std::size_t i = 0; i < bed.size(); ++i) {
      EXPECT_DOUBLE_EQ(bed.y[i], static_cast<double>(frame.counts[1][i]) * told.header["unit_m"].get<double>());
      EXPECT_EQ(bed.radius[i], told.entered.at(bed.id[i]).radius);
    }
  });
  EXPECT_EQ(k, told.frames.size());
}

TEST(Recording, ADamagedFileIsAnErrorOrRead) {
  const Model model = with_step(prepare(open_box(Space::two_dimensional)), 5e-5);
  Simulation run(model, 1);
  Recording recording(model);
  run.watch(0.01, [&](Simulation& now) { recording.add(now); });
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
  Scene scene = open_box(Space::two_dimensional);
  scene.run.duration = 4;
  EXPECT_DOUBLE_EQ(frame_interval(prepare(scene)), 4.0 / 500);
  scene.tray.holes.clear(), scene.tray.rain.reset();
  scene.tray.fill->count = 5000;
  EXPECT_NEAR(frame_interval(prepare(scene)), 4.0 / 250, 1e-6);
  scene.tray.fill->count = 1000000;
  EXPECT_DOUBLE_EQ(frame_interval(prepare(scene)), 4.0 / 20);
}

TEST(Recording, OfNoFrameIsAFileToo) {
  const Reader read(Recording(prepare(open_box(Space::two_dimensional))).file());
  EXPECT_EQ(read.header["frames"], 0);
}

}  // namespace
}  // namespace vibrosow
