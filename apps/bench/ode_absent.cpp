#include "engine.h"

namespace cairn::bench {

EngineKind odeEngine() {
    throw InputError(
        "this program was built without ODE; install the Debian package libode-dev and build again, or leave 'ode' out "
        "of --engines");
}

}  // namespace cairn::bench
