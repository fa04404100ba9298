#include "study/study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <set>
#include <tuple>

#include "input/input_file.hpp"
#include "scene/input_error.hpp"
#include "study/study_grid.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::ThrowsMessage;

std::vector<std::string> range(const std::string& key, const std::string& from, const std::string& to,
                               const std::string& step) {
  std::vector<std::string> texts;
  for (const TomlValue& value : range_values(key, parse_toml_value(from), parse_toml_value(to), parse_toml_value(step)))
    texts.push_back(toml_text(value));
  return texts;
}

TEST(Range, HasBothEndsInTheUnitOfItsStart) {
  EXPECT_THAT(range("tray.motion.frequency", "'7 Hz'", "'13 Hz'", "'2 Hz'"),
              ElementsAre("\"7 Hz\"", "\"9 Hz\"", "\"11 Hz\"", "\"13 Hz\""));
  EXPECT_THAT(range("tray.holes.span", "'30 cm'", "'0.36 m'", "'30 mm'"),
              ElementsAre("\"30 cm\"", "\"33 cm\"", "\"36 cm\""));
  EXPECT_THAT(range("contact.friction", "0.1", "0.3", "0.1"), ElementsAre("0.1", "0.2", "0.3"));
  EXPECT_THAT(range("tray.holes.count", "5", "1", "-2"), ElementsAre("5", "3", "1"));
}

TEST(Range, ValuesAreThoseOfTheirTwelveDigits) {
  EXPECT_TRUE(rc::check("as if written and read", [] {
    const double first = *rc::gen::inRange(-100000, 100000) / 1000.0;
    const double step = *rc::gen::inRange(1, 100000) / 1e6;
    const int steps = *rc::gen::inRange(0, 20);
    const auto values = range_values("contact.friction", {first}, {first + steps * step}, {step});
    RC_ASSERT(values.size() == static_cast<std::size_t>(steps) + 1);
    for (int k = 0; k <= steps; ++k) {
      const double written = std::stod(fmt::format("{:.12g}", first + k * step));
      const TomlValue& value = values[static_cast<std::size_t>(k)];
      const auto* whole = value.get<std::int64_t>();
      RC_ASSERT(written == (whole != nullptr ? static_cast<double>(*whole) : *value.get<double>()));
    }
  }));
}

TEST(Range, ThatMissesItsEndOrNeverStepsIsRefused) {
  EXPECT_THROW(range("tray.motion.frequency", "'7 Hz'", "'12 Hz'", "'2 Hz'"), std::invalid_argument);
  EXPECT_THROW(range("tray.motion.frequency", "7", "12", "2"), UnitError);
  EXPECT_THROW(range("tray.holes.count", "1", "5", "0"), std::invalid_argument);
  EXPECT_THROW(range("tray.holes.count", "1", "5", "-1"), std::invalid_argument);
  EXPECT_THROW(range("tray.holes.count", "'1 mm'", "'5 mm'", "'1 mm'"), std::invalid_argument);
  EXPECT_THROW(range("contact.friction", "nan", "0.3", "0.1"), std::invalid_argument);
  EXPECT_THROW(range("contact.friction", "0.1", "inf", "0.1"), std::invalid_argument);
  EXPECT_THROW(range("contact.friction", "true", "0.3", "0.1"), std::invalid_argument);
}

