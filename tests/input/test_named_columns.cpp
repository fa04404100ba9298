#include "input/named_columns.hpp"

#include <gtest/gtest.h>

#include "input/measured.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

CsvLines named(const std::string& text, const std::vector<std::string>& names) {
  std::vector<ColumnName> columns;
  for (const std::string& name : names) columns.push_back(parse_column_name(name));
  return with_named_columns(parse_csv_lines(text, "table.csv"), columns);
}

std::string error(const std::string& text, const std::vector<std::string>& names) {
  try {
    named(text, names);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(NamedColumns, AreReadInTheirOwnUnitAndDialect) {
  const MeasuredTable table =
      read_measured(named("Datum;Frequenz [rpm];Wdh.;Menge [g/min]\n1.2.;540;1;118,2\n1.2.;540;2;121,8\n",
                          {"Datum=", "Frequenz [rpm]=tray.motion.frequency", "Wdh.=repeat", "Menge [g/min]=rate"}));
  EXPECT_EQ(table.quantity, MeasuredQuantity::mass_rate);
  ASSERT_EQ(table.series.size(), 1U);
  EXPECT_NEAR(table.series[0].values[0].mean, 0.120 / 60, 1e-12);
  EXPECT_EQ(table.series[0].repeats, std::vector<int>{2});
  EXPECT_EQ(table.series[0].conditions[0].key, "tray.motion.frequency");
  EXPECT_NEAR(*table.series[0].conditions[0].number, 9, 1e-12);
}

TEST(NamedColumns, RatesOfSeedsAndCatchesAreToldByTheirUnits) {
  EXPECT_EQ(named("Körner (1/s)\n90\n", {"Körner (1/s)=rate"}).header.fields[0], "seeds_per_s");
  const CsvLines caught = named("m [kg],t [min]\n0.2,0.5\n", {"m [kg]=caught", "t [min]=duration"});
  EXPECT_EQ(caught.header.fields, (std::vector<std::string>{"caught_g", "duration_s"}));
  EXPECT_EQ(caught.rows[0].fields, (std::vector<std::string>{"200", "30"}));
}

TEST(NamedColumns, ThatStateTheirUnitAreTakenAsTheyAre) {
  EXPECT_EQ(named("Rate\n2\n", {"Rate=rate_g_per_s"}).rows[0].fields[0], "2");
}

TEST(NamedColumns, AClockIsReadAsSecondsSinceTheFirstRow) {
  const CsvLines table = named("Datum;Uhrzeit;Gewicht [g];Stabil\n27.11.;23:59:59;0,00;S\n28.11.;00:00:00,5;18,42;S\n",
                               {"Datum=", "Uhrzeit=clock", "Gewicht [g]=gross", "Stabil="});
  EXPECT_EQ(table.header.fields, (std::vector<std::string>{"time_s", "gross_g"}));
  EXPECT_EQ(table.rows[0].fields[0], "0");
  EXPECT_EQ(table.rows[1].fields[0], "1,5");
  EXPECT_EQ(error("t;m\n12:61:00;1\n", {"t=clock"}), "table.csv:2: t: \"12:61:00\" is no time of day such as 12:30:01");
}

TEST(NamedColumns, AClockBeginsAnewWithEachRun) {
  const CsvLines table =
      named("f;t;hole;m\n9;10:00:00;1;0\n9;10:00:02;2;0\n11;11:00:00;1;0\n11;11:00:01;1;2\n9;10:00:04;1;3\n",
            {"t=clock", "f=tray.motion.frequency_Hz", "m=mass_g"});
  const std::size_t time = 1;
  std::vector<std::string> times;
  for (const CsvLines::Row& row : table.rows) times.push_back(row.fields[time]);
  EXPECT_EQ(times, (std::vector<std::string>{"0", "2", "0", "1", "4"}));
}

TEST(NamedColumns, WrongOnesAreTold) {
  EXPECT_EQ(error("Menge [g/min]\n1\n", {"Menge [g/mim]=rate"}),
            "table.csv:1: Menge [g/mim]: there is no such column; did you mean \"Menge [g/min]\"?");
  EXPECT_EQ(error("Menge\n1\n", {"Menge=time"}).substr(0, 42), "table.csv:1: Menge: states no unit; expect");
  EXPECT_EQ(error("Menge [g]\n1\n", {"Menge [g]=rate"}).substr(0, 42), "table.csv:1: Menge [g]: is in \"g\"; expecte");
  EXPECT_THROW(parse_column_name("Menge"), InputError);
  EXPECT_THROW(parse_column_name("=rate"), InputError);
}

}  // namespace
}  // namespace vibrosow
