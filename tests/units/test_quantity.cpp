#include "units/quantity.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>

#include <numbers>
#include <ostream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Quantity, DecimalUnitsAreExact) {
  EXPECT_EQ(parse_quantity("8 mm", Dimension::length), 0.008);
  EXPECT_EQ(parse_quantity("6 cm", Dimension::length), 0.06);
  EXPECT_EQ(parse_quantity("3.57 mm", Dimension::length), 0.00357);
  EXPECT_EQ(parse_quantity("250 µm", Dimension::length), 0.00025);
  EXPECT_EQ(parse_quantity("1.5 m", Dimension::length), 1.5);
  EXPECT_EQ(parse_quantity("0.6 g", Dimension::mass), 0.0006);
  EXPECT_EQ(parse_quantity("103.57 mg", Dimension::mass), 0.00010357);
  EXPECT_EQ(parse_quantity("70 %", Dimension::fraction), 0.7);
  EXPECT_EQ(parse_quantity("9 Hz", Dimension::frequency), 9);
  EXPECT_EQ(parse_quantity("1.2 kHz", Dimension::frequency), 1200);
  EXPECT_EQ(parse_quantity("2e-5 s", Dimension::time), 2e-5);
  EXPECT_EQ(parse_quantity("5 ms", Dimension::time), 0.005);
  EXPECT_EQ(parse_quantity("3 g/s", Dimension::mass_rate), 0.003);
  EXPECT_EQ(parse_quantity("20 mm/s", Dimension::speed), 0.02);
  EXPECT_EQ(parse_quantity("1592 kg/m3", Dimension::density), 1592);
  EXPECT_EQ(parse_quantity("1592 kg/m^3", Dimension::density), 1592);
  EXPECT_EQ(parse_quantity("1.592 g/cm3", Dimension::density), 1592);
  EXPECT_EQ(parse_quantity("0.2 mN", Dimension::force), 0.0002);
  EXPECT_EQ(parse_quantity("5e4 MPa", Dimension::pressure), 5e10);
  EXPECT_EQ(parse_quantity("210 GPa", Dimension::pressure), 210e9);
  EXPECT_EQ(parse_quantity("3 N/mm2", Dimension::pressure), 3e6);
  EXPECT_EQ(parse_quantity("2.1e4 1/s", Dimension::rate), 2.1e4);
  EXPECT_EQ(parse_quantity("21 1/ms", Dimension::rate), 21000);
  EXPECT_EQ(parse_quantity("180 kg/ha", Dimension::mass_per_area), 0.018);
  EXPECT_EQ(parse_quantity("280 1/m2", Dimension::seeds_per_area), 280);
}

TEST(Quantity, OtherUnits) {
  EXPECT_DOUBLE_EQ(parse_quantity("36 km/h", Dimension::travel_speed), 10);
  EXPECT_EQ(parse_quantity("2 min", Dimension::time), 120);
  EXPECT_DOUBLE_EQ(parse_quantity("18 g/m2", Dimension::mass_per_area), 0.018);
  EXPECT_DOUBLE_EQ(parse_quantity("2.8e6 1/ha", Dimension::seeds_per_area), 280);
  EXPECT_DOUBLE_EQ(parse_quantity("90 degree", Dimension::angle), std::numbers::pi / 2);
  EXPECT_EQ(parse_quantity("90 deg", Dimension::angle), parse_quantity("90 degree", Dimension::angle));
  EXPECT_EQ(parse_quantity("1.5 rad", Dimension::angle), 1.5);
  EXPECT_EQ(parse_quantity("-3 mm", Dimension::length), -0.003);
  EXPECT_EQ(parse_quantity("+3mm", Dimension::length), 0.003);
}

TEST(Quantity, RpmIsTurnsAMinuteNotRadians) {
  EXPECT_EQ(parse_quantity("540 rpm", Dimension::frequency), 9);
  EXPECT_EQ(unit_size("rpm", Dimension::frequency), 1.0 / 60);
}

