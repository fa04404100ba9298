#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "support/report_file.hpp"

namespace vibrosow {

/// The table that a test has made is the one of reports/verification; below $VIBROSOW_REPORTS it is written instead.
inline void expect_committed(const std::string& file, const std::string& table) {
  if (std::getenv("VIBROSOW_REPORTS")) return write_report(file, table);
  std::ifstream committed(std::filesystem::path(VIBROSOW_SOURCE_DIR) / "reports/verification" / file);
  const std::string text{std::istreambuf_iterator<char>(committed), {}};
  EXPECT_EQ(table, text) << "reports/verification/" << file << "; scripts/make-reports verification makes it again";
}

}  // namespace vibrosow
