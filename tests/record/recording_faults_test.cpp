/// @file Recordings that are still written, were cut short, or are none.
#include <fcntl.h>
#include <hdf5.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "record/recording_fixture.h"

namespace {

/// Writes that lie in two pages until one is cut between these by a kill, as the system may do; 0 = none is.
std::size_t torn_write = 0;

}  // namespace

/// In place of the C library's.
extern "C" ssize_t pwrite(int file, const void* from, size_t size, off_t at) {
    constexpr std::size_t page = 4096;
    const std::size_t first = page - static_cast<std::size_t>(at) % page;
    const bool torn = torn_write > 0 && first < size && --torn_write == 0;
    const ssize_t written = syscall(SYS_pwrite64, file, from, torn ? first : size, at);
    if (torn) kill(getpid(), SIGKILL);
    return written;
}

namespace cairn::test {
namespace {

/// A second process that tells us about each frame that it wrote.
class WriterProcess {
  public:
    /// @param work in the process; calls its argument after each frame; its result is the exit code
    explicit WriterProcess(const std::function<int(const std::function<void()>&)>& work) {
        int ends[2];
        if (pipe(ends) != 0) throw IoError("no pipe");
        // A writer that runs far ahead of who reads with it gets so long a file that reading it takes minutes.
        if (fcntl(ends[1], F_SETPIPE_SZ, 4096) < 0) throw IoError("no small pipe");
        id_ = fork();
        if (id_ == 0) {
            close(ends[0]);
            const int told = ends[1];
            _exit(work([told] {
                const char mark = 'f';
                if (write(told, &mark, 1) != 1) _exit(99);
            }));
        }
        close(ends[1]);
        marks_ = ends[0];
    }
    ~WriterProcess() {
        if (id_ > 0) end(SIGKILL);
        close(marks_);
    }
    WriterProcess(const WriterProcess&) = delete;
    WriterProcess& operator=(const WriterProcess&) = delete;

    /// Waits for that many more frames.
    void awaitFrames(std::size_t frames) const {
        char mark = 0;
        for (std::size_t i = 0; i < frames; ++i) ASSERT_EQ(read(marks_, &mark, 1), 1) << "the writer ended early";
    }
    /// Counts the frames until the process ends.
    std::size_t countFrames() const {
        char mark = 0;
        std::size_t frames = 0;
        while (read(marks_, &mark, 1) == 1) ++frames;
        return frames;
    }
    /// @param signal 0 = just wait @return as waitpid()
    int end(int signal) {
        if (signal != 0) kill(id_, signal);
        int status = 0;
        waitpid(id_, &status, 0);
        id_ = -1;
        return status;
    }

