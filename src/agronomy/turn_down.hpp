#pragma once

#include <optional>
#include <vector>

namespace vibrosow {

/// What a tray does at one setting of its drive.
struct Setting {
  double value = 0;                  // of what is set, in SI
  double rate = 0;                   // kg/s, mean over the runs
  bool flowed = true;                // every run to its end, and without a serious doubt
  double cv_low = 0;                 // fraction; 95 % interval of the CV between rows; of a single row 0
  std::optional<double> cv_high{0};  // none: not known
};

/// How sure a setting must be to sow evenly enough.
enum class Proof {
  shown,         // the CV's whole interval is within the limit
  not_excluded,  // a part of it is
};

/// How far a tray is turned down by its drive.
struct TurnDown {
  double ratio;                  // largest over smallest rate
  double from, to;               // values of the settings between which it sows, in SI
  double least_rate, most_rate;  // kg/s
  int settings;                  // that were tried there
};

/// The largest ratio of rates among settings that follow each other without one between them at which the tray clogs,
/// gives nothing or sows too unevenly (`cv_limit`, a fraction); of ranges of one ratio the last. None where no setting
/// will do. Ours: the trade quotes turn-down as largest over smallest sowing rate and states no limit with it.
std::optional<TurnDown> turn_down(std::vector<Setting> settings, double cv_limit, Proof proof);

/// A tray's rate at a tilt.
struct TiltedRate {
  double tilt;                       // rad
  double rate;                       // kg/s, mean over the runs
  std::optional<double> half_width;  // kg/s, of its 95 % interval
};

/// How a rate changes with the slope of the ground.
struct SlopeSensitivity {
  double change;                     // 1/rad, of the rate on level ground
  std::optional<double> half_width;  // 1/rad, at 95 %, from the rates' own alone; none where one is unknown
  std::optional<double> off_line;    // largest distance of a rate from the line, of the rate on level ground; none of
                                     // two rates, through which a line goes
};

/// Least squares: rate = level (1 + change tilt). Half widths are taken as independent and add in squares. None for
/// fewer than two different tilts, or where the line gives nothing on level ground.
std::optional<SlopeSensitivity> slope_sensitivity(const std::vector<TiltedRate>& rates);

}  // namespace vibrosow
