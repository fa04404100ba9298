#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "calibration/calibration_answer.hpp"

namespace vibrosow {

/// Two keys and a factor, fitted to something.
class MadeUpCalibration : public testing::Test {
 protected:
  MadeUpCalibration() {
    task_.seeder = "tray.toml";
    task_.measured.file = "table.csv";
    task_.keys = {{.key = "contact.friction", .low = 0.1, .high = 0.8},
                  {.key = "contact.restitution", .low = 0.2, .high = 0.9}};
    calibration_.values = {{.mean = 0.4, .low = 0.3, .high = 0.5, .contraction = 0.6},
                           {.mean = 0.5, .low = 0.3, .high = 0.8, .contraction = 0.3}};
    calibration_.depth_factor = FittedValue{.mean = 20, .low = 18, .high = 22, .contraction = 1};
    calibration_.posterior.points = Eigen::MatrixXd::Constant(1, 2, 0.5);
    calibration_.posterior.weights = calibration_.posterior.shifts = Eigen::VectorXd::Ones(1);
    calibration_.posterior.effective_points = 1000;
    calibration_.correlations = {{0, 1, 0.2}, {0, 2, 0.7}, {1, 2, -0.1}};
    calibration_.held_out_rms = 0.02;
  }
  CalibrationAnswer answer() const { return answer_of(task_, design_, runs_, calibration_); }

  CalibrationTask task_;
  CalibrationDesign design_;
  std::vector<ReducedRun> runs_;
  Calibration calibration_;
};

}  // namespace vibrosow
