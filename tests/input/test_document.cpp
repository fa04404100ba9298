#include "input/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input/wording.hpp"
#include "scene/input_error.hpp"
#include "temporary_file.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class DocumentTest : public testing::Test {
 protected:
  Table read(const std::string& text, const std::vector<Override>& overrides = {}) {
    file_ = folder_.write("file.toml", text);
    return Table(Document::read(file_, overrides));
  }
  std::string at(int line, const std::string& rest) const {
    return file_.string() + ":" + std::to_string(line) + ": " + rest;
  }

  TemporaryFolder folder_;
  std::filesystem::path file_;
};

TEST_F(DocumentTest, FileThatIsNotThere) {
  const auto file = folder_.path("none.toml");
  EXPECT_THAT([&] { Document::read(file); }, ThrowsMessage<InputError>(file.string() + ": there is no such file"));
  EXPECT_THROW(Document::read(folder_.path("")), InputError);
}

TEST_F(DocumentTest, WhatIsNoPlainFileIsToldAsWhatItIs) {
  const auto loop = folder_.path("loop.toml");
  std::filesystem::create_symlink(loop, loop);
  EXPECT_THAT([&] { Document::read(folder_.path("")); }, ThrowsMessage<InputError>(HasSubstr("it is a directory")));
  EXPECT_THAT([&] { Document::read("/dev/null"); }, ThrowsMessage<InputError>(HasSubstr("not a plain file")));
  EXPECT_THAT([&] { Document::read(loop); }, ThrowsMessage<InputError>(HasSubstr("loop.toml: cannot be read: ")));
}

TEST_F(DocumentTest, SyntaxErrorNamesItsLine) {
  EXPECT_THAT([&] { read("a = 1\nb = = 2\n"); }, ThrowsMessage<InputError>(HasSubstr("file.toml:2: not valid TOML: ")));
}

TEST_F(DocumentTest, UnknownKeyNamesTheNearest) {
  Table root = read("\n[tray.holes]\ncount = 3\nwidht = 1\n");
  Table holes = *root.table("tray")->table("holes");
  holes.whole_number("count", 1, 9);
  holes.number("width", 0, 1);
  EXPECT_THAT([&] { root.reject_unknown_keys(); },
              ThrowsMessage<InputError>(at(4, "tray.holes.widht: unknown key; did you mean \"width\"?")));
}

TEST_F(DocumentTest, MissingKeyThatIsMisspelledIsCalledUnknown) {
  Table root = read("[run]\ndurration = \"3 s\"\n");
  EXPECT_THAT([&] { root.table("run")->required_quantity("duration", Dimension::time, 0, 9); },
              ThrowsMessage<InputError>(at(2, "run.durration: unknown key; did you mean \"duration\"?")));
}

TEST_F(DocumentTest, MissingKeyNamesItsTable) {
  Table root = read("a = 1\n[run]\nb = 2\n");
  EXPECT_THAT([&] { root.table("run")->required_text("duration"); },
              ThrowsMessage<InputError>(at(2, "run.duration: is missing")));
  EXPECT_THAT([&] { root.required_table("tray"); },
              ThrowsMessage<InputError>(file_.string() + ": tray: this table is missing"));
}

TEST_F(DocumentTest, RefusesOtherTypes) {
  Table root = read("text = 1\nyes = \"true\"\nwhole = 1.5\nplain = \"1 mm\"\nsize = 1.1\ntable = 3\nlist = []\n");
  EXPECT_THAT([&] { root.text("text"); }, ThrowsMessage<InputError>(at(1, "text: must be a text in quotes, not 1")));
  EXPECT_THAT([&] { root.boolean("yes"); }, ThrowsMessage<InputError>(HasSubstr("yes: must be true or false")));
  EXPECT_THAT([&] { root.whole_number("whole", 1, 9); },
              ThrowsMessage<InputError>(at(3, "whole: must be a whole number from 1 to 9, not 1.5")));
  EXPECT_THAT([&] { root.number("plain", 0, 1); },
              ThrowsMessage<InputError>(HasSubstr("plain: must be a number from 0 to 1, without a unit, not ")));
  EXPECT_THAT([&] { root.quantity("size", Dimension::length, 0, 1); },
              ThrowsMessage<InputError>(HasSubstr("size: must be a quantity with its unit in quotes, a length such as "
                                                  "\"8 mm\", not 1.1")));
  EXPECT_THAT([&] { root.table("table"); }, ThrowsMessage<InputError>(at(6, "table: must be a table, not 3")));
  EXPECT_THAT([&] { root.quantities("list", Dimension::length, 0, 1); },
              ThrowsMessage<InputError>(at(7, "list: the list is empty")));
}

