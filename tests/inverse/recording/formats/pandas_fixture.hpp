#pragma once
// HDF5 files as pandas and PyTables write them for DeepLabCut, made through HDF5's own calls.

#include <hdf5.h>

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {

class PandasFiles : public Formats {
 protected:
  struct Column {
    std::string part, coordinate;
  };
  static hid_t text_type(size_t size) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, size);
    return type;
  }
  static void attribute(hid_t object, const char* name, const std::string& text) {
    const hid_t type = text_type(text.size()), one = H5Screate(H5S_SCALAR);
    const hid_t a = H5Acreate2(object, name, type, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(a, type, text.data());
    H5Aclose(a), H5Sclose(one), H5Tclose(type);
  }
  static void attribute(hid_t object, const char* name, long value) {
    const hid_t one = H5Screate(H5S_SCALAR);
    const hid_t a = H5Acreate2(object, name, H5T_STD_I64LE, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(a, H5T_NATIVE_LONG, &value);
    H5Aclose(a), H5Sclose(one);
  }
  static void truth(hid_t object, const char* name) {
    const unsigned char yes = 1;
    const hid_t one = H5Screate(H5S_SCALAR);
    const hid_t a = H5Acreate2(object, name, H5T_STD_B8LE, one, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(a, H5T_STD_B8LE, &yes);
    H5Aclose(a), H5Sclose(one);
  }
  static hid_t array(hid_t group, const std::string& name, hid_t type,
                     const std::vector<hsize_t>& size, hid_t memory, const void* data) {
    const hid_t space = H5Screate_simple(int(size.size()), size.data(), nullptr);
    const hid_t set =
        H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    H5Sclose(space);
    return set;
  }
  static void texts(hid_t group, const std::string& name, const std::vector<std::string>& all) {
    constexpr size_t size = 24;
    std::string bytes;
    for (std::string text : all) text.resize(size, '\0'), bytes += text;
    const hid_t type = text_type(size);
    H5Dclose(array(group, name, type, {all.size()}, type, bytes.data()));
    H5Tclose(type);
  }
  /// Titles of three levels: numbers of each level's sorted texts.
  static void titles(hid_t group, const std::string& axis, const std::vector<Column>& columns) {
    attribute(group, (axis + "_nlevels").c_str(), 3);
    for (int level = 0; level < 3; ++level) {
      const auto text = [&](const Column& c) {
        return level == 0 ? std::string("DLC") : level == 1 ? c.part : c.coordinate;
      };
      std::set<std::string> sorted;
      for (const Column& c : columns) sorted.insert(text(c));
      std::vector<signed char> places;
      for (const Column& c : columns)
        places.push_back(
            static_cast<signed char>(std::distance(sorted.begin(), sorted.find(text(c)))));
      texts(group, fmt::format("{}_level{}", axis, level), {sorted.begin(), sorted.end()});
      H5Dclose(array(group, fmt::format("{}_label{}", axis, level), H5T_STD_I8LE, {columns.size()},
                     H5T_NATIVE_SCHAR, places.data()));
    }
  }
  std::string path_of(const std::string& name) {
    std::filesystem::create_directories(folder);
    return (folder / name).string();
  }
  /// pandas' format "fixed"; rows are named by `images`, or counted from 0.
  std::string fixed(const std::string& name, const std::vector<Column>& columns,
                    const std::vector<double>& values,
                    const std::vector<std::string>& images = {}) {
    const size_t rows = values.size() / columns.size();
    const hid_t file = H5Fcreate(path_of(name).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t group = H5Gcreate2(file, "df_with_missing", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    attribute(group, "pandas_type", "frame"), attribute(group, "nblocks", 1);
    titles(group, "axis0", columns), titles(group, "block0_items", columns);
    std::vector<long> index;
    for (size_t r = 0; r < rows; ++r) index.push_back(long(r));
    if (!images.empty()) texts(group, "axis1", images);
    else H5Dclose(array(group, "axis1", H5T_STD_I64LE, {rows}, H5T_NATIVE_LONG, index.data()));
    const hid_t set = array(group, "block0_values", H5T_IEEE_F64LE, {rows, columns.size()},
                            H5T_NATIVE_DOUBLE, values.data());
    truth(set, "transposed");
    H5Dclose(set), H5Gclose(group), H5Fclose(file);
    return path_of(name);
  }
  /// As Python pickles titles with protocol 0, each text once.
  static std::string pickled(const std::vector<Column>& columns) {
    std::string text = "(lp0\n";
    std::map<std::string, int> known;
    int memos = 0;
    const auto put = [&](const std::string& word) {
      if (known.contains(word)) text += fmt::format("g{}\n", known[word]);
      else text += fmt::format("V{}\np{}\n", word, known[word] = ++memos);
    };
    for (const Column& c : columns) {
      text += "(";
      put("DLC"), put(c.part), put(c.coordinate);
      text += fmt::format("tp{}\na", ++memos);
    }
    return text + ".";
  }
  /// pandas' format "table".
  std::string records(const std::string& name, const std::vector<Column>& columns,
                      const std::vector<double>& values, const std::string& titles_pickled) {
    const size_t rows = values.size() / columns.size();
    const hsize_t width = columns.size();
    const hid_t file = H5Fcreate(path_of(name).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t group = H5Gcreate2(file, "df_with_missing", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    attribute(group, "pandas_type", "frame_table");
    const hid_t block = H5Tarray_create2(H5T_IEEE_F64LE, 1, &width);
    const size_t size = sizeof(double) * (columns.size() + 1);
    const hid_t record = H5Tcreate(H5T_COMPOUND, size);
    H5Tinsert(record, "index", 0, H5T_STD_I64LE);
    H5Tinsert(record, "values_block_0", sizeof(double), block);
    std::string bytes;
    for (size_t r = 0; r < rows; ++r) {
      const long index = long(r);
      bytes.append(reinterpret_cast<const char*>(&index), sizeof index);
      bytes.append(reinterpret_cast<const char*>(values.data() + r * columns.size()),
                   columns.size() * sizeof(double));
    }
    const hid_t set = array(group, "table", record, {rows}, record, bytes.data());
    attribute(set, "values_block_0_kind", titles_pickled);
    H5Dclose(set), H5Tclose(record), H5Tclose(block), H5Gclose(group), H5Fclose(file);
    return path_of(name);
  }
};

}  // namespace genio
