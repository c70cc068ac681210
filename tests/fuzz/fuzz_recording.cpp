/// Any file is a recording or is refused with IoError.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "cairn/recording.h"
#include "fuzz/bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cairn;
    const std::string path =
        (std::filesystem::temp_directory_path() / ("cairn-fuzz-" + std::to_string(getpid()) + ".h5")).string();
    std::FILE* file = std::fopen(path.c_str(), "wb");
    fuzz::require(file != nullptr && std::fwrite(data, 1, size, file) == size);
    std::fclose(file);
    try {
        const RecordingReader reader(path);
        for (std::size_t i = 0; i < reader.info().frames && i < 3; ++i) {
            fuzz::require(reader.frame(i).position.size() == reader.info().bodies);
        }
    } catch (const IoError&) {
        std::filesystem::remove(path);
        return 0;
    }
    std::filesystem::remove(path);
    return 0;
}