TEST_F(DocumentTest, RangesIncludeTheirEnds) {
  Table root = read("a = \"30 degree\"\nb = \"0 mm\"\nc = 0.5\nd = nan\ne = inf\nf = \"9000 rpm\"\n");
  const double limit = 30 * 3.14159265358979323846 / 180;
  EXPECT_NEAR(*root.quantity("a", Dimension::angle, -limit, limit), limit, 1e-15);
  EXPECT_THAT([&] { root.quantity("b", Dimension::length, 1e-6, 100); },
              ThrowsMessage<InputError>(at(2, "b: \"0 mm\" is out of range, which is from 0.001 mm to 100 m")));
  EXPECT_THAT([&] { root.quantity("f", Dimension::frequency, 0.01, 100); },
              ThrowsMessage<InputError>(HasSubstr("\"9000 rpm\" is out of range, which is from 0.6 rpm to 6000 rpm")));
  EXPECT_EQ(root.number("c", 0.5, 0.5), 0.5);
  EXPECT_THROW(root.number("d", 0, 1), InputError);
  EXPECT_THROW(root.number("e", 0, 1e308), InputError);
}

TEST_F(DocumentTest, ChoiceNamesTheNearest) {
  Table root = read("packing = \"pourd\"\n");
  EXPECT_THAT(
      [&] {
        root.choice("packing", {"poured", "layers"});
      },
      ThrowsMessage<InputError>(at(1, "packing: \"pourd\" is not one of poured, layers; did you mean \"poured\"?")));
}

TEST_F(DocumentTest, OverridesReplaceAddAndRememberTheirOrigin) {
  Table root = read("[tray]\nlength = \"1 m\"\n", {parse_override("tray.length=2 m"), parse_override("hopper.left=3"),
                                                   parse_override("tray.fill = { count = 0 }")});
  EXPECT_EQ(root.table("tray")->quantity("length", Dimension::length, 0, 9), 2);
  EXPECT_EQ(root.table("tray")->where("length"), "--set tray.length=2 m: tray.length");
  EXPECT_EQ(root.table("hopper")->where("left"), "--set hopper.left=3: hopper.left");
  EXPECT_EQ(root.table("hopper")->where("height"), "--set hopper.left=3: hopper.height");
  EXPECT_THAT([&] { root.table("tray")->table("fill")->whole_number("count", 1, 9); },
              ThrowsMessage<InputError>(HasSubstr("--set tray.fill = { count = 0 }: tray.fill.count: must be")));
}

TEST_F(DocumentTest, ImpossibleOverrides) {
  const std::string text = "[tray]\nlength = \"1 m\"\n";
  EXPECT_THAT([&] { read(text, {parse_override("tray.length.x=2")}); },
              ThrowsMessage<InputError>(HasSubstr("tray.length is a value, not a table")));
  EXPECT_THAT(
      [&] { read(text, {parse_override("tray..length=3")}); },
      ThrowsMessage<InputError>(HasSubstr("tray..length: not one key and one value: a part of the key is empty")));
  EXPECT_THROW(read(text, {parse_override("tray.=3")}), InputError);
  EXPECT_THROW(read(text, {parse_override(".tray=3")}), InputError);
  EXPECT_THROW(parse_override("tray.length"), InputError);
  EXPECT_THROW(parse_override("=3"), InputError);
}

