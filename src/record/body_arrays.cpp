/// @file Bodies of scenes that stand in HDF5 files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/recording.h"
#include "record/file_check.h"
#include "record/hdf5_handle.h"
#include "scene/scaled_shape.h"
#include "scene/scene_reading.h"

namespace cairn {

namespace {

using hdf5::checked;

/// Bodies that are read at a time.
constexpr hsize_t slice = 4096;

/// An array of numbers with one row per body, a slice of which is in memory.
class BodyArray {
  public:
    /// @param path of the file, for messages; must outlive it @param name of the data set @param columns numbers of a
    /// row
    BodyArray(const hdf5::File& file, const std::filesystem::path& path, std::string name, hsize_t columns)
        : path_(&path),
          name_(std::move(name)),
          columns_(columns),
          set_(H5Dopen2(file.get(), name_.c_str(), H5P_DEFAULT), path, fmt::format("'{}' cannot be opened", name_)) {
        const hdf5::DataType type(H5Dget_type(set_.get()), path, name_);
        const hdf5::DataSpace space(H5Dget_space(set_.get()), path, name_);
        std::array<hsize_t, 2> extents{0, 1};
        const int rank = columns == 1 ? 1 : 2;
        const H5T_class_t kind = H5Tget_class(type.get());
        const bool sound =
            (kind == H5T_FLOAT || kind == H5T_INTEGER) && H5Sget_simple_extent_ndims(space.get()) == rank &&
            H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr) >= 0 && extents[1] == columns;
        if (!sound) {
            throw InputError(fmt::format("{}: '{}' must be an array of numbers with {} for each body", path.string(),
                                         name_, columns == 1 ? "one" : fmt::format("a row of {}", columns)));
        }
        rows_ = extents[0];
    }

    hsize_t rows() const { return rows_; }
    const std::string& name() const { return name_; }
    /// The numbers of a body. @pre body < rows(), and as large as the last or larger
    const double* row(hsize_t body) {
        if (body >= first_ + slice || values_.empty()) read(body);
        return values_.data() + (body - first_) * columns_;
    }

  private:
    void read(hsize_t first) {
        first_ = first;
        const std::array<hsize_t, 2> start{first, 0};
        const std::array<hsize_t, 2> count{std::min(slice, rows_ - first), columns_};
        values_.resize(count[0] * columns_);
        const hdf5::DataSpace source(H5Dget_space(set_.get()), *path_, name_);
        const hdf5::DataSpace memory(H5Screate_simple(2, count.data(), nullptr), *path_, name_);
        checked(H5Sselect_hyperslab(source.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), *path_,
                name_);
        checked(H5Dread(set_.get(), H5T_NATIVE_DOUBLE, memory.get(), source.get(), H5P_DEFAULT, values_.data()), *path_,
                fmt::format("'{}' cannot be read", name_));
    }

    const std::filesystem::path* path_;
    std::string name_;
    hsize_t columns_;
    hdf5::DataSet set_;
    hsize_t rows_ = 0;
    hsize_t first_ = 0;           ///< of the slice
    std::vector<double> values_;  ///< of the slice
};

Vec3 vectorIn(const double* row) {
    return {row[0], row[1], row[2]};
}

/// The arrays of bodies that have one template.
class BodyGroup {
  public:
    BodyGroup(const hdf5::File& file, const std::filesystem::path& path, const std::string& group)
        : position_(file, path, group + "/position", 3) {
        const auto open = [&](const char* name, hsize_t columns, std::optional<BodyArray>& array) {
            const std::string full = group + "/" + name;
            if (H5Lexists(file.get(), full.c_str(), H5P_DEFAULT) <= 0) return;
            array.emplace(file, path, full, columns);
            if (array->rows() == position_.rows()) return;
            throw InputError(fmt::format("{}: '{}' is of {} bodies, but '{}' of {}; give both as many rows",
                                         path.string(), full, array->rows(), position_.name(), position_.rows()));
        };
        open("orientation", 4, orientation_);
        open("linear_velocity", 3, linear_velocity_);
        open("angular_velocity", 3, angular_velocity_);
        open("scale", 1, scale_);
    }

    void tell(const SceneBody& like, const SceneSource::Take& take) {
        SceneBody body = like;
        for (hsize_t i = 0; i < position_.rows(); ++i) {
            body.position = vectorIn(position_.row(i));
            if (orientation_) {
                const double* q = orientation_->row(i);
                body.orientation = Quat(q[0], q[1], q[2], q[3]);
            }
            if (linear_velocity_) body.linear_velocity = vectorIn(linear_velocity_->row(i));
            if (angular_velocity_) body.angular_velocity = vectorIn(angular_velocity_->row(i));
            if (scale_) body.shape = scaledOf(like.shape, i);
            take(body);
        }
    }
    bool isScaled() const { return scale_.has_value(); }

  private:
    Shape scaledOf(const Shape& shape, hsize_t body) {
        try {
            return scaledShape(shape, *scale_->row(body));
        } catch (const InputError& error) {
            throw InputError(fmt::format("row {} of '{}': {}", body, scale_->name(), error.what()));
        }
    }

    BodyArray position_;
    std::optional<BodyArray> orientation_, linear_velocity_, angular_velocity_, scale_;
};

herr_t collectGroup(hid_t, const char* name, const H5L_info_t*, void* names) {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
}

/// Names of the groups, sorted.
std::vector<std::string> groupsIn(const hdf5::File& file, const std::filesystem::path& path) {
    std::vector<std::string> names;
    hsize_t at = 0;
    checked(H5Literate(file.get(), H5_INDEX_NAME, H5_ITER_INC, &at, collectGroup, &names), path,
            "its groups cannot be read");
    return names;
}

hdf5::File openArrays(const std::filesystem::path& path) {
    checkFile(path);
    return hdf5::File(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), path, "cannot be opened");
}

/// What the bodies of a group have in common. @throws InputError
const SceneBody& templateOf(const std::string& group, const BodyGroup& arrays, const ByName<BodyTemplate>& templates,
                            const std::filesystem::path& path) {
    const auto refuse = [&](std::string_view what) {
        throw InputError(fmt::format("{}: the group '{}' {}", path.string(), group, what));
    };
    const auto found = templates.find(group);
    if (found == templates.end()) {
        refuse(fmt::format("has the name of no template of a body; {}", knownNames(templates, "templates")));
    }
    const SceneBody& body = found->second.body;
    if (!found->second.has_shape || body.material.empty()) refuse("needs a template with a shape and a material");
    if (arrays.isScaled() && (body.mass || body.inertia || body.centre_of_mass)) {
        refuse("has a scale, but its template a mass, an inertia or a centre of mass; leave them to the density");
    }
    return body;
}

}  // namespace

SceneSource readSceneSource(const std::filesystem::path& file, const std::filesystem::path& bodies) {
    auto scene = std::make_shared<const SceneWithTemplates>(readWithTemplates(file));
    if (!scene->source.isTold()) {
        throw InputError(fmt::format(
            "{}: has includes, springs, joints, drives, exceptions or events with a body, and so cannot take "
            "bodies from '{}'; remove them",
            file.string(), bodies.string()));
    }
    const auto tell = [scene, bodies](const SceneSource::Take& take) {
        const hdf5::QuietErrors quiet;
        scene->source.forEachBody(take);
        const hdf5::File arrays = openArrays(bodies);
        for (const std::string& name : groupsIn(arrays, bodies)) {
            BodyGroup group(arrays, bodies, name);
            group.tell(templateOf(name, group, scene->templates, bodies), take);
        }
    };
    return {scene->source.scene(), tell};
}

}  // namespace cairn
