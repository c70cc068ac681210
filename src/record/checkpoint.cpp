#include "cairn/checkpoint.h"

#include "record/atomic_file.h"

namespace cairn {

void writeCheckpoint(const SceneRun& run, const std::filesystem::path& file) {
    replaceFile(file, run.save());
}

SceneRun readCheckpoint(const std::filesystem::path& file) {
    return SceneRun::restore(readFile(file), file.string());
}

}  // namespace cairn
