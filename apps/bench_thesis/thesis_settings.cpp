#include "thesis_settings.h"

namespace cairn::thesis {

Settings thesisSettings(Preset preset, std::int64_t threads, Variant variant) {
    Settings settings = Settings::preset(preset);
    settings.parallel.threads = threads;
    if (variant == Variant::undamped) settings.sleep.damping = 0;
    if (variant == Variant::greedy || variant == Variant::latest_first) {
        settings.resolution.iterations = 0;
        settings.resolution.shock_propagation = false;
    }
    if (variant == Variant::latest_first) settings.resolution.resolution = ResolutionKind::arbitrary_order;
    return settings;
}

}  // namespace cairn::thesis
