#include "cairn/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>

#include "messages/packing.h"
#include "record/atomic_file.h"
#include "scene/scene_writing.h"
#include "world/byte_stream.h"

namespace cairn {

namespace {

/// How a file of a part is recognised.
struct PartMark {
    std::uint64_t size = 0;   ///< [bytes]
    std::uint64_t check = 0;  ///< the last of its checksums
};

/// Adds bytes that follow those before. Checksums are never divided.
void extend(PartMark& mark, std::span<const std::byte> bytes) {
    mark.size += bytes.size();
    if (bytes.size() >= sizeof mark.check)
        std::memcpy(&mark.check, bytes.last(sizeof mark.check).data(), sizeof mark.check);
}

PartMark markOf(const std::vector<std::byte>& part) {
    PartMark mark;
    extend(mark, part);
    return mark;
}

/// Where the parts of a checkpoint are: beside the file that names them.
std::filesystem::path partsFolder(const std::filesystem::path& file) {
    return file.string() + ".parts";
}

/// @param serial number of the checkpoint, so that a new one leaves the parts of the last alone
std::filesystem::path partFile(const std::filesystem::path& file, std::uint64_t serial, std::size_t rank) {
    return partsFolder(file) / fmt::format("{}.rank{}", serial, rank);
}

/// The scene of the run.
std::filesystem::path sceneFile(const std::filesystem::path& file, std::uint64_t serial) {
    return partsFolder(file) / fmt::format("{}.scene", serial);
}

/// The number that a file of a part or of a scene begins with; none if it is no such file.
std::optional<std::uint64_t> serialOf(const std::filesystem::path& part) {
    const std::string name = part.filename().string();
    std::uint64_t serial = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), serial);
    if (error != std::errc() || !std::string_view(end).starts_with('.')) return std::nullopt;
    return serial;
}

/// Calls use(path, serial) for the files of parts that are there.
template <class Use>
void forParts(const std::filesystem::path& file, const Use& use) {
    std::error_code absent;
    for (const auto& entry : std::filesystem::directory_iterator(partsFolder(file), absent)) {
        if (const auto serial = serialOf(entry.path())) use(entry.path(), *serial);
    }
}

/// Removes the parts of other checkpoints. What cannot be removed does no harm.
void removeOthers(const std::filesystem::path& file, std::optional<std::uint64_t> kept) {
    std::error_code ignored;
    std::vector<std::filesystem::path> others;
    forParts(file, [&](const std::filesystem::path& part, std::uint64_t serial) {
        if (serial != kept) others.push_back(part);
    });
    for (const std::filesystem::path& part : others) std::filesystem::remove(part, ignored);
    if (!kept) std::filesystem::remove(partsFolder(file), ignored);
}

/// The number of the next checkpoint. @throws IoError if its folder cannot be made
std::uint64_t beginParts(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::create_directory(partsFolder(file), error);
    if (error) {
        throw IoError(fmt::format("{}: cannot be made: {}", partsFolder(file).string(), error.message()));
    }
    std::uint64_t last = 0;
    forParts(file, [&](const std::filesystem::path&, std::uint64_t serial) { last = std::max(last, serial); });
    return last + 1;
}

/// Lets all ranks do something; if it fails on one it fails on all, with the error of the lowest one.
/// @return what each told
template <class Value, class Work>
std::vector<Value> together(Ranks& ranks, const Work& work) {
    Value own{};
    std::string problem;
    try {
        own = work();
    } catch (const IoError& error) {
        problem = error.what();
    }
    std::vector<std::byte> message;
    pack(message, own);
    for (const char letter : problem) pack(message, letter);
    std::vector<Value> all;
    std::string first;
    for (const std::vector<std::byte>& told : tellAll(ranks, message)) {
        Unpacker in(told);
        all.push_back(in.get<Value>());
        std::string text;
        while (!in.isAtEnd()) text += in.get<char>();
        if (first.empty()) first = text;
    }
    if (!first.empty()) throw IoError(first);
    return all;
}

/// Writes the scene. @return its length [bytes]
std::uint64_t writeSceneOf(const SceneRun& run, const std::filesystem::path& file) {
    std::uint64_t size = 0;
    replaceFile(file, [&](const AppendBytes& append) {
        writeText(run.source(), [&](std::string_view piece) {
            append(std::as_bytes(std::span(piece)));
            size += piece.size();
        });
    });
    return size;
}

/// Writes the scene, which files a checkpoint consists of, and what these have in common, which makes it the
/// checkpoint.
void writeNames(const SceneRun& run, const std::filesystem::path& file, std::uint64_t serial,
                const std::vector<PartMark>& marks) {
    std::vector<std::byte> bytes;
    ByteWriter out(bytes, FrameKind::checkpoint);
    out.put(serial);
    out.put(writeSceneOf(run, sceneFile(file, serial)));
    out.put(std::uint64_t{marks.size()});
    for (const PartMark& mark : marks) {
        out.put(mark.size);
        out.put(mark.check);
    }
    out.putArray(std::span<const std::byte>(run.saveCommon()));
    out.finish();
    replaceFile(file, bytes);
}