TEST_F(DocumentTest, OverrideValueIsTomlWhereItCanBe) {
  EXPECT_EQ(*parse_override("a.b = 5").value->get<std::int64_t>(), 5);
  EXPECT_EQ(parse_override("a.b = 5").key, "a.b");
  Table root = read("", {parse_override("a=12 Hz"), parse_override("b=\"12 Hz\""), parse_override("c=[1, 2]"),
                         parse_override("d=true"), parse_override("e=it's \"x\""), parse_override("f=3\ng = 4")});
  EXPECT_EQ(root.text("a"), "12 Hz");
  EXPECT_EQ(root.text("b"), "12 Hz");
  EXPECT_EQ(root.values_of("c").size(), 2U);
  EXPECT_EQ(root.boolean("d"), true);
  EXPECT_EQ(root.text("e"), "it's \"x\"");
  EXPECT_EQ(root.text("f"), "3\ng = 4");
}

TEST_F(DocumentTest, FallbackStandsInAndKeepsItsOwnPlace) {
  const auto preset_file =
      folder_.write("preset.toml", "\ndiameter = \"9 g\"\nmass = \"2 g\"\n[wall]\nfriction = 0.3\ntypo = 1\n");
  Table root = read("mass = \"1 g\"\n");
  root.set_fallback(Table(Document::read(preset_file)));
  EXPECT_EQ(root.quantity("mass", Dimension::mass, 0, 1), 0.001);
  EXPECT_TRUE(root.has("diameter"));
  EXPECT_FALSE(root.has_here("diameter"));
  EXPECT_THAT([&] { root.quantity("diameter", Dimension::length, 0, 1); },
              ThrowsMessage<InputError>(HasSubstr("preset.toml:2: diameter: \"9 g\"")));
  EXPECT_EQ(root.table("wall")->number("friction", 0, 1), 0.3);
  EXPECT_THAT([&] { root.reject_unknown_keys(); }, ThrowsMessage<InputError>(HasSubstr("preset.toml:6: wall.typo: ")));
}

TEST_F(DocumentTest, KeysOfAStudyInOrderOfTheFile) {
  Table root = read(
      "[vary]\ntray.holes.count = [1, 3]\ntray.motion.frequency = { from = \"7 Hz\", to = \"9 Hz\" }\n"
      "tray.holes.span = [\"30 cm\"]\ncontact.friction = 0.1\n");
  Table vary = *root.table("vary");
  std::vector<std::string> keys, values;
  for (const Override& one : vary.dotted_values()) {
    keys.push_back(one.key);
    values.push_back(toml_text(*one.value));
  }
  EXPECT_THAT(keys, ElementsAre("tray.holes.count", "tray.motion.frequency", "tray.holes.span", "contact.friction"));
  EXPECT_THAT(values, ElementsAre("[ 1, 3 ]", "{ from = \"7 Hz\", to = \"9 Hz\" }", "[ \"30 cm\" ]", "0.1"));
  EXPECT_EQ(vary.dotted_values()[2].where, file_.string() + ":4");
  EXPECT_EQ(vary.origin("tray.holes.span"), file_.string() + ":4");
  EXPECT_NO_THROW(root.reject_unknown_keys());
}

TEST_F(DocumentTest, DottedKeyInQuotesIsTheSameKey) {
  Table root = read("[set]\n\"tray.length\" = \"2 m\"\n");
  const std::vector<Override> values = root.table("set")->dotted_values();
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(values[0].key, "tray.length");
  EXPECT_EQ(values[0].where, file_.string() + ":2");
}

TEST_F(DocumentTest, TypedQuantityIsReadLikeItsText) {
  const TomlValue typed{Quantity{12.5, "mm"}};
  Table root = read("b = \"12.5 mm\"\n", {{"a", typed, "here"}, {"c", TomlValue{Quantity{3, "Hz"}}, "here"}});
  EXPECT_EQ(root.quantity("a", Dimension::length, 0, 1), root.quantity("b", Dimension::length, 0, 1));
  EXPECT_THAT([&] { root.quantity("c", Dimension::length, 0, 1); }, ThrowsMessage<InputError>(HasSubstr("here: c: ")));
  EXPECT_THAT([&] { root.quantity("a", Dimension::length, 0, 0.001); },
              ThrowsMessage<InputError>(HasSubstr("\"12.5 mm\" is out of range")));
}

