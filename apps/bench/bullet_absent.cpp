#include "engine.h"

namespace cairn::bench {

EngineKind bulletEngine() {
    throw InputError(
        "this program was built without Bullet; install the Debian package libbullet-dev and build again, or leave "
        "'bullet' out of --engines");
}

}  // namespace cairn::bench