TEST(Quantity, TradesHaveTheirOwn) {
  constexpr double mile = 1609.344, pound = 0.45359237, acre = 4046.8564224, bushel = 0.03523907016688;
  EXPECT_DOUBLE_EQ(parse_quantity("5 mph", Dimension::travel_speed), 5 * mile / 3600);
  EXPECT_EQ(parse_quantity("8 kmh", Dimension::travel_speed), parse_quantity("8 km/h", Dimension::travel_speed));
  EXPECT_NEAR(parse_quantity("160 lb/ac", Dimension::mass_per_area), 160 * pound / acre, 1e-12);
  EXPECT_NEAR(parse_quantity("160 lbs/acre", Dimension::mass_per_area), 160 * pound / acre, 1e-12);
  EXPECT_EQ(parse_quantity("0.18 t/ha", Dimension::mass_per_area), 0.018);
  EXPECT_EQ(parse_quantity("350 seeds/m2", Dimension::seeds_per_area), 350);
  EXPECT_EQ(parse_quantity("350 1/m²", Dimension::seeds_per_area), 350);
  EXPECT_DOUBLE_EQ(parse_quantity("1.4e6 seeds/ac", Dimension::seeds_per_area), 1.4e6 / acre);
  EXPECT_EQ(parse_quantity("280 plants/m²", Dimension::plants_per_area), 280);
  EXPECT_DOUBLE_EQ(parse_quantity("7.5\"", Dimension::length), 7.5 * 0.0254);
  EXPECT_DOUBLE_EQ(parse_quantity("7.5 in", Dimension::length), 7.5 * 0.0254);
  EXPECT_EQ(parse_quantity("76 kg/hl", Dimension::bulk_density), 760);
  EXPECT_DOUBLE_EQ(parse_quantity("60 lb/bu", Dimension::bulk_density), 60 * pound / bushel);
  EXPECT_EQ(parse_quantity("43 seeds/min", Dimension::seed_rate), 43.0 / 60);
}

TEST(Quantity, SignsOfOtherKeyboardsAreReadAsWhatTheyStandFor) {
  EXPECT_EQ(parse_quantity("250 μm", Dimension::length), 0.00025);                   // Greek mu
  EXPECT_EQ(parse_quantity("8\u00a0mm", Dimension::length), 0.008);                  // a space that does not break
  EXPECT_EQ(parse_quantity("8\u202fmm ", Dimension::length), 0.008);                 // a narrow one
  EXPECT_EQ(parse_quantity("\u22123 mm", Dimension::length), -0.003);                // a minus
  EXPECT_DOUBLE_EQ(parse_quantity("90 º", Dimension::angle), std::numbers::pi / 2);  // masculine ordinal
  for (const char* density : {"1592 kg/m³", "1592 kg / m3", "1592 kg·m⁻³", "1592 kg m-3", "1.592 g/cm³", "1.592 kg/L"})
    EXPECT_EQ(parse_quantity(density, Dimension::density), 1592) << density;
}

