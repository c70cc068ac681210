// Reads the recording, says when the ball was fastest, and makes a scene file of it for the viewer.
#include <cairn/cairn.h>

#include <cstdio>

int main() {
    const cairn::RecordingReader recording("pyramid.h5");
    const auto& info = recording.info();
    const auto ball = info.bodies - 1;

    double fastest = 0;
    double time = 0;
    for (std::size_t i = 0; i < info.frames; ++i) {
        const auto frame = recording.frame(i);
        const double speed = frame.linear_velocity[ball].norm();
        if (speed > fastest) {
            fastest = speed;
            time = frame.time;
        }
    }
    std::printf("the ball is fastest after %.2f s: %.1f m/s\n", time, fastest);

    cairn::writeScene(info.scene, "pyramid.json");
    std::printf("cairn view pyramid.h5 shows the recording, cairn view pyramid.json runs the scene\n");
}