TEST(Study, AFillOfAHeightAndTheContactFollowAVariedCrop) {
  const StudyFiles files;
  const std::string crops = "[vary]\nseeds.wheat.crop = [\"wheat-ball\", \"pea\"]\n";
  const std::string unset = "unset = [\"seeds.wheat.diameter\", \"seeds.wheat.mass\", \"contact\", \"tray.fill\"]\n";
  for (const char* contact : {"", "contact.model = \"crop\"\n"}) {
    const Study study = read_study(files.study("[set]\n" + unset + contact + "tray.fill.height = \"3 cm\"\n" + crops));
    ASSERT_EQ(study.scenes.size(), 2u);
    const Scene &wheat = study.scenes[0], &pea = study.scenes[1];
    const auto seeds_3_cm_high = [](double diameter) {
      return 0.82 * 0.5 * 0.03 / (0.785398163 * diameter * diameter);
    };
    EXPECT_NEAR(wheat.tray.fill->count, seeds_3_cm_high(wheat.lots[0].diameter), 0.5);
    EXPECT_NEAR(pea.tray.fill->count, seeds_3_cm_high(pea.lots[0].diameter), 0.5);
    EXPECT_EQ(pea.lots[0].contact.name, "pea-steel");
    EXPECT_EQ(wheat.lots[0].contact.name, "wheat-ball-steel");
    EXPECT_FALSE(pea.contact == wheat.contact);
  }
}