TEST_F(DocumentTest, KeysAreTakenOut) {
  const std::string text = "[tray]\nlength = \"1 m\"\n[tray.holes]\ncount = 3\n";
  Table root = read(text, {parse_override("tray.holes.count="), parse_override("tray.length=")});
  EXPECT_FALSE(root.table("tray")->has("length"));
  EXPECT_TRUE(root.table("tray")->has("holes"));
  EXPECT_FALSE(root.table("tray")->table("holes")->has("count"));
  EXPECT_FALSE(read(text, {parse_override("tray=")}).has("tray"));
  EXPECT_TRUE(read(text, {parse_override("tray="), parse_override("tray.length=2 m")}).has("tray"));
  EXPECT_THAT(
      [&] { read(text, {parse_override("tray.lenght=")}); },
      ThrowsMessage<InputError>(HasSubstr("--set tray.lenght=: tray.lenght: cannot be taken out: tray.lenght is "
                                          "not written; did you mean \"length\"?")));
  EXPECT_THROW(read(text, {parse_override("tray.length.x=")}), InputError);
}

TEST_F(DocumentTest, AFileIsReadOnceForAnyNumberOfDocuments) {
  const auto file = folder_.write("file.toml", "a = 1\n");
  const auto files = std::make_shared<SourceFiles>();
  for (int k = 0; k < 5; ++k) {
    Table root(Document::read(file, {{"b", TomlValue{std::int64_t{k}}, "here"}}, files));
    EXPECT_EQ(root.whole_number("a", 0, 9), 1);
    EXPECT_EQ(root.whole_number("b", 0, 9), k);
  }
  EXPECT_EQ(files->reads(), 1);
  EXPECT_FALSE(Table(Document::read(file, {}, files)).has("b"));
}

TEST_F(DocumentTest, WithinTheLimitsOfLengthAndDepth) {
  const auto repeated = [](const std::string& part, int times) {
    std::string text;
    for (int k = 0; k < times; ++k) text += part;
    return text;
  };
  EXPECT_NO_THROW(read(repeated("a.", 31) + "a = 1\n[" + repeated("b.", 31) + "b]\n"));
  EXPECT_NO_THROW(read("x = " + repeated("[", 30) + repeated("]", 30) + "\n"));
  EXPECT_NO_THROW(read("x = [" + repeated("1.5, ", 10000) + "2.5]\n# " + repeated("a.", 100) + "\ny = '" +
                       repeated("a.", 100) + "'\nz = \"\"\"" + repeated("[{a.\\\"", 100) + "\"\"\"\n"));
  const auto refused = [&](const std::string& text, const std::string& message) {
    EXPECT_THAT([&] { read(text); }, ThrowsMessage<InputError>(HasSubstr("file.toml:2: not valid TOML: " + message)));
  };
  for (const int times : {32, 40000}) {
    refused("\n" + repeated("a.", times) + "a = 1\n", "a key has more than 32 parts");
    refused("\n[" + repeated("a.", times) + "a]\n", "a key has more than 32 parts");
    refused("\nx = {" + repeated("a.", times) + "a = 1}\n", "a key has more than 32 parts");
    refused("\nx = " + repeated("[", times + 1) + "\n", "lists or tables lie more than 32 deep");
  }
  refused("\n" + std::string(201, 'a') + " = 1\n", "the key aaa");
  EXPECT_THAT([&] { read("", {parse_override(repeated("a.", 40000) + "a=1")}); },
              ThrowsMessage<InputError>(HasSubstr("a key has more than 32 parts")));
  EXPECT_THAT([&] { read("x = " + repeated("y", 100)); }, ThrowsMessage<InputError>(testing::Not(HasSubstr("limit"))));
  EXPECT_LT(parse_override("x=" + std::string(100000, 'y')).where.size(), 200U);
}

