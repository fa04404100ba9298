#include "picture/picture.hpp"

#include <cairo.h>
#include <gif_lib.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "picture/film.hpp"

namespace vibrosow {
namespace {

struct Rgb {
  int red, green, blue;
  bool operator==(const Rgb&) const = default;
};

Rgb rgb(const Colour& colour) {
  const auto byte = [](double part) { return static_cast<int>(std::lround(255 * part)); };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

bool near(const Rgb& a, const Rgb& b) {
  return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue) <= 6;
}

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;
  std::ptrdiff_t count(const Colour& colour) const {
    return std::ranges::count_if(pixels, [&](const Rgb& p) { return near(p, rgb(colour)); });
  }
};

struct Source {
  const std::string* bytes;
  std::size_t at = 0;
};

Image read_png(const std::string& bytes) {
  Source source{&bytes};
  const auto read = [](void* from, unsigned char* to, unsigned int length) {
    Source& s = *static_cast<Source*>(from);
    if (s.at + length > s.bytes->size()) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(to, s.bytes->data() + s.at, length);
    s.at += length;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(read, &source);
  EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
  Image image{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (std::size_t k = 0; k < count; ++k) image.pixels.push_back({data[4 * k + 2], data[4 * k + 1], data[4 * k]});
  cairo_surface_destroy(surface);
  return image;
}

struct FilmFrame {
  Image image;
  int hundredths;
};

std::vector<FilmFrame> read_gif(const std::string& bytes) {
  Source source{&bytes};
  const InputFunc read = [](GifFileType* gif, GifByteType* to, int length) {
    Source& s = *static_cast<Source*>(gif->UserData);
    const std::size_t count = std::min(static_cast<std::size_t>(length), s.bytes->size() - s.at);
    std::copy_n(s.bytes->data() + s.at, count, to);
    s.at += count;
    return static_cast<int>(count);
  };
  int error = 0;
  GifFileType* gif = DGifOpen(&source, read, &error);
  EXPECT_EQ(DGifSlurp(gif), GIF_OK);
  std::vector<FilmFrame> frames;
  Image shown{gif->SWidth, gif->SHeight, {}};
  shown.pixels.resize(static_cast<std::size_t>(gif->SWidth) * static_cast<std::size_t>(gif->SHeight));
  for (int k = 0; k < gif->ImageCount; ++k) {
    GraphicsControlBlock control;
    EXPECT_EQ(DGifSavedExtensionToGCB(gif, k, &control), GIF_OK);
    for (std::size_t p = 0; p < shown.pixels.size(); ++p) {
      const int index = gif->SavedImages[k].RasterBits[p];
      if (index == control.TransparentColor) continue;
      const GifColorType& c = gif->SColorMap->Colors[index];
      shown.pixels[p] = {c.Red, c.Green, c.Blue};
    }
    frames.push_back({shown, control.DelayTime});
  }
  DGifCloseFile(gif, &error);
  return frames;
}

class Pictures : public testing::Test {
 protected:
  void SetUp() override {
    scene.title = "a tray";
    scene.lots = {{.name = "wheat", .diameter = 20e-3, .mass = 1e-3},
                  {.name = "weed", .diameter = 10e-3, .mass = 1e-3}};
    scene.tray.name = "tray";
    scene.tray.length = 0.2, scene.tray.height = 0.1;
    frame.bed = {.time = 1.25,
                 .x = {0.05, 0.15},
                 .y = {0.05, 0.05},
                 .vx = {0, 3},
                 .vy = {0, 4},
                 .omega = {0, 0},
                 .lot = {0, 1},
                 .id = {3, 8},
                 .radius = {10e-3, 5e-3},
                 .mass = {},
                 .area = {},
                 .start_x = {},
                 .start_y = {}};
  }
  Picture picture() const { return {scene, {frame}, options}; }

  Scene scene;
  Frame frame;
  PictureOptions options{.width = 1000};
};

TEST_F(Pictures, DiscsHaveTheirAreaOnTheTraysScale) {
  const Image image = read_png(picture().png(frame));
  EXPECT_EQ(image.width, 1000);
  const double letter = 1000 / 64.0, scale = (1000 - 2 * letter) / scene.tray.length;
  const double rim = letter / 20;
  for (const std::size_t lot : {0u, 1u}) {
    const double radius = scale * frame.bed.radius[lot] - rim;
    const double swatch = 0.85 * letter * 0.85 * letter;  // of the key
    EXPECT_NEAR(static_cast<double>(image.count(lot_colour(lot))), std::numbers::pi * radius * radius + swatch,
                8 * radius);
  }
}

TEST_F(Pictures, AGateIsGoneOnceItIsOpen) {
  scene.tray.holes = {{0.1, 0.1, 1.0}};
  const auto dark = [&](double time) {
    frame.bed.time = time;
    return read_png(picture().png(frame)).count(ink);
  };
  EXPECT_GT(dark(0.999), dark(1.001) + 400);
}

TEST_F(Pictures, SpeedsAndForcesColourTheGrains) {
  options.colour_by = ColourBy::speed;
  EXPECT_GT(read_png(picture().png(frame)).count(ramp_colour(1)), 1000) << "of two values the larger is the ends'";
  options.colour_by = ColourBy::force;
  frame.contacts = {{3, -1, {0.05, 0.05, 0}, {0.05, 0, 0}, {0, 2, 0}, {}, 1e-6}};
  const Image image = read_png(picture().png(frame));
  EXPECT_GT(image.count(ramp_colour(0)), 1000);
}

TEST_F(Pictures, ForceChainsJoinWhatTouches) {
  frame.contacts = {{3, 8, {0.05, 0.05, 0}, {0.15, 0.05, 0}, {2, 0, 0}, {}, 1e-6}};
  EXPECT_EQ(read_png(picture().png(frame)).count(force_red), 0);
  options.force_chains = true;
  EXPECT_GT(read_png(picture().png(frame)).count(force_red), 400);
}

TEST_F(Pictures, InSpaceTheNearerGrainHidesTheOther) {
  scene.space = Space::three_dimensional;
  scene.tray.depth = 0.1;
  frame.bed.x[1] = frame.bed.x[0];
  frame.bed.z = {0.02, 0.08}, frame.bed.vz = {0, 0};
  const std::ptrdiff_t key = 250;
  EXPECT_LT(read_png(picture().png(frame)).count(lot_colour(1)), key);
  frame.bed.z = {0.08, 0.02};
  EXPECT_GT(read_png(picture().png(frame)).count(lot_colour(1)), 4 * key);
}

TEST_F(Pictures, AHighVesselIsNoHigherThanTwiceTheWidth) {
  scene.tray.height = 10;
  const Picture high = picture();
  EXPECT_LT(high.height(), 2 * high.width());
}

TEST_F(Pictures, SvgHasTheSameSizeAndTheSameBytesTwice) {
  const Picture drawn = picture();
  const std::string svg = drawn.svg(frame);
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_NE(svg.find("width=\"1000px\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_EQ(drawn.png(frame), drawn.png(frame));
}

TEST_F(Pictures, AFilmsFramesAreThePicturesInItsColours) {
  options.width = 400;
  Frame later = frame;
  later.bed.time = 1.35, later.bed.x[0] = 0.1;
  Frame last = frame;
  last.bed.time = 1.352;
  const Picture drawn(scene, {frame, later, last}, options);
  const auto film = read_gif(drawn.gif({frame, later, last}));
  ASSERT_EQ(film.size(), 3u);
  EXPECT_EQ(film[0].hundredths, 10);
  EXPECT_EQ(film[1].hundredths, 2) << "no shorter than browsers show";
  const std::vector<Frame> frames = {frame, later, last};
  for (std::size_t k = 0; k < 3; ++k) {
    const Image still = read_png(drawn.png(frames[k]));
    ASSERT_EQ(still.pixels.size(), film[k].image.pixels.size());
    double difference = 0;
    for (std::size_t p = 0; p < still.pixels.size(); ++p)
      difference += std::abs(still.pixels[p].red - film[k].image.pixels[p].red);
    EXPECT_LT(difference / static_cast<double>(still.pixels.size()), 1) << "of 255, in the mean of all pixels";
  }
  EXPECT_NE(film[0].image.pixels, film[1].image.pixels);
}

}  // namespace
}  // namespace vibrosow
