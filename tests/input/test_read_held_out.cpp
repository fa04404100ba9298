#include "input/read_held_out.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

ModelError error_of(const std::string& text) {
  return read_model_error(parse_csv_lines(text, "rates.csv"));
}

TEST(ReadModelError, AMaterialCountsOnce) {
  const ModelError model = error_of("material,measured,predicted,report\nwood,12,10,a\npea,9,10,b\npea,16,20,b\n");
  EXPECT_EQ(model.materials, 2);
  const double wood = std::log(1.2), pea = 0.5 * (std::log(0.9) + std::log(0.8));
  EXPECT_NEAR(model.scale, std::sqrt((wood * wood + pea * pea) / 2), 1e-12);
  EXPECT_NEAR(model.mean_factor, std::exp(0.5 * (wood + pea)), 1e-12);
}

TEST(ReadModelError, NamesWhatIsWrong) {
  EXPECT_THAT([] { error_of("material,measured\nwood,12\n"); },
              ThrowsMessage<InputError>(HasSubstr("rates.csv:1: predicted: is missing")));
  EXPECT_THAT([] { error_of("material,measured,predicted\nwood,12,0\n"); },
              ThrowsMessage<InputError>(HasSubstr("rates.csv:2: predicted: \"0\" is not a number above zero")));
}

TEST(ReadModelError, TheShippedOneIsOfSeveralMaterials) {
  const ModelError model = shipped_model_error();
  EXPECT_GE(model.materials, 2);
  EXPECT_GT(model.scale, 0.02);
  EXPECT_LT(model.scale, 1);
}

}  // namespace
}  // namespace vibrosow
