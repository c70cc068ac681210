/// @file Data sets with one row per frame.
#pragma once

#include <filesystem>
#include <vector>

#include "record/hdf5_handle.h"

namespace cairn::hdf5 {

enum class Element { real, integer, flag };  ///< double, std::int64_t, std::uint8_t
enum class Storage {
    plain,       ///< numbers of a frame: chunks of many frames, rewritten in place
    compressed,  ///< one entry per body: a compressed chunk per frame, written once
    rows         ///< any number of rows per frame, one after the other: chunks of many rows
};

/// How a series is stored.
struct SeriesShape {
    const char* name;          ///< path of the data set
    const char* unit;          ///< SI unit, kept as an attribute
    Element element;           ///< of memory and, in little-endian order, of the file
    Storage storage;           ///< how its chunks are kept
    std::vector<hsize_t> row;  ///< extents of a frame's part; empty = a number
};

/// An extensible data set [frame × row] that is written.
class SeriesWriter {
  public:
    /// @param path of the file, for messages; must outlive the writer @throws IoError
    SeriesWriter(const File& file, const std::filesystem::path& path, const SeriesShape& shape);
    /// Writes a row. @param frame its index, one behind the last @param values as many as a row has @throws IoError
    void append(hsize_t frame, const void* values) { appendRows(frame, 1, values); }
    /// Writes rows. @param first index of the first, one behind the last @throws IoError
    void appendRows(hsize_t first, hsize_t count, const void* values);
    /// Hands everything to the operating system. @throws IoError
    void flush();
    void close() { set_.close(); }

  private:
    const std::filesystem::path* path_;
    SeriesShape shape_;
    DataSet set_;
};

/// The same, read.
class SeriesReader {
  public:
    /// @param path as above @throws IoError if it is missing or has another shape
    SeriesReader(const File& file, const std::filesystem::path& path, const SeriesShape& shape);
    hsize_t frames() const { return frames_; }
    /// @throws IoError if it cannot be read
    void read(hsize_t frame, void* values) const { readRows(frame, 1, values); }
    /// Reads rows. @throws IoError if they are not there or cannot be read
    void readRows(hsize_t first, hsize_t count, void* values) const;
    /// Reads all frames of a series of numbers. @param values frames() of them @throws IoError
    void readAll(void* values) const;
    /// Where the frame's values end in the file [bytes]; 0 if they were never written. @throws IoError
    haddr_t endInFile(hsize_t frame) const;

  private:
    const std::filesystem::path* path_;
    SeriesShape shape_;
    DataSet set_;
    hsize_t frames_ = 0;
    std::vector<hsize_t> chunk_;
};

}  // namespace cairn::hdf5