/// Every rank writes its part; then the first one writes the file that names them.
void writeParts(const SceneRun& run, const std::filesystem::path& file) {
    Ranks& ranks = *run.world().ranks();
    const bool is_first = ranks.rank() == 0;
    const std::uint64_t serial =
        together<std::uint64_t>(ranks, [&] { return is_first ? beginParts(file) : 0; }).front();
    const std::filesystem::path part = partFile(file, serial, static_cast<std::size_t>(ranks.rank()));
    try {
        const std::vector<PartMark> marks = together<PartMark>(ranks, [&] {
            PartMark mark;
            replaceFile(part, [&](const AppendBytes& append) {
                run.world().savePart([&](std::span<const std::byte> page) {
                    extend(mark, page);
                    append(page);
                });
            });
            return mark;
        });
        together<bool>(ranks, [&] {
            if (is_first) writeNames(run, file, serial, marks);
            return true;
        });
    } catch (const IoError&) {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        if (is_first) std::filesystem::remove(sceneFile(file, serial), ignored);
        throw;
    }
    if (is_first) removeOthers(file, serial);
}

void writeWhole(const SceneRun& run, const std::filesystem::path& file) {
    replaceFile(file, run.save());
    removeOthers(file, std::nullopt);
}

/// What a file says that names the parts of a checkpoint.
struct Names {
    std::filesystem::path file;
    std::uint64_t serial = 0;
    std::uint64_t scene_size = 0;
    std::vector<PartMark> marks;
    SavedPart common;
};

Names readNames(const std::vector<std::byte>& bytes, const std::filesystem::path& file) {
    ByteReader in(bytes, FrameKind::checkpoint, file.string());
    Names names;
    names.file = file;
    names.common.source = file.string();
    names.serial = in.get<std::uint64_t>();
    names.scene_size = in.get<std::uint64_t>();
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        PartMark& mark = names.marks.emplace_back();
        mark.size = in.get<std::uint64_t>();
        mark.check = in.get<std::uint64_t>();
    }
    in.getArray(names.common.bytes);
    in.finish();
    return names;
}

[[noreturn]] void refusePart(const std::filesystem::path& part, const Names& names) {
    throw InputError(fmt::format("{} is not the part that '{}' names; copy file and folder of a checkpoint together",
                                 part.string(), names.file.string()));
}

/// Reads something of the folder. @throws IoError with the remedy
template <class Read>
auto readBeside(const Names& names, const Read& read) {
    try {
        return read();
    } catch (const IoError& error) {
        throw IoError(fmt::format("{}; it is a part of the checkpoint '{}': copy the folder beside it, too",
                                  error.what(), names.file.string()));
    }
}

SavedPart readPart(const Names& names, std::size_t rank) {
    const std::filesystem::path part = partFile(names.file, names.serial, rank);
    SavedPart read{readBeside(names, [&] { return readFile(part); }), part.string()};
    const PartMark mark = markOf(read.bytes);
    if (rank >= names.marks.size() || mark.size != names.marks[rank].size || mark.check != names.marks[rank].check) {
        refusePart(part, names);
    }
    return read;
}

SceneSource readSceneOf(const Names& names) {
    const std::filesystem::path file = sceneFile(names.file, names.serial);
    SceneSource source = readBeside(names, [&] { return readSceneSource(file); });
    if (std::filesystem::file_size(file) != names.scene_size) refusePart(file, names);
    return source;
}

}  // namespace

void writeCheckpoint(const SceneRun& run, const std::filesystem::path& file) {
    Ranks* ranks = run.world().ranks();
    if (ranks == nullptr) {
        writeWhole(run, file);
    } else if (run.world().isDivided()) {
        writeParts(run, file);
    } else {
        together<bool>(*ranks, [&] {
            if (ranks->rank() == 0) writeWhole(run, file);
            return true;
        });
    }
}

SceneRun readCheckpoint(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = readFile(file);
    if (frameKind(bytes) != FrameKind::checkpoint) return SceneRun::restore(bytes, file.string());
    const Names names = readNames(bytes, file);
    return SceneRun::restoreParts(readSceneOf(names), names.common,
                                  [&](std::size_t rank) { return readPart(names, rank); });
}

SceneRun readCheckpoint(const std::filesystem::path& file, Ranks& ranks, const Partition& partition) {
    const std::vector<std::byte> bytes = readFile(file);
    if (frameKind(bytes) != FrameKind::checkpoint) {
        SceneRun run = SceneRun::restore(bytes, file.string());
        run.world().share(ranks, partition);
        return run;
    }
    const Names names = readNames(bytes, file);
    return SceneRun::restoreParts(
        readSceneOf(names), names.common, [&](std::size_t rank) { return readPart(names, rank); }, ranks, partition);
}

}  // namespace cairn
