#include "inverse/recording/binary/hdf5_values.hpp"

#include <fmt/format.h>

#include <cstring>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

constexpr hsize_t most_values = 50'000'000;
constexpr size_t longest_text = 4096;

HdfId dataset(hid_t place, const std::string& name, const std::string& path) {
  return {hdf_has(place, name) ? H5Dopen2(place, name.c_str(), H5P_DEFAULT) : -1, H5Dclose,
          fmt::format("{}: no dataset {}", path, in_quotes(name))};
}

HdfId type_of(hid_t set, const std::string& path) {
  return {H5Dget_type(set), H5Tclose, path + ": a dataset has no type"};
}

/// Rows and columns of a dataset, of which there are not too many.
std::pair<hsize_t, hsize_t> shape_of(hid_t set, const std::string& path) {
  const HdfId space(H5Dget_space(set), H5Sclose, path + ": a dataset has no size");
  hsize_t sizes[2] = {1, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, sizes, nullptr) != rank)
    throw InputError(path + ": expected arrays of one or two dimensions");
  if (sizes[1] > 0 && sizes[0] > most_values / sizes[1])
    throw InputError(fmt::format("{}: an array of {} by {} values; no recording is so large", path,
                                 sizes[0], sizes[1]));
  return {sizes[0], sizes[1]};
}

std::string cut_at_zero(const char* text, size_t size) { return {text, strnlen(text, size)}; }

/// Of a text, or of a record with nothing but that field.
HdfId memory_type(hid_t type, const std::string& field, size_t size, const std::string& path) {
  if (field.empty()) return {H5Tcopy(type), H5Tclose, path + ": no type of a text"};
  HdfId record(H5Tcreate(H5T_COMPOUND, size), H5Tclose, path + ": no type of a record");
  if (H5Tinsert(record, field.c_str(), 0, type) < 0) throw InputError(path + ": no such field");
  return record;
}

/// Texts of a dataset or of one field of it; `type` is that of the file.
std::vector<std::string> texts(hid_t set, hid_t type, const std::string& field,
                               const std::string& path) {
  const auto [rows, columns] = shape_of(set, path);
  if (columns != 1) throw InputError(path + ": expected one text a row");
  if (H5Tis_variable_str(type) > 0)
    throw InputError(path + ": texts of variable length; expected pandas' own");
  const size_t size = H5Tget_size(type);
  if (size == 0 || size > longest_text || rows > most_values / size)
    throw InputError(path + ": texts that are longer than any title");
  const HdfId memory = memory_type(type, field, size, path);
  std::vector<char> bytes(size_t(rows) * size);
  if (rows > 0 && H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    throw InputError(path + ": its texts cannot be read; is it cut short?");
  std::vector<std::string> result;
  for (size_t k = 0; k < rows; ++k) result.push_back(cut_at_zero(bytes.data() + k * size, size));
  return result;
}

}  // namespace

HdfId::HdfId(hid_t id, herr_t (*close)(hid_t), const std::string& where) : id_(id), close_(close) {
  if (id_ < 0) throw InputError(where);
}

bool hdf_has(hid_t place, const std::string& name) {
  return H5Lexists(place, name.c_str(), H5P_DEFAULT) > 0;
}

bool hdf_has_attribute(hid_t object, const std::string& name) {
  return H5Aexists(object, name.c_str()) > 0;
}

HdfNumbers hdf_numbers(hid_t place, const std::string& name, const std::string& path) {
  const HdfId set = dataset(place, name, path);
  const auto [rows, columns] = shape_of(set, path);
  HdfNumbers numbers{rows, columns, std::vector<double>(size_t(rows * columns))};
  if (!numbers.values.empty() &&
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.values.data()) < 0)
    throw InputError(
        fmt::format("{}: dataset {} holds no numbers that can be read", path, in_quotes(name)));
  return numbers;
}

bool hdf_is_text(hid_t place, const std::string& name, const std::string& path) {
  const HdfId set = dataset(place, name, path);
  return H5Tget_class(type_of(set, path)) == H5T_STRING;
}

std::vector<std::string> hdf_texts(hid_t place, const std::string& name, const std::string& path) {
  const HdfId set = dataset(place, name, path);
  const HdfId type = type_of(set, path);
  if (H5Tget_class(type) != H5T_STRING)
    throw InputError(fmt::format("{}: dataset {} holds no texts", path, in_quotes(name)));
  return texts(set, type, "", path);
}

