#include "picture/picture.hpp"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <numeric>

#include "grains/turned_discs.hpp"
#include "picture/cairo_bytes.hpp"
#include "picture/film.hpp"
#include "scene/spaces.hpp"
#include "vessel/vessel_motion.hpp"
#include "vessel/vessel_walls.hpp"
#include "vessel/wall_points.hpp"

namespace vibrosow {
namespace {

using Point = Eigen::Vector2d;
using Canvas = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

constexpr double highest_picture = 1.4;  // its height over its width, at most
constexpr double most_of_values = 0.98;  // of the grains lie below the end of the colours

void set_colour(cairo_t* to, const Colour& colour) {
  cairo_set_source_rgb(to, colour.red, colour.green, colour.blue);
}

double norm(const std::array<double, 3>& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/// The value that a share of all lie below; 0 of none.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// 1, 2 or 5 times a power of ten: the largest that is not above `value`.
double round_length(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= value) return factor * power;
  return power;
}

}  // namespace

Picture::Picture(const Scene& scene, const std::vector<Frame>& frames, const PictureOptions& options)
    : scene_(scene), options_(options), letter_(std::max(11.0, options.width / 64.0)) {
  const Scene slice = in_plane(scene);
  add_lines(0, slice.tray);
  if (scene.hopper) add_lines(1, *slice.hopper);
  set_scale(extent_of(frames));
  set_ranges(frames);
}

void Picture::add_lines(std::size_t vessel, const Vessel& from_the_side) {
  for (const WallSegment& wall : walls_from_the_front(from_the_side))
    lines_.push_back({vessel, wall_points(wall), wall.opens_at});
  vessels_.push_back(from_the_side);
}

Point Picture::in_lab(const Line& line, std::size_t point, double time) const {
  const Vessel& vessel = vessels_[line.vessel];
  return in_lab_frame(vessel, vessel_pose(vessel, time), line.points[point]);
}

Picture::Extent Picture::extent_of(const std::vector<Frame>& frames) const {
  Extent extent{Point::Constant(std::numeric_limits<double>::infinity()),
                Point::Constant(-std::numeric_limits<double>::infinity())};
  const auto take = [&](const Point& at, double radius) {
    extent.least = extent.least.cwiseMin(at - Point::Constant(radius));
    extent.most = extent.most.cwiseMax(at + Point::Constant(radius));
  };
  for (const Frame& frame : frames) {
    for (const Line& line : lines_)
      for (std::size_t k = 0; k < line.points.size(); ++k) take(in_lab(line, k, frame.bed.time), 0);
    for (std::size_t i = 0; i < frame.bed.size(); ++i) take({frame.bed.x[i], frame.bed.y[i]}, frame.bed.radius[i]);
  }
  return extent;
}

void Picture::set_scale(const Extent& extent) {
  const Point size = extent.most - extent.least;
  const double above = 2.2 * letter_, below = 2.6 * letter_, beside = letter_;
  const double width = options_.width - 2 * beside, highest = highest_picture * options_.width - above - below;
  scale_ = std::min(width / size.x(), highest / size.y());
  const double drawn = scale_ * size.y();
  height_ = static_cast<int>(std::ceil(above + drawn + below));
  zero_ = Point(beside + 0.5 * (width - scale_ * size.x()) - scale_ * extent.least.x(),
                above + drawn + scale_ * extent.least.y());
}

/// By grain, what it is coloured by; nothing for lots.
std::vector<double> Picture::values_of(const Frame& frame) const {
  if (options_.colour_by == ColourBy::lot) return {};
  const Snapshot& bed = frame.bed;
  std::vector<double> values(bed.size(), 0.0);
  if (options_.colour_by == ColourBy::speed) {
    for (std::size_t i = 0; i < bed.size(); ++i) values[i] = norm({bed.vx[i], bed.vy[i], bed.is_3d() ? bed.vz[i] : 0});
    return values;
  }
  const auto add = [&](std::int64_t id, double force) {
    const auto place = std::ranges::lower_bound(bed.id, id);
    if (place != bed.id.end() && *place == id) values[static_cast<std::size_t>(place - bed.id.begin())] += force;
  };
  for (const GrainContact& contact : frame.contacts) {
    const double force = norm(contact.normal_force);
    add(contact.grain, force), add(contact.partner, force);
  }
  return values;
}

void Picture::set_ranges(const std::vector<Frame>& frames) {
  std::vector<double> all;
  double sum = 0;
  std::size_t contacts = 0;
  for (const Frame& frame : frames) {
    const std::vector<double> values = values_of(frame);
    all.insert(all.end(), values.begin(), values.end());
    for (const GrainContact& contact : frame.contacts)
      sum += norm(contact.normal_force), widest_ = std::max(widest_, norm(contact.normal_force));
    contacts += frame.contacts.size();
  }
  most_ = quantile(std::move(all), most_of_values);
  mean_force_ = contacts > 0 ? sum / static_cast<double>(contacts) : 0;
}

Point Picture::on_paper(const Point& lab) const {
  return {zero_.x() + scale_ * lab.x(), zero_.y() - scale_ * lab.y()};
}

Colour Picture::colour_of(const Frame& frame, std::size_t i, const std::vector<double>& values) const {
  if (values.empty()) return lot_colour(static_cast<std::size_t>(frame.bed.lot[i]));
  return ramp_colour(most_ > 0 ? values[i] / most_ : 0);
}

/// `less`: pixels by which every disc is drawn smaller.
void Picture::draw_discs(cairo_t* to, const Frame& frame, std::size_t i, double less) const {
  const Snapshot& bed = frame.bed;
  const SeedLot& lot = scene_.lots.at(static_cast<std::size_t>(bed.lot[i]));
  Turn turn;
  if (!bed.angle.empty()) turn.angle = bed.angle[i];
  if (!bed.q_w.empty()) turn.orientation = {bed.q_w[i], bed.q_x[i], bed.q_y[i], bed.q_z[i]};
  for (const ClumpDisc& disc : turned_discs(lot, 2 * bed.radius[i] / lot.diameter, turn)) {
    const Point at = on_paper({bed.x[i] + disc.x, bed.y[i] + disc.y});
    cairo_new_sub_path(to);
    cairo_arc(to, at.x(), at.y(), std::max(0.3, scale_ * disc.radius - less), 0, 2 * std::numbers::pi);
  }
  cairo_fill(to);
}

/// A darker disc, and a smaller one on it: so that clumps have a rim all round.
void Picture::draw_grains(cairo_t* to, const Frame& frame) const {
  const Snapshot& bed = frame.bed;
  std::vector<std::size_t> order(bed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (bed.is_3d()) std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return bed.z[a] > bed.z[b]; });
  const std::vector<double> values = values_of(frame);
  for (const std::size_t i : order) {
    const Colour colour = colour_of(frame, i, values);
    set_colour(to, mixed(colour, ink, 0.6));
    draw_discs(to, frame, i, 0);
    set_colour(to, options_.force_chains ? mixed(colour, paper, 0.35) : colour);
    draw_discs(to, frame, i, std::max(0.5, letter_ / 20));
  }
}

