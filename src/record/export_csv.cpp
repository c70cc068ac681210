#include <fmt/format.h>

#include <iterator>

#include "cairn/recording.h"
#include "record/output_file.h"

namespace cairn {

namespace {

constexpr std::string_view header = "frame,time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,asleep\n";

/// The shortest text that reads back as the same number.
void appendNumber(fmt::memory_buffer& out, double value) {
    fmt::format_to(std::back_inserter(out), ",{}", value);
}

void appendVector(fmt::memory_buffer& out, const Vec3& v) {
    for (int i = 0; i < 3; ++i) appendNumber(out, v[i]);
}

}  // namespace

void exportCsv(const RecordingReader& recording, const std::filesystem::path& file) {
    OutputFile out(file);
    out.write(header);
    fmt::memory_buffer rows;
    for (std::size_t f = 0; f < recording.info().frames; ++f) {
        const Frame frame = recording.frame(f);
        rows.clear();
        for (std::size_t body = 0; body < recording.info().bodies; ++body) {
            fmt::format_to(std::back_inserter(rows), "{},{},{}", f, frame.time, body);
            appendVector(rows, frame.position[body]);
            const Quat& q = frame.orientation[body];
            for (const double part : {q.w(), q.x(), q.y(), q.z()}) appendNumber(rows, part);
            appendVector(rows, frame.linear_velocity[body]);
            appendVector(rows, frame.angular_velocity[body]);
            fmt::format_to(std::back_inserter(rows), ",{}\n", frame.asleep[body]);
        }
        out.write({rows.data(), rows.size()});
    }
    out.close();
}

}  // namespace cairn
