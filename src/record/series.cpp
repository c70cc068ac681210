#include "record/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cairn/types.h"
#include "record/attributes.h"

namespace cairn::hdf5 {

namespace {

constexpr hsize_t frames_per_plain_chunk = 128;
constexpr hsize_t rows_per_chunk = 4096;
/// A compromise: the higher levels take several times as long for a few per cent.
constexpr unsigned deflate_level = 2;

hid_t memoryType(Element element) {
    switch (element) {
        case Element::real:
            return H5T_NATIVE_DOUBLE;
        case Element::integer:
            return H5T_NATIVE_INT64;
        default:
            return H5T_NATIVE_UINT8;
    }
}

hid_t fileType(Element element) {
    switch (element) {
        case Element::real:
            return H5T_IEEE_F64LE;
        case Element::integer:
            return H5T_STD_I64LE;
        default:
            return H5T_STD_U8LE;
    }
}

std::vector<hsize_t> prepend(hsize_t first, const std::vector<hsize_t>& row) {
    std::vector<hsize_t> all{first};
    all.insert(all.end(), row.begin(), row.end());
    return all;
}

DataSpace makeSpace(const std::vector<hsize_t>& extents, const std::vector<hsize_t>& limits,
                    const std::filesystem::path& path) {
    return DataSpace(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), limits.data()), path,
                     "a data space cannot be made");
}

/// The part of a series that holds some rows. @param rows in all
DataSpace selectRows(hsize_t rows, hsize_t first, const std::vector<hsize_t>& count, const SeriesShape& shape,
                     const std::filesystem::path& path) {
    const std::vector<hsize_t> extents = prepend(rows, shape.row);
    DataSpace space = makeSpace(extents, extents, path);
    std::vector<hsize_t> start(extents.size(), 0);
    start[0] = first;
    // A row without bodies has nothing to select.
    const bool empty = std::find(count.begin(), count.end(), 0U) != count.end();
    checked(empty ? H5Sselect_none(space.get())
                  : H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
            path, shape.name);
    return space;
}

hsize_t rowsPerChunk(Storage storage) {
    switch (storage) {
        case Storage::plain:
            return frames_per_plain_chunk;
        case Storage::rows:
            return rows_per_chunk;
        default:
            return 1;
    }
}

}  // namespace

SeriesWriter::SeriesWriter(const File& file, const std::filesystem::path& path, const SeriesShape& shape)
    : path_(&path), shape_(shape) {
    const std::vector<hsize_t> extents = prepend(0, shape.row);
    std::vector<hsize_t> limits = extents;
    // HDF5 wants chunks of at least one element that fit into the limits, also for a scene without bodies.
    for (hsize_t& limit : limits) limit = std::max<hsize_t>(limit, 1);
    std::vector<hsize_t> chunk = limits;
    chunk[0] = rowsPerChunk(shape.storage);
    limits[0] = H5S_UNLIMITED;

    const Properties properties(H5Pcreate(H5P_DATASET_CREATE), path, shape.name);
    checked(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), path, shape.name);
    if (shape.storage == Storage::compressed) {
        checked(H5Pset_shuffle(properties.get()), path, shape.name);
        checked(H5Pset_deflate(properties.get(), deflate_level), path, shape.name);
    }
    if (shape.element == Element::real) {
        // What was never written must not look like a zero.
        const double missing = std::numeric_limits<double>::quiet_NaN();
        checked(H5Pset_fill_value(properties.get(), H5T_NATIVE_DOUBLE, &missing), path, shape.name);
    }
    const DataSpace space = makeSpace(extents, limits, path);
    set_ = DataSet(H5Dcreate2(file.get(), shape.name, fileType(shape.element), space.get(), H5P_DEFAULT,
                              properties.get(), H5P_DEFAULT),
                   path, shape.name);
    writeAttribute(set_.get(), path, "unit", std::string(shape.unit));
}

void SeriesWriter::appendRows(hsize_t first, hsize_t count, const void* values) {
    const std::vector<hsize_t> extents = prepend(first + count, shape_.row);
    checked(H5Dset_extent(set_.get(), extents.data()), *path_, shape_.name);
    const std::vector<hsize_t> rows = prepend(count, shape_.row);
    const DataSpace target = selectRows(first + count, first, rows, shape_, *path_);
    if (H5Sget_select_npoints(target.get()) == 0) return;
    const DataSpace memory = makeSpace(rows, rows, *path_);
    checked(H5Dwrite(set_.get(), memoryType(shape_.element), memory.get(), target.get(), H5P_DEFAULT, values), *path_,
            "cannot write");
}

void SeriesWriter::flush() {
    checked(H5Dflush(set_.get()), *path_, "cannot write");
}

SeriesReader::SeriesReader(const File& file, const std::filesystem::path& path, const SeriesShape& shape)
    : path_(&path), shape_(shape), set_(H5Dopen2(file.get(), shape.name, H5P_DEFAULT), path, shape.name) {
    const DataSpace space(H5Dget_space(set_.get()), path, shape.name);
    const Properties properties(H5Dget_create_plist(set_.get()), path, shape.name);
    const std::size_t rank = shape.row.size() + 1;
    std::vector<hsize_t> extents(rank);
    chunk_.resize(rank);
    const bool right_rank = H5Sget_simple_extent_ndims(space.get()) == static_cast<int>(rank) &&
                            H5Pget_layout(properties.get()) == H5D_CHUNKED &&
                            H5Pget_chunk(properties.get(), static_cast<int>(rank), chunk_.data()) > 0 &&
                            H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr) > 0;
    if (!right_rank || !std::equal(shape.row.begin(), shape.row.end(), extents.begin() + 1)) {
        throw IoError(
            fmt::format("{}: the data set '{}' has not the shape that the scene asks for", path.string(), shape.name));
    }
    frames_ = extents[0];
}

void SeriesReader::readRows(hsize_t first, hsize_t count, void* values) const {
    if (first + count > frames_ || first + count < first) {
        throw IoError(fmt::format("{}: the data set '{}' has {} rows, fewer than the recording says", path_->string(),
                                  shape_.name, frames_));
    }
    const std::vector<hsize_t> rows = prepend(count, shape_.row);
    const DataSpace source = selectRows(frames_, first, rows, shape_, *path_);
    if (H5Sget_select_npoints(source.get()) == 0) return;
    const DataSpace memory = makeSpace(rows, rows, *path_);
    checked(H5Dread(set_.get(), memoryType(shape_.element), memory.get(), source.get(), H5P_DEFAULT, values), *path_,
            fmt::format("'{}' of frame {} cannot be read", shape_.name, first));
}

void SeriesReader::readAll(void* values) const {
    if (frames_ == 0) return;
    checked(H5Dread(set_.get(), memoryType(shape_.element), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), *path_,
            fmt::format("'{}' cannot be read", shape_.name));
}

haddr_t SeriesReader::endInFile(hsize_t frame) const {
    std::vector<hsize_t> offset(chunk_.size(), 0);
    offset[0] = frame / chunk_[0] * chunk_[0];
    haddr_t address = HADDR_UNDEF;
    hsize_t size = 0;
    checked(H5Dget_chunk_info_by_coord(set_.get(), offset.data(), nullptr, &address, &size), *path_,
            fmt::format("'{}' of frame {} cannot be found", shape_.name, frame));
    return address == HADDR_UNDEF ? 0 : address + size;
}

}  // namespace cairn::hdf5