/// As wide as the root of the force, so that a hard impact leaves the others visible; the mean force a tenth of a
/// letter.
void Picture::draw_chains(cairo_t* to, const Frame& frame) const {
  if (mean_force_ == 0) return;
  set_colour(to, force_red);
  cairo_set_line_cap(to, CAIRO_LINE_CAP_ROUND);
  for (const GrainContact& contact : frame.contacts) {
    const Point from = on_paper({contact.from[0], contact.from[1]}), end = on_paper({contact.to[0], contact.to[1]});
    cairo_set_line_width(to, std::min(0.4, 0.1 * std::sqrt(norm(contact.normal_force) / mean_force_)) * letter_);
    cairo_move_to(to, from.x(), from.y());
    cairo_line_to(to, end.x(), end.y());
    cairo_stroke(to);
  }
}

void Picture::draw_walls(cairo_t* to, double time) const {
  set_colour(to, ink);
  cairo_set_line_width(to, letter_ / 8);
  cairo_set_line_cap(to, CAIRO_LINE_CAP_ROUND);
  for (const Line& line : lines_) {
    if (line.opens_at > 0 && time >= line.opens_at) continue;
    for (std::size_t k = 0; k < line.points.size(); ++k) {
      const Point at = on_paper(in_lab(line, k, time));
      k == 0 ? cairo_move_to(to, at.x(), at.y()) : cairo_line_to(to, at.x(), at.y());
    }
    cairo_stroke(to);
  }
}