std::string hdf_text_attribute(hid_t object, const std::string& name, const std::string& path) {
  const std::string where = fmt::format("{}: no attribute {}", path, in_quotes(name));
  const HdfId attribute(
      hdf_has_attribute(object, name) ? H5Aopen(object, name.c_str(), H5P_DEFAULT) : -1, H5Aclose,
      where);
  const HdfId type(H5Aget_type(attribute), H5Tclose, where);
  const HdfId space(H5Aget_space(attribute), H5Sclose, where);
  const size_t size = H5Tget_size(type);
  constexpr size_t longest = 1 << 24;
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || size > longest ||
      H5Sget_simple_extent_npoints(space) != 1)
    throw InputError(where + " of one text");
  std::string text(size, '\0');
  if (H5Aread(attribute, type, text.data()) < 0) throw InputError(where + " that can be read");
  return cut_at_zero(text.data(), text.size());
}

double hdf_number_attribute(hid_t object, const std::string& name, double absent) {
  if (!hdf_has_attribute(object, name)) return absent;
  const HdfId attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, name);
  const HdfId space(H5Aget_space(attribute), H5Sclose, name);
  const HdfId type(H5Aget_type(attribute), H5Tclose, name);
  if (H5Sget_simple_extent_npoints(space) != 1) return absent;
  if (H5Tget_class(type) == H5T_BITFIELD || H5Tget_class(type) == H5T_ENUM) {  // true or false
    unsigned char truth = 0;
    return H5Tget_size(type) == 1 && H5Aread(attribute, type, &truth) >= 0 ? truth : absent;
  }
  double value = absent;
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0) return absent;
  return value;
}

namespace {

/// The type of a field of a table of records.
HdfId field_type(hid_t table, const std::string& field, const std::string& path) {
  const HdfId record = type_of(table, path);
  const int k =
      H5Tget_class(record) == H5T_COMPOUND ? H5Tget_member_index(record, field.c_str()) : -1;
  return {k < 0 ? -1 : H5Tget_member_type(record, unsigned(k)), H5Tclose,
          fmt::format("{}: its table has no field {}", path, in_quotes(field))};
}

}  // namespace

bool hdf_field_is_text(hid_t table, const std::string& field, const std::string& path) {
  return H5Tget_class(field_type(table, field, path)) == H5T_STRING;
}

std::vector<std::string> hdf_field_texts(hid_t table, const std::string& field,
                                         const std::string& path) {
  return texts(table, field_type(table, field, path), field, path);
}

HdfNumbers hdf_field_numbers(hid_t table, const std::string& field, const std::string& path) {
  const HdfId in_file = field_type(table, field, path);
  hsize_t columns = 1;
  if (H5Tget_class(in_file) == H5T_ARRAY &&
      (H5Tget_array_ndims(in_file) != 1 || H5Tget_array_dims2(in_file, &columns) != 1))
    throw InputError(fmt::format("{}: field {} has several dimensions", path, in_quotes(field)));
  const hsize_t rows = shape_of(table, path).first;
  if (columns == 0 || rows > most_values / columns)
    throw InputError(path + ": its table is larger than any recording's");
  const HdfId numbers(H5Tget_class(in_file) == H5T_ARRAY
                          ? H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &columns)
                          : H5Tcopy(H5T_NATIVE_DOUBLE),
                      H5Tclose, path + ": no type of numbers");
  const HdfId memory(H5Tcreate(H5T_COMPOUND, size_t(columns) * sizeof(double)), H5Tclose,
                     path + ": no type of a record");
  HdfNumbers result{rows, columns, std::vector<double>(size_t(rows * columns))};
  if (H5Tinsert(memory, field.c_str(), 0, numbers) < 0 ||
      (rows > 0 && H5Dread(table, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()) < 0))
    throw InputError(fmt::format("{}: field {} of its table cannot be read; is it cut short?", path,
                                 in_quotes(field)));
  return result;
}

std::vector<std::string> hdf_fields(hid_t table, const std::string& path) {
  const HdfId record = type_of(table, path);
  if (H5Tget_class(record) != H5T_COMPOUND) throw InputError(path + ": its table has no records");
  std::vector<std::string> names;
  const int count = H5Tget_nmembers(record);
  for (int k = 0; k < count; ++k)
    if (char* name = H5Tget_member_name(record, unsigned(k))) {
      names.emplace_back(name);
      H5free_memory(name);
    }
  return names;
}

}  // namespace genio