TEST(Quantity, WhatWasMeantIsSaid) {
  const auto told = [](const char* text, Dimension dimension, std::string_view example = {}) {
    try {
      parse_quantity(text, dimension, example);
    } catch (const UnitError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(
      told("30 gr", Dimension::seed_mass, "45 g"),
      "\"30 gr\": wrong unit \"gr\": is the grain of the imperial system, 64.8 mg; a gram is g; expected a mass in g "
      "or mg such as \"45 g\"");
  for (const char* text : {"76 kg/hl", "76 kg/hL", "60 lb/bu", "760 g/l"})
    EXPECT_THAT(told(text, Dimension::density), testing::AllOf(HasSubstr("bulk_density"), HasSubstr("1300 kg/m3")));
  EXPECT_THAT(told("20", Dimension::travel_speed), HasSubstr("\"8 km/h\""));
  EXPECT_THAT(told("9 hz", Dimension::frequency), HasSubstr("capitals count; write Hz"));
  EXPECT_THAT(told("5 mPa", Dimension::pressure), HasSubstr("a million is MPa"));
  EXPECT_THAT(told("3 bu/ac", Dimension::mass_per_area), HasSubstr("write lb/ac"));
  EXPECT_THAT(told("0,2 g", Dimension::seed_mass), HasSubstr("decimal comma"));
}

TEST(Quantity, UnitSize) {
  EXPECT_EQ(unit_size("mm", Dimension::length), 0.001);
  EXPECT_EQ(unit_size("Hz", Dimension::frequency), 1);
  EXPECT_EQ(unit_size("%", Dimension::fraction), 0.01);
  EXPECT_THROW(unit_size("s", Dimension::length), UnitError);
  EXPECT_THROW(unit_size("", Dimension::length), UnitError);
}

struct Wrong {
  const char* text;
  Dimension dimension;
  const char* message;
};

void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << '"' << wrong.text << "\" for " << si_unit(wrong.dimension);
}

class RefusedQuantity : public testing::TestWithParam<Wrong> {};

TEST_P(RefusedQuantity, NamesTheTextAndWhatIsExpected) {
  const char* const text = GetParam().text;
  const Dimension dimension = GetParam().dimension;
  const char* const message = GetParam().message;
  EXPECT_THAT([&] { parse_quantity(text, dimension); },
              ThrowsMessage<UnitError>(testing::AllOf(HasSubstr(message), HasSubstr(std::string("\"") + text + "\""),
                                                      HasSubstr(std::string(expected(dimension))))));
}

constexpr const char* no_number = "does not start with a number";
constexpr const char* no_unit = "has no unit";
constexpr const char* wrong_unit = "wrong unit";

INSTANTIATE_TEST_SUITE_P(
    UdunitsTraps, RefusedQuantity,
    testing::Values(Wrong{"8-10 mm", Dimension::length, wrong_unit},  // -0.08 m to udunits2
                    Wrong{"24 mm 3", Dimension::length, wrong_unit},  // 72 mm
                    Wrong{"1 d", Dimension::length, wrong_unit},      // a day
                    Wrong{"1 d", Dimension::time, wrong_unit}, Wrong{"mm", Dimension::length, no_number},  // 1 mm
                    Wrong{"56 rad/s", Dimension::frequency, wrong_unit},                                   // 56 Hz
                    Wrong{"3 1/s", Dimension::frequency, wrong_unit},
                    Wrong{"5 Hz", Dimension::time, wrong_unit},  // its reciprocal counts as convertible
                    Wrong{"5 s", Dimension::frequency, wrong_unit}, Wrong{"2 s/m", Dimension::speed, wrong_unit},
                    Wrong{"1 rad", Dimension::fraction, wrong_unit}, Wrong{"10 %", Dimension::angle, wrong_unit},
                    Wrong{"3 m-1", Dimension::length, wrong_unit}, Wrong{"3 mm @ 2", Dimension::length, wrong_unit},
                    Wrong{"3 s since 1970-01-01", Dimension::time, wrong_unit},
                    Wrong{"3 m m-1 m", Dimension::length, wrong_unit}, Wrong{"3 2mm", Dimension::length, wrong_unit},
                    Wrong{"3 (mm)", Dimension::length, wrong_unit}));

INSTANTIATE_TEST_SUITE_P(
    Numbers, RefusedQuantity,
    testing::Values(Wrong{"9", Dimension::frequency, no_unit}, Wrong{"9 ", Dimension::frequency, no_unit},
                    Wrong{"", Dimension::length, no_number}, Wrong{"nan mm", Dimension::length, no_number},
                    Wrong{"inf mm", Dimension::length, no_number}, Wrong{"-inf mm", Dimension::length, no_number},
                    Wrong{"1e400 mm", Dimension::length, "too large or too small"},
                    Wrong{"1e-400 mm", Dimension::length, "too large or too small"},
                    Wrong{"1e308 kN", Dimension::force, "too large"}, Wrong{".5 mm", Dimension::length, no_number},
                    Wrong{" 5 mm", Dimension::length, no_number}, Wrong{"5. mm", Dimension::length, wrong_unit},
                    Wrong{"05 mm", Dimension::length, wrong_unit}, Wrong{"0x10 mm", Dimension::length, wrong_unit},
                    Wrong{"1,5 mm", Dimension::length, "write a decimal point: \"1.5 mm\""},
                    Wrong{"0,500 mm", Dimension::length, "write a decimal point: \"0.500 mm\""},
                    Wrong{"1,2000 mm", Dimension::length, "write a decimal point: \"1.2000 mm\""},
                    Wrong{"1.200,5 mm", Dimension::length, "write a decimal point: \"1200.5 mm\""},
                    Wrong{"1,200 kg/ha", Dimension::mass_per_area, "write \"1200 kg/ha\" or \"1.200 kg/ha\""},
                    Wrong{"-1,200 mm", Dimension::length, "write \"-1200 mm\" or \"-1.200 mm\""},
                    Wrong{"1,500.5 mm", Dimension::length, "parts thousands; write \"1500.5 mm\""},
                    Wrong{"1,200,000 mm", Dimension::length, "parts thousands; write \"1200000 mm\""},
                    Wrong{"1'200 mm", Dimension::length, "parts thousands; write \"1200 mm\""},
                    Wrong{"1000,200 mm", Dimension::length, "write a decimal point: \"1000.200 mm\""},
                    Wrong{"1, 5 mm", Dimension::length, wrong_unit}, Wrong{"1_000 mm", Dimension::length, wrong_unit},
                    Wrong{"1 000 mm", Dimension::length, "parts thousands; write \"1000 mm\""}));

INSTANTIATE_TEST_SUITE_P(
    Dimensions, RefusedQuantity,
    testing::Values(Wrong{"8 kg", Dimension::length, wrong_unit}, Wrong{"8 mm", Dimension::mass, wrong_unit},
                    Wrong{"20 degC", Dimension::length, wrong_unit}, Wrong{"20 K", Dimension::time, wrong_unit},
                    Wrong{"3 kg", Dimension::mass_rate, wrong_unit}, Wrong{"3 mm2", Dimension::length, wrong_unit},
                    Wrong{"3 g", Dimension::density, wrong_unit}, Wrong{"3 furlongz", Dimension::length, wrong_unit},
                    Wrong{"3 g", Dimension::force, wrong_unit}, Wrong{"3 N", Dimension::pressure, wrong_unit},
                    Wrong{"3 Pa", Dimension::force, wrong_unit}, Wrong{"3 mpa", Dimension::pressure, wrong_unit},
                    Wrong{"3 Hz", Dimension::rate, wrong_unit},  // turns, not radians
                    Wrong{"3 rpm", Dimension::rate, wrong_unit}, Wrong{"3 rad/s", Dimension::rate, wrong_unit},
                    Wrong{"3 s", Dimension::rate, wrong_unit}, Wrong{"3 1/m", Dimension::rate, wrong_unit},
                    Wrong{"3 1/s", Dimension::length, wrong_unit}, Wrong{"3 1/s2", Dimension::rate, wrong_unit},
                    Wrong{"3 /s", Dimension::rate, wrong_unit}, Wrong{"1/s", Dimension::rate, wrong_unit},
                    Wrong{"3 kg/m3", Dimension::mass_per_area, wrong_unit},
                    Wrong{"3 kg", Dimension::mass_per_area, wrong_unit},
                    Wrong{"3 1/m", Dimension::seeds_per_area, wrong_unit},
                    Wrong{"3 1/m2", Dimension::mass_per_area, wrong_unit},
                    Wrong{"3 kg/ha", Dimension::seeds_per_area, wrong_unit}));

TEST(Quantity, AnyLengthOfTextIsReadOrRefusedInAShortMessage) {
  constexpr std::size_t length = 200'000;
  const auto message = [](const std::string& text) {
    try {
      parse_quantity(text, Dimension::length);
    } catch (const UnitError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(parse_quantity("0." + std::string(length, '1') + " mm", Dimension::length), 1.0 / 9 / 1000);
  for (const std::string& text :
       {std::string(length, '1') + " mm", "1 " + std::string(length, 'm'), "1 m" + std::string(length, '/'),
        std::string(length, ' '), "1e" + std::string(length, '9') + " mm", "1," + std::string(length, '0')}) {
    const std::string told = message(text);
    EXPECT_THAT(told, testing::AllOf(HasSubstr("..."), HasSubstr("expected a length such as \"8 mm\"")));
    EXPECT_LT(told.size(), 300U);
  }
}

TEST(Quantity, SplitsIntoNumberAndUnit) {
  EXPECT_EQ(split_quantity("8 mm"), (Quantity{8, "mm"}));
  EXPECT_EQ(split_quantity("-1.5e3%"), (Quantity{-1500, "%"}));
  EXPECT_EQ(split_quantity("+7"), (Quantity{7, ""}));
  EXPECT_THROW(split_quantity("mm"), UnitError);
  EXPECT_EQ(in_si({12.5, "mm"}, Dimension::length), parse_quantity("12.5 mm", Dimension::length));
  EXPECT_THROW(in_si({12.5, ""}, Dimension::length), UnitError);
  EXPECT_THROW(in_si({12.5, "Hz"}, Dimension::length), UnitError);
}

TEST(Quantity, SplittingUndoesPrinting) {
  EXPECT_TRUE(rc::check("number and unit come back", [](double number) {
    RC_PRE(std::isfinite(number));
    const Quantity quantity{number, "mm"};
    RC_ASSERT(split_quantity(fmt::format("{} mm", number)) == quantity);
  }));
  EXPECT_TRUE(rc::check("any text is read or refused", [](const std::string& text) {
    try {
      RC_ASSERT(std::isfinite(parse_quantity(text, Dimension::length)));
    } catch (const UnitError&) {
    }
  }));
}

TEST(Quantity, UnitDatabaseThatIsNotThereIsToldAsSuch) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // in a program that has not yet read the database
  EXPECT_EXIT(
      {
        setenv("UDUNITS2_XML_PATH", "/no/such/udunits2.xml", 1);
        try {
          parse_quantity("8 mm", Dimension::length);
        } catch (const std::system_error& error) {
          std::fputs(error.what(), stderr);
          std::exit(2);
        }
      },
      testing::ExitedWithCode(2),
      "unit database of udunits2 cannot be read, UDUNITS2_XML_PATH = /no/such/udunits2.xml");
}

TEST(Quantity, EveryDimensionReadsItsOwnExample) {
  for (const Dimension dimension :
       {Dimension::length,       Dimension::time,          Dimension::frequency,      Dimension::mass,
        Dimension::seed_mass,    Dimension::mass_rate,     Dimension::drag,           Dimension::speed,
        Dimension::travel_speed, Dimension::angle,         Dimension::density,        Dimension::bulk_density,
        Dimension::fraction,     Dimension::force,         Dimension::pressure,       Dimension::rate,
        Dimension::seed_rate,    Dimension::mass_per_area, Dimension::seeds_per_area, Dimension::plants_per_area}) {
    for (const std::string_view unit : units_of(dimension)) EXPECT_GT(unit_size(unit, dimension), 0) << unit;
    const std::string text(expected(dimension));
    const auto open = text.find('"');
    const std::string example = text.substr(open + 1, text.rfind('"') - open - 1);
    EXPECT_GT(parse_quantity(example, dimension), 0) << example;
  }
}

TEST(Quantity, ManyThreadsReadAtOnce) {
  std::vector<std::jthread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&wrong, t] {
      for (int i = 0; i < 200; ++i) {
        if (parse_quantity("8 mm", Dimension::length) != 0.008) ++wrong[t];
        if (parse_quantity("1592 kg/m3", Dimension::density) != 1592) ++wrong[t];
      }
    });
  }
  threads.clear();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace vibrosow