TEST(Study, ExpandsTheGridFirstKeySlowestInFileOrder) {
  const StudyFiles files;
  const Study study = read_study(files.study(R"([vary]
tray.holes.span = ["30 cm", "36 cm"]
tray.holes.count = [3, 5]
)"));
  EXPECT_THAT(study.keys, ElementsAre("tray.holes.span", "tray.holes.count"));
  ASSERT_EQ(study.layouts.size(), 4u);
  EXPECT_EQ(study.replicates.number, 5);
  std::vector<std::string> seen;
  for (Layout layout : study.layouts)
    seen.push_back(layout.values["tray.holes.span"] + "/" + layout.values["tray.holes.count"]);
  EXPECT_THAT(seen, ElementsAre("300/3", "300/5", "360/3", "360/5"));
  EXPECT_EQ(study.scenes[1].tray.holes.size(), 5u);
  EXPECT_DOUBLE_EQ(study.scenes[1].tray.holes.back().centre - study.scenes[1].tray.holes.front().centre, 0.30);
}

TEST(Study, ProposalsFillTheSpaceThatVarySpans) {
  const StudyFiles files;
  const Study study = read_study(files.study(R"(proposals = 12
[vary]
tray.holes.count = { from = 2, to = 5 }
tray.holes.width = { from = "10 mm", to = "1.6 cm" }
tray.fill.packing = ["layers", "hexagonal"]
contact.friction = { from = 0.2, to = 0.5 }
)"));
  ASSERT_EQ(study.layouts.size(), 12u);
  std::map<std::string, int> counts, packings;
  std::multiset<double> widths, frictions;
  for (Layout layout : study.layouts) {
    ++counts[layout.values["tray.holes.count"]];
    ++packings[layout.values["tray.fill.packing"]];
    widths.insert(std::stod(layout.values["tray.holes.width"]));
    frictions.insert(std::stod(layout.values["contact.friction"]));
  }
  EXPECT_THAT(counts, ElementsAre(Pair("2", 3), Pair("3", 3), Pair("4", 3), Pair("5", 3)));
  EXPECT_THAT(packings, ElementsAre(Pair("hexagonal", 6), Pair("layers", 6)));
  for (const auto& [values, from, part] : {std::tuple{widths, 10.0, 0.5}, std::tuple{frictions, 0.2, 0.025}}) {
    double start = from;  // of the part of the range in which the next value lies, rounded to four digits
    for (const double value : values) {
      EXPECT_GE(value, start - 0.01 * part);
      EXPECT_LE(value, start + 1.01 * part);
      start += part;
    }
  }
}

TEST(Study, ProposalsNeedASpaceAndRangesThatLeadUp) {
  const StudyFiles files;
  const auto says = [&](const std::string& study, const std::string& what) {
    const auto path = files.study(study);
    EXPECT_THAT([&] { read_study(path); }, ThrowsMessage<InputError>(HasSubstr(what))) << study;
  };
  says("proposals = 12\n", "study.toml:2: proposals");
  says("proposals = 0\n[vary]\ncontact.friction = [0.1]\n", "study.toml:2: proposals");
  says("proposals = 3\n[vary]\ncontact.friction = { from = 0.3, to = 0.2 }\n", "study.toml:4: vary.contact.friction");
  says("proposals = 3\n[vary]\ntray.holes.width = { from = 1, to = 2 }\n", "study.toml:4: vary.tray.holes.width");
  says("[vary]\ncontact.friction = { from = 0.2, to = 0.3 }\n", "step is missing");
}

TEST(Study, SameHolesFromDifferentKeysAreOneScene) {
  const StudyFiles files;
  const Study study = read_study(files.study(R"([vary]
tray.holes.count = [1, 3]
tray.holes.span = ["30 cm", "36 cm"]
)"));
  ASSERT_EQ(study.layouts.size(), 4u);
  EXPECT_EQ(study.scenes.size(), 3u);
  EXPECT_EQ(study.layouts[0].scene, study.layouts[1].scene);
}

TEST(Study, ImpossibleLayoutIsListedWithItsReason) {
  const StudyFiles files;
  const Study study = read_study(files.study("[vary]\ntray.holes.span = [\"36 cm\", \"90 cm\"]\n"));
  EXPECT_TRUE(study.layouts[0].scene);
  EXPECT_FALSE(study.layouts[1].scene);
  EXPECT_THAT(study.layouts[1].invalid, HasSubstr("study.toml:3"));
}

TEST(Study, AValueThatCannotBeReadIsNoLayout) {
  const StudyFiles files;
  EXPECT_THAT([&] { read_study(files.study("[vary]\ntray.holes.width = [\"12 mm\", \"12\"]\n")); },
              testing::ThrowsMessage<InputError>(HasSubstr("study.toml:3: tray.holes.width: ")));
  EXPECT_THAT([&] { read_study(files.study("[vary]\ntray.holes.width = [\"12 mm\", \"12 kg\"]\n")); },
              testing::ThrowsMessage<InputError>(HasSubstr("study.toml:3: tray.holes.width: ")));
}

TEST(Study, StepTooLongMakesALayoutInvalid) {
  const StudyFiles files;
  const Study study = read_study(files.study("[vary]\nnumerics.dt = [\"1e-6 s\", \"1 ms\"]\n"));
  EXPECT_TRUE(study.layouts[0].scene);
  EXPECT_THAT(study.layouts[1].invalid, HasSubstr("longest safe step"));
}

TEST(Study, WhereNothingIsValidStopsWithTheReason) {
  const StudyFiles files;
  const auto path = files.study("[set]\ntray.hole.count = 3\n[vary]\ncontact.friction = [0.1, 0.2]\n");
  EXPECT_THAT([&] { read_study(path); }, ThrowsMessage<InputError>(HasSubstr("study.toml:3")));
}

TEST(Study, NamedDesignsRunOverTheGrid) {
  const StudyFiles files;
  const Study study = read_study(files.study(R"(replicates = 2
[vary]
contact.friction = [0.1, 0.2]
[[layout]]
name = "wide"
tray.holes.width = "20 mm"
[[layout]]
name = "narrow"
[layout.tray.holes]
width = "12 mm"
)"));
  ASSERT_EQ(study.layouts.size(), 4u);
  EXPECT_EQ(study.layouts[1].name, "wide");
  EXPECT_EQ(study.layouts[2].name, "narrow");
  EXPECT_DOUBLE_EQ(study.scenes[2].tray.holes[0].width, 0.012);
  EXPECT_EQ(study.layouts[3].values.at("contact.friction"), "0.2");
}

TEST(Study, KeyBothSetAndVariedIsRefused) {
  const StudyFiles files;
  const auto path = files.study("[set]\ncontact.friction = 0.1\n[vary]\ncontact.friction = [0.1, 0.2]\n");
  EXPECT_THAT([&] { read_study(path); }, ThrowsMessage<InputError>(HasSubstr("varied here, and set at")));
}

TEST(Study, OverridesReachTheStudyOrItsSeeders) {
  const StudyFiles files;
  const auto path = files.study("[vary]\ncontact.friction = [0.1, 0.2]\n");
  const Study study = read_study(path, {parse_override("replicates=7"), parse_override("tray.holes.count=5")});
  EXPECT_EQ(study.replicates.number, 7);
  EXPECT_EQ(study.scenes[0].tray.holes.size(), 5u);
}

TEST(Study, MistakesOfItsOwnAreNamed) {
  const StudyFiles files;
  EXPECT_THAT([&] { read_study(files.study("replicate = 3\n")); }, ThrowsMessage<InputError>(HasSubstr("replicates")));
  EXPECT_THROW(read_study(files.study("replicates = 0\n")), InputError);
  EXPECT_THROW(read_study(files.study("[vary]\ntray.holes.count = []\n")), InputError);
  EXPECT_THROW(read_study(files.study("[vary]\ntray.holes.count = {from = 1, to = 5}\n")), InputError);
}

TEST(Study, WithoutVaryItsLayoutsAreTheMeasuredConditions) {
  const StudyFiles files;
  files.write("bench.csv", "tray.holes.count,hole,rate_g_per_s\n3,1,0.5\n3,2,0.6\n5,all,2\n");
  const Study study = read_study(files.study("[measured]\nfile = \"bench.csv\"\nscale = \"free\"\n"));
  ASSERT_EQ(study.layouts.size(), 2u);
  ASSERT_EQ(study.measured->matches.size(), 3u);
  EXPECT_EQ(study.measured->matches[2].layout, 1u);
}

TEST(Study, MeasuredHoleOrLotThatALayoutHasNotIsRefused) {
  const StudyFiles files;
  for (const std::string table : {"hole,rate_g_per_s\n4,0.5\n", "lot,rate_g_per_s\nrye,0.5\n",
                                  "hole,time_s,seeds\n4,1,5\n", "lot,time_s,seeds\nrye,1,5\n"}) {
    files.write("bench.csv", table);
    EXPECT_THAT([&] { read_study(files.study("[measured]\nfile = \"bench.csv\"\n")); },
                ThrowsMessage<InputError>(
                    testing::AllOf(HasSubstr("bench.csv:2: "), HasSubstr("layout 1 has no such hole or lot"))))
        << table;
  }
}

TEST(Study, RefusesASharePassedWhereNothingIsFilledIn) {
  const StudyFiles files;
  files.write("bench.csv", "time_s,discharged_percent\n1,20\n3,60\n");
  const std::string measured = "[measured]\nfile = \"bench.csv\"\n";
  EXPECT_EQ(read_study(files.study(measured)).measured->matches.size(), 1u);
  files.write("seeder.toml", R"([seeds.wheat]
diameter = "4 mm"
mass = "40 mg"
[contact]
shell_compression = 1e-3
[tray]
length = "50 cm"
height = "12 cm"
rain = { rate = "20 1/s" }
[tray.holes]
at = ["25 cm"]
width = "16 mm"
[run]
duration = "4 s"
)");
  EXPECT_THAT([&] { read_study(files.study(measured)); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("bench.csv:2: "), HasSubstr("discharged_percent"))));
}

TEST(Study, RefusesAShareOfAFillThatIsToppedUp) {
  const StudyFiles files;
  files.write("bench.csv", "time_s,discharged_percent\n1,20\n3,60\n");
  const auto path = files.study("[set]\ntray.fill.keep = true\n[measured]\nfile = \"bench.csv\"\n");
  EXPECT_THAT([&] { read_study(path); },
              ThrowsMessage<InputError>(HasSubstr("layout 1 has none, or is fed; expected mass_g or seeds")));
}

TEST(Study, SaysWhichOfATablesSeriesCountForNothing) {
  const StudyFiles files;
  files.write("bench.csv", "contact.friction,rate_g_per_s\n0.1,5\n0.2,4\n0.4,3\n");
  const Study study =
      read_study(files.study("[vary]\ncontact.friction = [0.1, 0.3]\n[measured]\nfile = \"bench.csv\"\n"));
  EXPECT_EQ(compared_series(*study.measured), 1u);
  EXPECT_THAT(study_warnings(study), testing::Contains(HasSubstr("1 of the 3 series of")));
  const Study own = read_study(files.study("[measured]\nfile = \"bench.csv\"\n"));
  EXPECT_EQ(compared_series(*own.measured), 3u);
  EXPECT_THAT(study_warnings(own), testing::Not(testing::Contains(HasSubstr("series of"))));
}

TEST(Study, ReadsEveryFileOnce) {
  const StudyFiles files;
  files.write("bench.csv",
              "tray.holes.count,contact.friction,hole,rate_g_per_s\n3,0.1,1,0.5\n3,0.1,2,0.6\n5,0.2,all,2\n");
  files.write("crop.toml", "diameter = \"4 mm\"\nmass = \"40 mg\"\n");
  const InputFile file = input_file(files
                                        .study("[set]\nseeds.wheat.crop = \"crop.toml\"\n"
                                               "[vary]\ntray.holes.count = [3, 5]\ncontact.friction = [0.1, 0.2]\n"
                                               "[measured]\nfile = \"bench.csv\"\n")
                                        .string());
  const Study study = read_study(file.path, {}, file.files);
  EXPECT_EQ(study.scenes.size(), 4u);
  EXPECT_EQ(study.measured->matches.size(), 3u);
  EXPECT_EQ(file.files->reads(), 4);  // the study, its base, the crop, the measured table
}

TEST(Study, KeysAreUnsetByAStudyALayoutAndTheCommandLine) {
  const StudyFiles files;
  const std::string layouts = R"([[layout]]
name = "row"
[[layout]]
name = "by hand"
unset = ["tray.holes.count", "tray.holes.span"]
tray.holes.at = ["10 cm", "20 cm", "40 cm"]
)";
  const Study study = read_study(files.study(layouts));
  ASSERT_EQ(study.scenes.size(), 2u);
  EXPECT_DOUBLE_EQ(study.scenes[1].tray.holes[1].centre, 0.2);
  EXPECT_EQ(study.layouts[1].values.at("tray.holes.count"), "unset");
  EXPECT_FALSE(study.layouts[0].values.contains("tray.holes.count"));

  const Study by_set =
      read_study(files.study("[set]\nunset = [\"tray.holes.count\", \"tray.holes.span\"]\n[vary]\ntray.holes.at = "
                             "[[\"10 cm\"], [\"20 cm\"]]\n"));
  EXPECT_DOUBLE_EQ(by_set.scenes[1].tray.holes[0].centre, 0.2);

  const Study by_command = read_study(files.study("[vary]\ncontact.friction = [0.1, 0.2]\n"),
                                      {parse_override("tray.holes.span="), parse_override("tray.holes.pitch=10 cm")});
  EXPECT_DOUBLE_EQ(by_command.scenes[0].tray.holes[0].centre, 0.15);
}

/// What a layout is called by would not be so.
TEST(Study, KeyOfALayoutIsNotSetForAll) {
  const StudyFiles files;
  const auto path = files.study(
      "[[layout]]\nname = \"smooth\"\ncontact.friction = 0.1\n[[layout]]\nname = \"rough\"\ncontact.friction = 0.6\n");
  EXPECT_EQ(read_study(path, {parse_override("tray.holes.count=2")}).scenes.size(), 2u);
  EXPECT_THAT([&] { read_study(path, {parse_override("contact.friction=0.3")}); },
              ThrowsMessage<InputError>(HasSubstr("contact.friction: varied here, and set at")));
}

TEST(Study, UnsettingWhatIsNotThereOrIsVariedIsRefused) {
  const StudyFiles files;
  EXPECT_THAT([&] { read_study(files.study("[set]\nunset = [\"tray.hoels\"]\n")); },
              ThrowsMessage<InputError>(HasSubstr("study.toml:3: tray.hoels: cannot be taken out: tray.hoels is not "
                                                  "written; did you mean \"holes\"?")));
  EXPECT_THAT(
      [&] {
        read_study(files.study("[set]\nunset = [\"contact.friction\"]\n[vary]\ncontact.friction = [0.1, 0.2]\n"));
      },
      ThrowsMessage<InputError>(HasSubstr("varied here, and set at")));
  EXPECT_THROW(read_study(files.study("[set]\nunset = 3\n")), InputError);
}

TEST(Study, WarningsAreToldOnceWithTheirLayouts) {
  const StudyFiles files;
  const std::string sound = "[set]\nseeds.wheat.density = \"1200 kg/m3\"\nunset = [\"seeds.wheat.mass\"]\n";
  EXPECT_THAT(study_warnings(read_study(files.study(sound))), testing::IsEmpty());
  const std::string varied = "[vary]\ntray.holes.width = [\"3 mm\", \"16 mm\"]\ncontact.restitution = [0.4, 0.5]\n";
  EXPECT_THAT(study_warnings(read_study(files.study(sound + varied))),
              ElementsAre(testing::StartsWith("layouts 1, 2: tray.holes.width: 3 mm is narrower")));
  const std::string all = "[vary]\ntray.holes.width = [\"3 mm\"]\n";
  EXPECT_THAT(study_warnings(read_study(files.study(sound + all))),
              ElementsAre(testing::StartsWith("tray.holes.width")));
}

/// What slots are in 3D changes no run in 2D, but what its rates stand for, and which rows were measured there.
TEST(Study, SlotsThatDifferIn3dAloneAreLayoutsOfTheirOwn) {
  const StudyFiles files;
  files.write("bench.csv", "tray.holes.across_mm,rate_g_per_s\n60,340\n12,65\n");
  const std::string across = "[vary]\ntray.holes.across = [\"6 cm\", \"12 mm\"]\n";
  const Study study = read_study(files.study(across + "[measured]\nfile = \"bench.csv\"\n"));
  EXPECT_EQ(study.scenes.size(), 2u);
  EXPECT_THAT(study_warnings(study),
              testing::Contains(testing::StartsWith("layout 2: tray.holes.across: in 2D slots")));
  ASSERT_EQ(study.measured->matches.size(), 2u);
  for (const MeasuredMatch& match : study.measured->matches) EXPECT_EQ(match.layout, match.series);
  const Study rows = read_study(files.study("[vary]\ntray.holes.rows = [1, 3]\ntray.holes.across = [\"12 mm\"]\n"));
  EXPECT_THAT(study_warnings(rows),
              testing::Contains(testing::StartsWith("layout 2: tray.holes.rows: in 2D one hole")));
}

TEST(Study, FileThatIsNotThereIsToldWhereItIsNamed) {
  const StudyFiles files;
  EXPECT_THAT([&] { read_study(files.write("study.toml", "title = \"a\"\nbase = \"none.toml\"\n")); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("study.toml:2: base: "), HasSubstr("none.toml"))));
  EXPECT_THAT(
      [&] { read_study(files.study("[measured]\nfile = \"none.csv\"\n")); },
      ThrowsMessage<InputError>(testing::AllOf(HasSubstr("study.toml:3: measured.file: "), HasSubstr("none.csv"))));
}

TEST(Study, WrongKeyOfANamedDesignIsToldWithItsLine) {
  const StudyFiles files;
  EXPECT_THAT([&] { read_study(files.study("[[layout]]\nname = \"a\"\ntray.holes.count = \"many\"\n")); },
              ThrowsMessage<InputError>(HasSubstr("study.toml:4: tray.holes.count: ")));
}

TEST(Study, MeasuredConditionLeftOutMeansTheBase) {
  const StudyFiles files;
  files.write("bench.csv", "tray.holes.count,rate_g_per_s\n3,0.5\n5,2\n");
  const Study study =
      read_study(files.study("[vary]\ncontact.friction = [0.1, 0.2]\n[measured]\nfile = \"bench.csv\"\n"));
  ASSERT_EQ(study.measured->matches.size(), 2u);  // the base has three holes: the row of five fits no layout
  EXPECT_EQ(study.measured->matches[0].series, 0u);
  EXPECT_EQ(study.measured->matches[1].series, 0u);
}

}  // namespace
}  // namespace vibrosow
