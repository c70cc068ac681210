#include "record/attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "cairn/types.h"

namespace cairn::hdf5 {

namespace {

DataType textType(std::size_t size, const std::filesystem::path& path) {
    DataType type(H5Tcopy(H5T_C_S1), path, "a text type cannot be made");
    checked(H5Tset_size(type.get(), std::max<std::size_t>(size, 1)), path, "a text type cannot be made");
    checked(H5Tset_cset(type.get(), H5T_CSET_UTF8), path, "a text type cannot be made");
    checked(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), path, "a text type cannot be made");
    return type;
}

/// A switch as h5py writes and reads it: an enumeration of FALSE and TRUE.
DataType switchType(const std::filesystem::path& path) {
    DataType type(H5Tenum_create(H5T_STD_I8LE), path, "a switch type cannot be made");
    std::int8_t value = 0;
    checked(H5Tenum_insert(type.get(), "FALSE", &value), path, "a switch type cannot be made");
    value = 1;
    checked(H5Tenum_insert(type.get(), "TRUE", &value), path, "a switch type cannot be made");
    return type;
}

void write(hid_t object, const std::filesystem::path& path, const char* name, hid_t file_type, hid_t memory_type,
           const void* value) {
    const DataSpace space(H5Screate(H5S_SCALAR), path, name);
    const Attribute attribute(H5Acreate2(object, name, file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT), path, name);
    checked(H5Awrite(attribute.get(), memory_type, value), path, name);
}

std::string withoutPadding(std::string text) {
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
}

std::string toText(const SettingValue& value) {
    return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

herr_t collectName(hid_t, const char* name, const H5A_info_t*, void* out) {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
}

}  // namespace

void writeAttribute(hid_t object, const std::filesystem::path& path, const char* name, const SettingValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        const DataType type = textType(text->size(), path);
        write(object, path, name, type.get(), type.get(), text->c_str());
    } else if (const auto* number = std::get_if<double>(&value)) {
        write(object, path, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, number);
    } else if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        write(object, path, name, H5T_STD_I64LE, H5T_NATIVE_INT64, whole);
    } else {
        const std::int8_t on = std::get<bool>(value) ? 1 : 0;
        const DataType type = switchType(path);
        write(object, path, name, type.get(), type.get(), &on);
    }
}

std::optional<SettingValue> readAttribute(hid_t object, const std::filesystem::path& path, const char* name) {
    if (H5Aexists(object, name) <= 0) return std::nullopt;
    const Attribute attribute(H5Aopen(object, name, H5P_DEFAULT), path, name);
    const DataType type(H5Aget_type(attribute.get()), path, name);
    const DataSpace space(H5Aget_space(attribute.get()), path, name);
    if (H5Sget_simple_extent_npoints(space.get()) != 1) return std::nullopt;
    switch (H5Tget_class(type.get())) {
        case H5T_FLOAT: {
            double number = 0;
            checked(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &number), path, name);
            return number;
        }
        case H5T_INTEGER: {
            std::int64_t whole = 0;
            checked(H5Aread(attribute.get(), H5T_NATIVE_INT64, &whole), path, name);
            return whole;
        }
        case H5T_ENUM: {
            std::int8_t on = 0;
            if (H5Tget_size(type.get()) != 1) return std::nullopt;
            checked(H5Aread(attribute.get(), type.get(), &on), path, name);
            return on != 0;
        }
        case H5T_STRING: {
            if (H5Tis_variable_str(type.get()) != 0) return std::nullopt;
            std::string text(H5Tget_size(type.get()), '\0');
            checked(H5Aread(attribute.get(), type.get(), text.data()), path, name);
            return withoutPadding(std::move(text));
        }
        default:
            return std::nullopt;
    }
}

std::vector<std::pair<std::string, std::string>> readAttributes(const Group& group, const std::filesystem::path& path) {
    std::vector<std::string> names;
    hsize_t position = 0;
    if (H5Aiterate2(group.get(), H5_INDEX_CRT_ORDER, H5_ITER_INC, &position, collectName, &names) < 0) {
        names.clear();
        position = 0;
        checked(H5Aiterate2(group.get(), H5_INDEX_NAME, H5_ITER_INC, &position, collectName, &names), path,
                "the attributes cannot be read");
    }
    std::vector<std::pair<std::string, std::string>> attributes;
    for (const std::string& name : names) {
        if (const auto value = readAttribute(group.get(), path, name.c_str())) {
            attributes.emplace_back(name, toText(*value));
        }
    }
    return attributes;
}

Group createGroup(const File& file, const std::filesystem::path& path, const char* name) {
    const Properties properties(H5Pcreate(H5P_GROUP_CREATE), path, name);
    checked(H5Pset_attr_creation_order(properties.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), path, name);
    return Group(H5Gcreate2(file.get(), name, H5P_DEFAULT, properties.get(), H5P_DEFAULT), path, name);
}

void writeText(const File& file, const std::filesystem::path& path, const char* name, const std::string& text) {
    const DataType type = textType(text.size(), path);
    const hsize_t one = 1;
    const DataSpace space(H5Screate_simple(1, &one, &one), path, name);
    const Properties properties(H5Pcreate(H5P_DATASET_CREATE), path, name);
    checked(H5Pset_chunk(properties.get(), 1, &one), path, name);
    checked(H5Pset_deflate(properties.get(), 6), path, name);
    const DataSet set(H5Dcreate2(file.get(), name, type.get(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                      path, name);
    checked(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), path, "cannot write");
}

std::string readText(const File& file, const std::filesystem::path& path, const char* name) {
    const DataSet set(H5Dopen2(file.get(), name, H5P_DEFAULT), path, name);
    const DataType type(H5Dget_type(set.get()), path, name);
    const DataSpace space(H5Dget_space(set.get()), path, name);
    if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
        H5Sget_simple_extent_npoints(space.get()) != 1) {
        throw IoError(fmt::format("{}: the data set '{}' is not a text", path.string(), name));
    }
    std::string text(H5Tget_size(type.get()), '\0');
    checked(H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), path,
            fmt::format("'{}' cannot be read", name));
    return withoutPadding(std::move(text));
}

}  // namespace cairn::hdf5