  private:
    pid_t id_ = -1;
    int marks_ = -1;
};

/// Writes frames without an end.
int writeForEver(const std::filesystem::path& file, const std::function<void()>& tell) {
    const Scene scene = smallScene();
    RecordingWriter writer(file, scene, settingsFor(scene));
    for (std::size_t i = 0;; ++i) {
        writer.append(madeUpFrame(i, scene.bodies.size()));
        tell();
    }
}

/// A recording whose writer was killed after some frames. @return frames that it told of
std::size_t recordAndKill(const std::filesystem::path& file, std::size_t frames) {
    WriterProcess process([&](const auto& tell) { return writeForEver(file, tell); });
    process.awaitFrames(frames);
    process.end(SIGKILL);
    return frames + process.countFrames();
}

void expectFrames(const std::filesystem::path& file, std::size_t at_least) {
    const RecordingReader reader(file);
    EXPECT_GE(reader.info().frames, at_least);
    for (std::size_t i = 0; i < reader.info().frames; ++i) expectSameFrame(reader.frame(i), madeUpFrame(i, 4));
}

TEST(Recording, canBeReadWhileItIsWritten) {
    const TemporaryFolder folder;
    WriterProcess process([&](const auto& tell) { return writeForEver(folder / "live.h5", tell); });
    std::size_t told = 0;
    for (int i = 0; i < 10; ++i) {
        process.awaitFrames(5);
        told += 5;
        expectFrames(folder / "live.h5", told);
    }
}

TEST(Recording, survivesTheDeathOfItsWriter) {
    const TemporaryFolder folder;
    for (const std::size_t frames : {1U, 7U, 130U}) {
        const std::size_t told = recordAndKill(folder / "killed.h5", frames);
        expectFrames(folder / "killed.h5", told);
    }
}

TEST(Recording, survivesAKillAmidAWrite) {
    const TemporaryFolder folder;
    for (std::size_t write = 1; write < 400; write += 13) {
        WriterProcess process([&](const auto& tell) {
            torn_write = write;
            return writeForEver(folder / "torn.h5", tell);
        });
        const std::size_t told = process.countFrames();
        EXPECT_TRUE(WIFSIGNALED(process.end(0)));
        if (told > 0) expectFrames(folder / "torn.h5", told);
    }
}

TEST(Recording, refusesTruncatedFilesAndSaysSo) {
    const TemporaryFolder folder;
    recordFrames(folder / "closed.h5", 20);
    recordAndKill(folder / "killed.h5", 20);
    for (const char* name : {"closed.h5", "killed.h5"}) {
        const std::string whole = readWhole(folder / name);
        // The last bytes of the killed one may belong to a frame that it did not finish, so they are not cut alone.
        for (const double part : {0.0001, 0.002, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9}) {
            const auto length = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
            std::ofstream(folder / "cut.h5", std::ios::binary) << whole.substr(0, length);
            const std::string message = messageOf<IoError>([&] { RecordingReader(folder / "cut.h5"); });
            const std::string expected = length == 0 ? "is empty" : "is truncated";
            EXPECT_TRUE(contains(message, (folder / "cut.h5").string() + ": " + expected)) << length << message;
        }
    }
}

TEST(Recording, notOneByteMayMissOfAClosedFile) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 3);
    std::filesystem::resize_file(folder / "a.h5", std::filesystem::file_size(folder / "a.h5") - 1);
    EXPECT_TRUE(contains(messageOf<IoError>([&] { RecordingReader(folder / "a.h5"); }), "is truncated"));
}

/// Changes an attribute of the root group.
template <typename Value>
void overwriteAttribute(const std::filesystem::path& file, const char* name, hid_t type, const Value* value) {
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t attribute = H5Aopen(id, name, H5P_DEFAULT);
    const hid_t own_type = type < 0 ? H5Aget_type(attribute) : H5Tcopy(type);
    ASSERT_GE(H5Awrite(attribute, own_type, value), 0);
    H5Tclose(own_type);
    H5Aclose(attribute);
    H5Fclose(id);
}

