#include "cli/output.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "cairn/types.h"

namespace cairn::cli {

namespace {

bool writeAll(std::FILE* stream, std::string_view text) {
    return std::fwrite(text.data(), 1, text.size(), stream) == text.size() && std::fflush(stream) == 0;
}

[[noreturn]] void fail(std::string_view name) {
    throw IoError(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
}

}  // namespace

void printOut(std::string_view text) {
    if (writeAll(stdout, text)) return;
    if (errno == EPIPE) throw ReaderGone{};
    fail("standard output");
}

void printError(std::string_view message) {
    printLine(stderr, fmt::format("cairn: error: {}", message));
}

void printLine(std::FILE* stream, std::string_view line) {
    writeAll(stream, fmt::format("{}\n", line));
}

TextFile::TextFile(const std::filesystem::path& path) : path_(path), file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) fail(path_.string());
}

void TextFile::write(std::string_view text) {
    if (!writeAll(file_.get(), text)) fail(path_.string());
}

}  // namespace cairn::cli
