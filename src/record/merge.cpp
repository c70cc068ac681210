#include "cairn/recording.h"
#include "record/recorded_settings.h"

namespace cairn {

void mergeRecording(const RecordingReader& recording, const std::filesystem::path& file) {
    const RecordingInfo& info = recording.info();
    if (info.parts == 0) throw InputError("the recording is one file already; there is nothing to merge");
    RecordingWriter out(file, info.scene, settingsOf(info),
                        {.hashes_per_frame = info.hashes_per_frame,
                         .frame_rate = info.frame_rate,
                         .contacts = info.contacts,
                         .joints = info.joints});
    for (std::size_t i = 0; i < info.frames; ++i) out.append(recording.frame(i));
    out.close();
}

}  // namespace cairn
