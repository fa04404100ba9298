#include "input/key_units.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace vibrosow {
namespace {

TEST(KeyUnits, ColumnsCarryOneUnitForEachKey) {
  EXPECT_EQ(condition_column("tray.motion.frequency"), "tray.motion.frequency_Hz");
  EXPECT_EQ(condition_column("tray.holes.span"), "tray.holes.span_mm");
  EXPECT_EQ(condition_column("contact.slip_speed"), "contact.slip_speed_mm_per_s");
  EXPECT_EQ(condition_column("contact.drag"), "contact.drag_g_per_s");
  EXPECT_EQ(condition_column("seeds.wheat.density"), "seeds.wheat.density_kg_per_m3");
  EXPECT_EQ(condition_column("seeds.wheat.sizes.deviation"), "seeds.wheat.sizes.deviation_mm");
  EXPECT_EQ(condition_column("seeds.wheat.mass_fraction"), "seeds.wheat.mass_fraction_percent");
  EXPECT_EQ(condition_column("tray.tilt"), "tray.tilt_degree");
  EXPECT_EQ(condition_column("run.duration"), "run.duration_s");
  EXPECT_EQ(condition_column("contact.youngs_modulus"), "contact.youngs_modulus_MPa");
  EXPECT_EQ(condition_column("contact.damping_rate"), "contact.damping_rate_per_s");
  EXPECT_EQ(condition_column("contact.pea.wall.cohesion"), "contact.pea.wall.cohesion_mN");
  EXPECT_EQ(condition_column("numerics.impact_speed"), "numerics.impact_speed_m_per_s");
  EXPECT_EQ(condition_column("record.cell"), "record.cell_mm");
  EXPECT_EQ(condition_column("record.every"), "record.every_s");
  EXPECT_EQ(condition_column("contact.wall.rolling_friction"), "contact.wall.rolling_friction");
  EXPECT_EQ(condition_column("tray.holes.count"), "tray.holes.count");
  EXPECT_EQ(condition_column("tray.holes.open_at"), "tray.holes.open_at_s");
  EXPECT_EQ(condition_column("hopper.rain.rate"), "hopper.rain.rate_per_s");
  EXPECT_EQ(condition_column("tray.rain.start"), "tray.rain.start_s");
  EXPECT_EQ(condition_column("run.start"), "run.start") << "a name";
  EXPECT_EQ(condition_column("drill.speed"), "drill.speed_km_per_h");
  EXPECT_EQ(condition_column("tray.motion.speed"), "tray.motion.speed_rpm");
  EXPECT_EQ(condition_column("contact.shell_compression"), "contact.shell_compression");
}

TEST(KeyUnits, AColumnLeadsBackToItsKey) {
  for (const std::string key : {"tray.motion.frequency",
                                "run.count_below",
                                "tray.holes.count",
                                "seeds.pea.mass",
                                "seeds.pea.thousand_grain_weight",
                                "seeds.pea.bulk_density",
                                "seeds.pea.angle_of_repose",
                                "seeds.pea.moisture",
                                "contact.damping_rate",
                                "contact.drag",
                                "contact.cohesion",
                                "seeds.pea.youngs_modulus",
                                "contact.poisson_ratio",
                                "contact.friction_model",
                                "contact.tangential_ratio",
                                "contact.tangential_damping",
                                "contact.rolling",
                                "contact.rolling_friction",
                                "contact.rolling_damping",
                                "numerics.impact_speed",
                                "record.times",
                                "record.every",
                                "record.cell",
                                "tray.rain.start",
                                "tray.rain.rate",
                                "drill.speed",
                                "drill.row_spacing",
                                "drill.cv_limit",
                                "tray.motion.angle"})
    EXPECT_EQ(key_of_column(condition_column(key)), key);
  EXPECT_FALSE(key_of_column("tray.motion.frequency"));
  EXPECT_FALSE(key_of_column("tray.motion.frequency_rpm"));
  EXPECT_FALSE(key_of_column("frequency_Hz"));
  EXPECT_FALSE(key_of_column("tray.holes.colour"));
}

TEST(KeyUnits, ValuesAreConvertedToTheColumn) {
  EXPECT_DOUBLE_EQ(to_column_unit("tray.holes.width", 0.016), 16);
  EXPECT_DOUBLE_EQ(to_column_unit("tray.tilt", std::numbers::pi / 2), 90);
  EXPECT_DOUBLE_EQ(to_column_unit("contact.drag", 3e-3), 3);
  EXPECT_DOUBLE_EQ(to_column_unit("seeds.wheat.thousand_grain_weight", 0.045), 45);
  EXPECT_DOUBLE_EQ(to_column_unit("seeds.wheat.angle_of_repose", std::numbers::pi / 6), 30);
  EXPECT_DOUBLE_EQ(to_column_unit("seeds.wheat.mass_fraction", 0.7), 70);
  EXPECT_DOUBLE_EQ(to_column_unit("contact.youngs_modulus", 5e10), 5e4);
  EXPECT_DOUBLE_EQ(to_column_unit("contact.damping_rate", 2.1e4), 2.1e4);
  EXPECT_DOUBLE_EQ(to_column_unit("contact.cohesion", 2e-4), 0.2);
  EXPECT_DOUBLE_EQ(to_column_unit("numerics.impact_speed", 1.5), 1.5);
  EXPECT_DOUBLE_EQ(to_column_unit("tray.holes.count", 5), 5);
}

TEST(KeyUnits, ValuesOfColumnsBecomeToml) {
  EXPECT_EQ(toml_text(value_of_column("tray.motion.frequency", "9", 9)), "\"9 Hz\"");
  EXPECT_EQ(toml_text(value_of_column("seeds.wheat.mass_fraction", "70", 70)), "\"70 %\"");
  EXPECT_EQ(toml_text(value_of_column("contact.damping_rate", "21000", 21000)), "\"21000 1/s\"");
  EXPECT_EQ(toml_text(value_of_column("contact.friction", "0.3", 0.3)), "0.3");
  EXPECT_EQ(toml_text(value_of_column("contact.rotation", "false", std::nullopt)), "false");
  EXPECT_EQ(toml_text(value_of_column("tray.fill.packing", "layers", std::nullopt)), "\"layers\"");
  EXPECT_EQ(toml_text(value_of_column("tray.fill.packing", "a\"b", std::nullopt)), "\"a\\\"b\"");
}

}  // namespace
}  // namespace vibrosow
