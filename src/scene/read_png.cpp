#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstring>

#include "cairn/mesh_file.h"
#include "scene/mesh_reading.h"

namespace cairn {

namespace {

/// Most pixels that are read: a damaged head must not ask for the memory that it names.
constexpr std::size_t most_pixels = std::size_t{1} << 24U;

/// What libpng reads, and what it last complained of.
struct PngSource {
    const char* at;
    std::size_t left;
    std::array<char, 120> complaint;
};

extern "C" {

void cairnPngRead(png_structp png, png_bytep into, std::size_t count) {
    auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
    if (source->left < count) png_error(png, "it ends too soon");
    std::memcpy(into, source->at, count);
    source->at += count;
    source->left -= count;
}

[[noreturn]] void cairnPngError(png_structp png, png_const_charp message) {
    auto* source = static_cast<PngSource*>(png_get_error_ptr(png));
    std::strncpy(source->complaint.data(), message, source->complaint.size() - 1);
    png_longjmp(png, 1);
}

void cairnPngWarning(png_structp /*png*/, png_const_charp /*message*/) {}

}  // extern "C"

/// A picture that is read. libpng leaves its functions by jumps, so those that call it hold nothing to be destroyed.
class PngPicture {
  public:
    explicit PngPicture(std::string_view bytes) : source_{bytes.data(), bytes.size(), {}} {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, cairnPngError, cairnPngWarning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
    }
    PngPicture(const PngPicture&) = delete;
    PngPicture& operator=(const PngPicture&) = delete;
    ~PngPicture() { png_destroy_read_struct(&png_, &info_, nullptr); }

    /// @return false if libpng complains
    bool readHead() {
        if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_read_fn(png_, &source_, cairnPngRead);
        png_read_info(png_, info_);
        width = png_get_image_width(png_, info_);
        height = png_get_image_height(png_, info_);
        depth = png_get_bit_depth(png_, info_);
        grey = (png_get_color_type(png_, info_) & (PNG_COLOR_MASK_COLOR | PNG_COLOR_MASK_PALETTE)) == 0;
        return true;
    }
    /// Pixels of 16 bits, in the order of bytes of the file. @param rows where each begins
    bool readRows(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_strip_alpha(png_);
        if (depth < 8) png_set_expand_gray_1_2_4_to_8(png_);
        if (depth < 16) png_set_expand_16(png_);
        png_read_update_info(png_, info_);
        png_read_image(png_, rows);
        return true;
    }
    const char* complaint() const { return source_.complaint.data(); }

    std::size_t width = 0;
    std::size_t height = 0;
    int depth = 0;
    bool grey = false;

  private:
    PngSource source_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace

HeightField parseHeightField(std::string_view bytes, std::string_view source, const Eigen::Vector2d& spacing,
                             double scale) {
    const MeshText text{bytes, source};
    if (!(std::isfinite(scale) && scale != 0)) {
        text.refuse(fmt::format("has the scale {}; it is the height of white, finite and not 0 [m]", scale));
    }
    PngPicture picture(bytes);
    if (!picture.readHead()) text.refuse(fmt::format("is no PNG that can be read: {}", picture.complaint()));
    if (!picture.grey) text.refuse("is a picture with colours; save it in grey, of 8 or 16 bits");
    if (picture.width * picture.height > most_pixels) {
        text.refuse(fmt::format("has {} × {} pixels; at most {} are read, divide it among several bodies",
                                picture.width, picture.height, most_pixels));
    }
    const std::size_t row_bytes = 2 * picture.width;
    std::vector<png_byte> pixels(row_bytes * picture.height);
    std::vector<png_bytep> rows(picture.height);
    for (std::size_t i = 0; i < picture.height; ++i) rows[i] = pixels.data() + i * row_bytes;
    if (!picture.readRows(rows.data())) text.refuse(fmt::format("is a damaged PNG: {}", picture.complaint()));
    constexpr double white = 65535;
    std::vector<double> heights;
    heights.reserve(picture.width * picture.height);
    for (std::size_t row = picture.height; row-- > 0;) {
        for (std::size_t column = 0; column < picture.width; ++column) {
            const png_byte* pixel = rows[row] + 2 * column;
            heights.push_back(scale * (256 * pixel[0] + pixel[1]) / white);
        }
    }
    try {
        return HeightField(picture.width, std::move(heights), spacing);
    } catch (const InputError& error) {
        text.refuse(error.what());
    }
}

HeightField readHeightField(const std::filesystem::path& file, const Eigen::Vector2d& spacing, double scale) {
    return parseHeightField(fileContent(file.string(), "a PNG file"), file.string(), spacing, scale);
}

}  // namespace cairn
