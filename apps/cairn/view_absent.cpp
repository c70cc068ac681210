/// @file What stands in for the viewer where it was not built (CAIRN_BUILD_VIEW=OFF).
#include "commands.h"
#include "view_exports.h"

namespace cairn::cli {

namespace {

[[noreturn]] void refuse() {
    throw IoError("this cairn was built without its viewer; configure with -DCAIRN_BUILD_VIEW=ON and build again");
}

}  // namespace

void writeViewExports(const RecordingReader&, const ViewExports& exports) {
    if (!exports.html.empty() || !exports.png.empty() || !exports.mp4.empty()) refuse();
}

void addView(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("view", "Show a running scene or recordings in the browser (not built)");
    command->allow_extras();
    command->callback([] { refuse(); });
}

}  // namespace cairn::cli
