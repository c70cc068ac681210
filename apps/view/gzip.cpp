#include "gzip.h"

#include <zlib.h>

#include <array>
#include <limits>

#include "cairn/types.h"

namespace cairn::view {

namespace {

constexpr int gzip_window = 15 + 16;  // the largest window, with gzip's header

/// Feeds a stream piece by piece, since zlib counts in 32 bits.
template <typename Work>
std::string pump(z_stream& stream, std::string_view bytes, const Work& work) {
    std::string out;
    std::array<char, std::size_t{1} << 16> chunk;
    int state = Z_OK;
    while (state != Z_STREAM_END) {
        if (stream.avail_in == 0) {
            const std::size_t part = std::min<std::size_t>(bytes.size(), std::size_t{1} << 30);
            // zlib does not write to its input, but its type does not say so.
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
            stream.avail_in = static_cast<uInt>(part);
            bytes.remove_prefix(part);
        }
        stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
        stream.avail_out = static_cast<uInt>(chunk.size());
        state = work(stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
        if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR) break;
        const std::size_t made = chunk.size() - stream.avail_out;
        out.append(chunk.data(), made);
        if (state == Z_BUF_ERROR && made == 0) break;
    }
    if (state != Z_STREAM_END) throw IoError("compressed data are broken or cut off");
    return out;
}

struct Deflater {
    Deflater() {
        ok = deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_window, 9, Z_DEFAULT_STRATEGY) == Z_OK;
    }
    ~Deflater() { deflateEnd(&stream); }
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;
    z_stream stream{};
    bool ok;
};

struct Inflater {
    Inflater() { ok = inflateInit2(&stream, gzip_window) == Z_OK; }
    ~Inflater() { inflateEnd(&stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    z_stream stream{};
    bool ok;
};

}  // namespace

std::string gzip(std::string_view bytes) {
    Deflater deflater;
    if (!deflater.ok) throw IoError("compression needs more memory than there is");
    return pump(deflater.stream, bytes, [](z_stream& s, int flush) { return deflate(&s, flush); });
}

std::string gunzip(std::string_view bytes) {
    Inflater inflater;
    if (!inflater.ok) throw IoError("decompression needs more memory than there is");
    return pump(inflater.stream, bytes, [](z_stream& s, int) { return inflate(&s, Z_NO_FLUSH); });
}

}  // namespace cairn::view
