/// @file What a viewer may ask for: parsed and checked before the simulation sees it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "cairn/settings.h"
#include "cairn/shape.h"
#include "cairn/types.h"
#include "frame_message.h"

namespace cairn::view {

struct Play {};
struct Pause {};
struct Reset {};
struct Step {
    int count = 1;  ///< time steps, 1 to most_steps
};
struct SetSpeed {
    double speed = 1;  ///< simulated seconds per second, in speed_range
};
struct LoadBuiltIn {
    std::string name;
};
struct LoadText {
    std::string name;  ///< of the file, for messages
    std::string text;  ///< a scene file
};
struct SetDial {
    double value = 0;  ///< 0 = performance, 1 = accuracy
};
struct SetField {
    std::string name;
    SettingValue value;
};
struct ThrowBall {
    Vec3 origin;    ///< [m, W]
    Vec3 velocity;  ///< [m/s, W]
    double radius;  ///< [m]
    std::string material;
};
struct AddBody {
    Shape shape;
    std::string material;
    Vec3 position;  ///< [m, W]
};
struct DeleteBody {
    BodyId body;
};
struct FreezeBody {
    BodyId body;
    bool fixed = true;
};
struct GrabBody {
    BodyId body;
    Vec3 point;  ///< of its surface [m, W]
};
struct DragBody {
    Vec3 target;  ///< where the grabbed point should go [m, W]
};
struct ReleaseBody {};
struct SelectBody {
    std::optional<BodyId> body;
};
struct ChooseLayers {
    Layers layers = 0;
};
struct CastRays {
    std::vector<Ray> rays;  ///< of this viewer from now on, in place of those before
};
using Action =
    std::variant<Play, Pause, Reset, Step, SetSpeed, LoadBuiltIn, LoadText, SetDial, SetField, ThrowBall, AddBody,
                 DeleteBody, FreezeBody, GrabBody, DragBody, ReleaseBody, SelectBody, ChooseLayers, CastRays>;

/// A command with the number its answer carries.
struct Command {
    std::optional<std::int64_t> id;
    Action action;
};

inline constexpr int most_steps = 100000;
inline constexpr std::size_t most_rays = 500;  ///< of one viewer
inline constexpr double slowest_speed = 0.01;
inline constexpr double fastest_speed = 100;
inline constexpr double farthest = 1e6;                   ///< coordinates and speeds of commands [m], [m/s]
inline constexpr std::size_t longest_command = 64 << 10;  ///< bytes, apart from scene files
inline constexpr std::size_t longest_upload = 32 << 20;   ///< bytes of a command with a scene file

/// @throws InputError says what is wrong and what is allowed; also for text that is not JSON
Command parseCommand(std::string_view text);

/// The number of a command that was refused, if it can be found.
std::optional<std::int64_t> commandId(std::string_view text) noexcept;

}  // namespace cairn::view
