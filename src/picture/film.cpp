#include "picture/film.hpp"

#include <gif_lib.h>

#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <unordered_map>
#include <utility>

namespace vibrosow {
namespace {

constexpr int colours = 128, unchanged = colours - 1;  // the last: what the picture before had there

std::uint8_t as_byte(double part) {
  return static_cast<std::uint8_t>(std::lround(255 * part));
}

/// The library knows of no error here but that memory runs out.
void check_gif(int result) {
  if (result != GIF_OK) throw std::bad_alloc();
}

int append_gif_bytes(GifFileType* gif, const GifByteType* bytes, int count) {
  static_cast<std::string*>(gif->UserData)
      ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
  return count;
}

}  // namespace

struct Film::Encoder {
  int width, height;
  std::vector<GifColorType> palette;
  std::unordered_map<std::uint32_t, GifByteType> known{};  // place of a colour in the palette; looked up alone
  std::string bytes{};
  std::vector<GifByteType> last{};  // the picture before
  GifFileType* gif = nullptr;

  GifByteType nearest(const std::uint8_t* pixel) {
    const std::uint32_t colour =
        pixel[0] | static_cast<std::uint32_t>(pixel[1]) << 8 | static_cast<std::uint32_t>(pixel[2]) << 16;
    const auto [place, is_new] = known.try_emplace(colour);
    if (!is_new) return place->second;
    int least = std::numeric_limits<int>::max();
    for (std::size_t k = 0; k + 1 < palette.size(); ++k) {
      const int blue = pixel[0] - palette[k].Blue, green = pixel[1] - palette[k].Green, red = pixel[2] - palette[k].Red;
      const int distance = blue * blue + green * green + red * red;
      if (distance < least) least = distance, place->second = static_cast<GifByteType>(k);
    }
    return place->second;
  }

  void begin() {
    const std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> map(GifMakeMapObject(colours, palette.data()),
                                                                           &GifFreeMapObject);
    if (!map) throw std::bad_alloc();
    EGifSetGifVersion(gif, true);
    check_gif(EGifPutScreenDesc(gif, width, height, 8, 0, map.get()));
    const GifByteType for_ever[] = {1, 0, 0};
    check_gif(EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE));
    check_gif(EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0"));
    check_gif(EGifPutExtensionBlock(gif, 3, for_ever));
    check_gif(EGifPutExtensionTrailer(gif));
  }
};

Film::Film(int width, int height, const std::vector<Colour>& palette)
    : encoder_(new Encoder{width, height, std::vector<GifColorType>(colours)}) {
  for (std::size_t k = 0; k < encoder_->palette.size(); ++k) {
    const Colour& colour = palette[std::min(k, palette.size() - 1)];
    encoder_->palette[k] = {as_byte(colour.red), as_byte(colour.green), as_byte(colour.blue)};
  }
  int error = 0;
  encoder_->gif = EGifOpen(&encoder_->bytes, append_gif_bytes, &error);
  if (!encoder_->gif) {
    delete encoder_;
    throw std::bad_alloc();
  }
  encoder_->begin();
}

Film::~Film() {
  int error = 0;
  if (encoder_->gif) EGifCloseFile(encoder_->gif, &error);
  delete encoder_;
}

void Film::add(const Pixels& picture, int hundredths) {
  Encoder& e = *encoder_;
  const std::size_t count = static_cast<std::size_t>(e.width) * static_cast<std::size_t>(e.height);
  std::vector<GifByteType> now(count), shown(count);
  for (std::size_t k = 0; k < count; ++k) {
    now[k] = e.nearest(picture.data() + 4 * k);
    shown[k] = !e.last.empty() && e.last[k] == now[k] ? GifByteType{unchanged} : now[k];
  }
  const GraphicsControlBlock control{DISPOSE_DO_NOT, false, hundredths,
                                     e.last.empty() ? NO_TRANSPARENT_COLOR : unchanged};
  GifByteType extension[4];
  const auto size = static_cast<int>(EGifGCBToExtension(&control, extension));
  check_gif(EGifPutExtension(e.gif, GRAPHICS_EXT_FUNC_CODE, size, extension));
  check_gif(EGifPutImageDesc(e.gif, 0, 0, e.width, e.height, false, nullptr));
  for (int row = 0; row < e.height; ++row)
    check_gif(EGifPutLine(e.gif, shown.data() + std::ptrdiff_t{row} * e.width, e.width));
  e.last = std::move(now);
}

std::string Film::file() {
  int error = 0;
  check_gif(EGifCloseFile(std::exchange(encoder_->gif, nullptr), &error));
  return std::move(encoder_->bytes);
}

}  // namespace vibrosow