TEST(Recording, refusesForeignFilesAndSaysWhy) {
    const TemporaryFolder folder;
    const auto message = [&](const char* name) { return messageOf<IoError>([&] { RecordingReader(folder / name); }); };
    EXPECT_TRUE(contains(message("missing.h5"), "No such file")) << message("missing.h5");
    std::filesystem::create_directory(folder / "folder.h5");
    EXPECT_TRUE(contains(message("folder.h5"), "is a directory"));
    std::ofstream(folder / "text.h5") << "frame,time,body\n";
    EXPECT_TRUE(contains(message("text.h5"), "is not an HDF5 file"));
    H5Fclose(H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    EXPECT_TRUE(contains(message("other.h5"), "not a recording of Cairn")) << message("other.h5");
    recordFrames(folder / "marker.h5", 2);
    overwriteAttribute(folder / "marker.h5", "format", -1, "another thing!!");
    EXPECT_TRUE(contains(message("marker.h5"), "not a recording of Cairn")) << message("marker.h5");
    recordFrames(folder / "newer.h5", 2);
    const std::int64_t newer = 2;
    overwriteAttribute(folder / "newer.h5", "format_version", H5T_NATIVE_INT64, &newer);
    EXPECT_TRUE(contains(message("newer.h5"), "another format version than 1")) << message("newer.h5");
}

TEST(Recording, refusesFilesWithoutASeriesOrOfAnotherSize) {
    const TemporaryFolder folder;
    recordFrames(folder / "a.h5", 2);
    hid_t file = H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(H5Ldelete(file, "frames/orientation", H5P_DEFAULT), 0);
    H5Fclose(file);
    EXPECT_TRUE(contains(messageOf<IoError>([&] { RecordingReader(folder / "a.h5"); }), "frames/orientation"));
    recordFrames(folder / "b.h5", 2);
    file = H5Fopen((folder / "b.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(H5Ldelete(file, "frames/position", H5P_DEFAULT), 0);
    ASSERT_GE(H5Lcopy(file, "frames/orientation", file, "frames/position", H5P_DEFAULT, H5P_DEFAULT), 0);
    H5Fclose(file);
    const std::string message = messageOf<IoError>([&] { RecordingReader(folder / "b.h5"); });
    EXPECT_TRUE(contains(message, "'frames/position' has not the shape")) << message;
}

TEST(Recording, saysThatAPathCannotBeWritten) {
    const TemporaryFolder folder;
    const Scene scene = smallScene();
    const std::string path = (folder / "no/such/folder.h5").string();
    const std::string message = messageOf<IoError>([&] { RecordingWriter(path, scene, settingsFor(scene)); });
    EXPECT_EQ(message, path + ": cannot be created: No such file or directory");
}

/// Records on a disk with room for some bytes. @return 0 if the writer threw IoError with the file and the reason
int recordOnFullDisk(const std::filesystem::path& file, rlim_t room, const std::function<void()>& tell) {
    const rlimit limit{room, room};
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 98;
    try {
        writeForEver(file, tell);
    } catch (const IoError& error) {
        return error.what() == file.string() + ": cannot be written: File too large" ? 0 : 97;
    }
    return 96;
}

TEST(Recording, keepsTheFramesBeforeTheDiskWasFull) {
    const TemporaryFolder folder;
    std::size_t most_frames = 0;
    // Every step of writing is once the one that fails: the header, chunks, their index, the superblock.
    for (rlim_t room = 100; room < 90000; room += 1497) {
        WriterProcess process([&](const auto& tell) { return recordOnFullDisk(folder / "full.h5", room, tell); });
        const std::size_t told = process.countFrames();
        const int status = process.end(0);
        ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "room " << room << ", status " << status;
        most_frames = std::max(most_frames, told);
        if (told > 0) {
            const RecordingReader reader(folder / "full.h5");
            EXPECT_EQ(reader.info().frames, told) << "room " << room;
            for (std::size_t i = 0; i < told; ++i) expectSameFrame(reader.frame(i), madeUpFrame(i, 4));
        }
    }
    EXPECT_GT(most_frames, 10U);
}

TEST(Recording, refusesMoreFramesAfterAFailure) {
    const TemporaryFolder folder;
    WriterProcess process([&](const auto&) {
        const rlimit limit{60000, 60000};
        signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &limit);
        const Scene scene = smallScene();
        RecordingWriter writer(folder / "full.h5", scene, settingsFor(scene));
        std::size_t frame = 0;
        try {
            for (;; ++frame) writer.append(madeUpFrame(frame, 4));
        } catch (const IoError&) {
        }
        try {
            writer.append(madeUpFrame(frame, 4));
        } catch (const IoError& error) {
            writer.close();
            return contains(error.what(), "an earlier frame failed") ? 0 : 2;
        }
        return 1;
    });
    const int status = process.end(0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST(Recording, leavesTheErrorHandlerOfTheProgramAlone) {
    H5E_auto2_t before = nullptr;
    H5E_auto2_t after = nullptr;
    void* data = nullptr;
    H5Eget_auto2(H5E_DEFAULT, &before, &data);
    EXPECT_THROW(RecordingReader("missing.h5"), IoError);
    H5Eget_auto2(H5E_DEFAULT, &after, &data);
    EXPECT_NE(before, nullptr);
    EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace cairn::test
