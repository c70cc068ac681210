#include "engine.h"
#include "ray_casters.h"

namespace cairn::bench {

EngineKind bulletEngine() {
    throw InputError(
        "this program was built without Bullet; install the Debian package libbullet-dev and build again, or leave "
        "'bullet' out of --engines");
}

std::vector<RayCasterKind> bulletRayCasters() {
    throw InputError(
        "this program was built without Bullet, which the suite 'rays' compares with; install the Debian package "
        "libbullet-dev and build again");
}

}  // namespace cairn::bench
