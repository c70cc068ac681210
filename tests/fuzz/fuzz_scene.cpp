/// Any text is a scene or is refused with InputError; a scene is written and read again as the same, and runs.
#include <string_view>

#include "cairn/scene.h"
#include "fuzz/bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cairn;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const Scene scene = parseScene(text, "fuzz.json");
        const std::string written = formatScene(scene);
        fuzz::require(formatScene(parseScene(written, "written")) == written);
        if (scene.bodies.size() > 200) return 0;
        Settings settings = settingsFor(scene);
        fuzz::boundWork(settings);
        SceneRun run(scene, settings);
        run.world().setChecks(Checks::on);
        for (int i = 0; i < 2; ++i) run.step();
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
