#pragma once

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace vibrosow {

/// A study of two trays that can be built and one that cannot, told apart by the frequency.
inline Study three_trays() {
  Study study;
  study.title = "Trays </script>";
  study.keys = {"tray.motion.frequency"};
  study.scenes.resize(2);
  for (const int number : {1, 2, 3}) {
    Layout layout;
    layout.number = number;
    layout.values = {{"tray.motion.frequency", std::to_string(6 + number)}};
    if (number < 3)
      layout.scene = static_cast<std::size_t>(number - 1);
    else
      layout.invalid = "hole 3 lies beyond the rim";
    study.layouts.push_back(layout);
  }
  return study;
}

/// Of each of a page's layouts.
inline std::vector<nlohmann::json> of_layouts(const nlohmann::json& data, const std::string& key) {
  std::vector<nlohmann::json> values;
  for (const nlohmann::json& layout : data["layouts"]) values.push_back(layout[key]);
  return values;
}

}  // namespace vibrosow