TEST_F(DocumentTest, AMissingQuoteIsSaidToBeOne) {
  const auto told = [&](const std::string& line, const std::string& message) {
    EXPECT_THAT([&] { read("\n" + line + "\n"); },
                ThrowsMessage<InputError>(HasSubstr("file.toml:2: not valid TOML: " + message)));
  };
  told("diameter = 4 mm", "a quantity with its unit is written in quotes: \"4 mm\"");
  told("diameter = 4mm  # wide", "a quantity with its unit is written in quotes: \"4mm\"");
  told("fraction = 70 %", "a quantity with its unit is written in quotes: \"70 %\"");
  told("diameter = 4 mm\"", "a quantity with its unit is written in quotes: \"4 mm\"");
  told("at = [\"1 cm\", 2 cm]", "a quantity with its unit is written in quotes: \"2 cm\"");
  told("motion = { amplitude = 1 cm, frequency = \"9 Hz\" }",
       "a quantity with its unit is written in quotes: \"1 cm\"");
  told("crop = wheat", "a text is written in quotes: \"wheat\"");
  told("diameter = \"4 mm", "the quote before \"4 mm\" is not closed");
  for (const std::string line : {"b = = 2", "[tray", "keep = True", "x = [1, 2"})
    EXPECT_THAT([&] { read("\n" + line + "\n"); }, ThrowsMessage<InputError>(testing::Not(HasSubstr("quote")))) << line;
}

TEST_F(DocumentTest, AStringThatTheFileCutsOff) {
  for (const std::string end : {R"(")", R"("a\)", R"("""a\)", "\"\"\"a\n\\", "'", R"('''a\)", R"("""")", "\"a\\\n"})
    EXPECT_THAT([&] { read("x = " + end); }, ThrowsMessage<InputError>(HasSubstr("not valid TOML"))) << end;
}

TEST_F(DocumentTest, AListOfTablesInPlaceOfATable) {
  Table root = read("\n[[tray]]\nlength = \"1 m\"\n");
  EXPECT_THAT(
      [&] { root.table("tray"); },
      ThrowsMessage<InputError>(at(2, "tray: is a list of tables; there is one tray, so write [tray], not [[tray]]")));
}

TEST_F(DocumentTest, WhatAFileHoldsIsNotEchoedToTheTerminal) {
  Table root = read("\"\\u001b[5m\" = 1\ntext = \"a\\u0007\\u009bb\\u00e9\"\n");
  root.skip("text");
  EXPECT_THAT([&] { root.reject_unknown_keys(); },
              ThrowsMessage<InputError>(at(1, "\\x1b[5m: unknown key; known here are text")));
  EXPECT_THAT([&] { root.choice("text", {"c"}); }, ThrowsMessage<InputError>(HasSubstr("\"a\\x07\\xc2\\x9bb\u00e9\"")));
}

TEST_F(DocumentTest, ArrayOfTables) {
  Table root = read("[[layout]]\nname = \"a\"\n[[layout]]\nname = \"b\"\nodd = 1\n");
  std::vector<Table> layouts = root.tables("layout");
  ASSERT_EQ(layouts.size(), 2U);
  EXPECT_EQ(layouts[0].text("name"), "a");
  EXPECT_EQ(layouts[1].text("name"), "b");
  EXPECT_THAT([&] { root.reject_unknown_keys(); },
              ThrowsMessage<InputError>(at(5, "layout[2].odd: unknown key; known here are name")));
}

TEST_F(DocumentTest, WhereOfAnyKey) {
  Table root = read("[a]\nb = 1\n[a.c]\nd = 2\n");
  EXPECT_EQ(root.table("a")->where("b"), at(2, "a.b"));
  EXPECT_EQ(root.table("a")->table("c")->where("d"), at(4, "a.c.d"));
  EXPECT_EQ(root.where("a.c.d"), at(4, "a.c.d"));
  EXPECT_EQ(root.where("a.c.none"), at(3, "a.c.none"));
  EXPECT_EQ(root.where("none"), file_.string() + ": none");
}

TEST(Nearest, IsAnEditAwayOrNothing) {
  EXPECT_EQ(nearest("widht", {"count", "width", "span"}), "width");
  EXPECT_EQ(nearest("frequenzy", {"frequency", "direction"}), "frequency");
  EXPECT_EQ(nearest("colour", {"count", "width", "span"}), std::nullopt);
  EXPECT_EQ(nearest("freq", {"direction", "frequency"}), "frequency");
  EXPECT_EQ(nearest("floor_angle", {"length", "funnel"}), std::nullopt);
  EXPECT_EQ(nearest("x", {}), std::nullopt);
}

}  // namespace
}  // namespace vibrosow