/// The title, the time, and a length for comparison.
void Picture::draw_words(cairo_t* to, double time) const {
  set_colour(to, ink);
  cairo_select_font_face(to, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(to, letter_);
  const std::string when = fmt::format("{:.3f} s", time);
  cairo_text_extents_t size;
  cairo_text_extents(to, when.c_str(), &size);
  const double edge = options_.width - letter_, top = 1.5 * letter_, bottom = height_ - 0.8 * letter_;
  cairo_move_to(to, edge - size.x_advance, top);
  cairo_show_text(to, when.c_str());
  cairo_save(to);
  cairo_rectangle(to, 0, 0, edge - size.x_advance - letter_, height_);  // a long title ends before the time
  cairo_clip(to);
  cairo_move_to(to, letter_, top);
  cairo_show_text(to, scene_.title.c_str());
  cairo_restore(to);
  const double length = round_length(0.15 * options_.width / scale_);
  cairo_set_line_width(to, letter_ / 8);
  cairo_move_to(to, edge - scale_ * length, bottom + 0.3 * letter_);
  cairo_line_to(to, edge, bottom + 0.3 * letter_);
  cairo_stroke(to);
  const std::string how_long = fmt::format("{:g} mm", 1e3 * length);
  cairo_text_extents(to, how_long.c_str(), &size);
  cairo_move_to(to, edge - size.x_advance, bottom - 0.1 * letter_);
  cairo_show_text(to, how_long.c_str());
}

std::string Picture::key_words() const {
  std::string words;
  if (options_.colour_by == ColourBy::speed) words = fmt::format("0 to {:.2g} m/s and above", most_);
  if (options_.colour_by == ColourBy::force) words = fmt::format("0 to {:.2g} N and above", most_);
  if (options_.force_chains)
    words += fmt::format("{}contacts {:.2g} N in the mean, at most {:.2g} N", words.empty() ? "" : "; ", mean_force_,
                         widest_);
  return words;
}

/// What the colours mean: names of several lots, or from where to where.
void Picture::draw_key(cairo_t* to) const {
  double x = letter_;
  const double y = height_ - 0.8 * letter_;
  const auto swatch = [&](const Colour& colour, double width) {
    set_colour(to, colour);
    cairo_rectangle(to, x, y - 0.75 * letter_, width, 0.85 * letter_);
    cairo_fill(to);
    x += width;
  };
  const auto word = [&](const std::string& text) {
    set_colour(to, ink);
    cairo_text_extents_t size;
    cairo_text_extents(to, text.c_str(), &size);
    cairo_move_to(to, x + 0.4 * letter_, y);
    cairo_show_text(to, text.c_str());
    x += size.x_advance + 1.4 * letter_;
  };
  constexpr int steps = 16;
  if (options_.colour_by != ColourBy::lot)
    for (int k = 0; k < steps; ++k) swatch(ramp_colour((k + 0.5) / steps), 0.5 * letter_);
  else if (scene_.lots.size() > 1)
    for (std::size_t lot = 0; lot < scene_.lots.size(); ++lot)
      swatch(lot_colour(lot), 0.85 * letter_), word(scene_.lots[lot].name);
  if (const std::string words = key_words(); !words.empty()) word(words);
}

void Picture::draw(cairo_t* to, const Frame& frame) const {
  set_colour(to, paper);
  cairo_paint(to);
  draw_grains(to, frame);
  if (options_.force_chains) draw_chains(to, frame);
  draw_walls(to, frame.bed.time);
  draw_words(to, frame.bed.time);
  draw_key(to);
  check_cairo(cairo_status(to));
}

std::string Picture::png(const Frame& frame) const {
  const Canvas surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, options_.width, height_), &cairo_surface_destroy);
  const Context context(cairo_create(surface.get()), &cairo_destroy);
  draw(context.get(), frame);
  std::string bytes;
  check_cairo(cairo_surface_write_to_png_stream(surface.get(), append_bytes, &bytes));
  return bytes;
}

std::string Picture::svg(const Frame& frame) const {
  std::string bytes;
  const Canvas surface(cairo_svg_surface_create_for_stream(append_bytes, &bytes, options_.width, height_),
                       &cairo_surface_destroy);
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  {
    const Context context(cairo_create(surface.get()), &cairo_destroy);
    draw(context.get(), frame);
  }
  cairo_surface_finish(surface.get());
  check_cairo(cairo_surface_status(surface.get()));
  return bytes;
}

/// What there is to be seen, and what lies between it and the paper where edges are smoothed.
std::vector<Colour> Picture::film_colours() const {
  std::vector<Colour> inks = {ink};
  constexpr int steps = 16;
  if (options_.colour_by == ColourBy::lot)
    for (std::size_t lot = 0; lot < std::min<std::size_t>(7, scene_.lots.size()); ++lot)
      inks.push_back(lot_colour(lot));
  else
    for (int k = 0; k < steps; ++k) inks.push_back(ramp_colour((k + 0.5) / steps));
  std::vector<Colour> colours = {paper};
  for (const Colour& colour : inks) {
    for (const double share : {1.0, 0.65, 0.35}) colours.push_back(mixed(colour, paper, share));
    colours.push_back(mixed(colour, ink, 0.6)), colours.push_back(mixed(colour, ink, 0.8));
  }
  if (options_.force_chains)
    for (const double share : {1.0, 0.65, 0.35}) colours.push_back(mixed(force_red, paper, share));
  return colours;
}

std::string Picture::gif(const std::vector<Frame>& frames) const {
  const Canvas surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, options_.width, height_), &cairo_surface_destroy);
  const Context context(cairo_create(surface.get()), &cairo_destroy);
  Film film(options_.width, height_, film_colours());
  const auto hundredths = [&](std::size_t k) { return std::lround(100 * frames[k].bed.time); };
  constexpr long least = 2;
  long shown = least;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    draw(context.get(), frames[k]);
    cairo_surface_flush(surface.get());
    const unsigned char* data = cairo_image_surface_get_data(surface.get());  // rows of 4 bytes a pixel have no gaps
    if (k + 1 < frames.size()) shown = std::max(least, hundredths(k + 1) - hundredths(k));
    film.add(Pixels(data, data + std::size_t{4} * static_cast<std::size_t>(options_.width * height_)),
             static_cast<int>(shown));
  }
  return film.file();
}

}  // namespace vibrosow
