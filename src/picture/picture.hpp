#pragma once

#include <string>
#include <vector>

#include "picture/colours.hpp"
#include "result/frame.hpp"
#include "scene/scene.hpp"

struct _cairo;  // NOLINT(bugprone-reserved-identifier): cairo's own name

namespace vibrosow {

/// By what grains are coloured: their lot; their speed in the lab; the sum of the normal forces of their contacts.
enum class ColourBy { lot, speed, force };

struct PictureOptions {
  int width = 1280;  // pixels
  ColourBy colour_by = ColourBy::lot;
  bool force_chains = false;  // a line a contact, the wider the larger its normal force
};

/// Draws frames of a scene as they are seen from the side, in 3D from the front, the nearest grains last: all to one
/// scale, with one range of colours. Same frames: the same bytes, with one version of cairo and of the fonts.
class Picture {
 public:
  /// Of these frames, at least one.
  Picture(const Scene& scene, const std::vector<Frame>& frames, const PictureOptions& options);

  std::string png(const Frame& frame) const;
  std::string svg(const Frame& frame) const;
  /// All frames as a film that begins anew at its end. Each is shown until the time of the next, but for a 50th of a
  /// second at least, which is the shortest that browsers keep; the last as long as the one before.
  std::string gif(const std::vector<Frame>& frames) const;

  int width() const { return options_.width; }
  int height() const { return height_; }

 private:
  /// What is to be seen of a vessel.
  struct Line {
    std::size_t vessel;
    std::vector<Eigen::Vector2d> points;  // m, in the vessel's frame
    double opens_at;                      // s, of a gate; 0: none
  };
  struct Extent {  // m, lab
    Eigen::Vector2d least, most;
  };

  void add_lines(std::size_t vessel, const Vessel& from_the_side);
  Eigen::Vector2d in_lab(const Line& line, std::size_t point, double time) const;
  Extent extent_of(const std::vector<Frame>& frames) const;
  void set_scale(const Extent& extent);
  std::vector<double> values_of(const Frame& frame) const;
  void set_ranges(const std::vector<Frame>& frames);

  Eigen::Vector2d on_paper(const Eigen::Vector2d& lab) const;
  Colour colour_of(const Frame& frame, std::size_t i, const std::vector<double>& values) const;
  void draw(_cairo* to, const Frame& frame) const;
  void draw_grains(_cairo* to, const Frame& frame) const;
  void draw_discs(_cairo* to, const Frame& frame, std::size_t i, double less) const;
  void draw_chains(_cairo* to, const Frame& frame) const;
  void draw_walls(_cairo* to, double time) const;
  void draw_words(_cairo* to, double time) const;
  void draw_key(_cairo* to) const;
  std::string key_words() const;
  std::vector<Colour> film_colours() const;

  const Scene& scene_;
  PictureOptions options_;
  std::vector<Vessel> vessels_;
  std::vector<Line> lines_;
  double letter_;                       // pixels, height of the words
  double scale_ = 1;                    // pixels a metre
  Eigen::Vector2d zero_;                // pixels, of the lab's zero
  int height_ = 0;                      // pixels
  double most_ = 0;                     // m/s or N, where the colours end
  double mean_force_ = 0, widest_ = 0;  // N
};

}  // namespace vibrosow
