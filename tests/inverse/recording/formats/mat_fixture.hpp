#pragma once
// MATLAB files as MVIEW writes them, made through matio.

#include <matio.h>

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {

class MatFiles : public Formats {
 protected:
  struct Phone {
    std::string label;
    double first, last;
  };
  static matvar_t* number(double value) {
    size_t dims[2] = {1, 1};
    return Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, &value, 0);
  }
  static matvar_t* nothing() {
    size_t dims[2] = {0, 0};
    return Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, nullptr, 0);
  }
  static matvar_t* text(std::string value) {
    size_t dims[2] = {1, value.size()};
    return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2, dims, value.data(), 0);
  }
  /// Column after column, as MVIEW keeps it: in single precision.
  static matvar_t* matrix(const char* name, size_t rows, size_t columns,
                          std::vector<float> values) {
    size_t dims[2] = {rows, columns};
    return Mat_VarCreate(name, MAT_C_SINGLE, MAT_T_SINGLE, 2, dims, values.data(), 0);
  }
  static matvar_t* phones(const std::vector<Phone>& list) {
    const char* fields[] = {"LABEL", "OFFS", nullptr};
    size_t dims[2] = {1, list.size()};
    matvar_t* v = Mat_VarCreateStruct2(nullptr, 2, dims, fields);
    for (size_t k = 0; k < list.size(); ++k) {
      size_t two[2] = {1, 2};
      double times[2] = {list[k].first, list[k].last};
      Mat_VarSetStructFieldByName(v, "LABEL", k, text(list[k].label));
      Mat_VarSetStructFieldByName(
          v, "OFFS", k, Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, two, times, 0));
    }
    return v;
  }
  struct Element {
    std::string name;
    double rate;
    size_t columns;
    std::vector<float> signal;
  };
  /// A file with one variable `take`: sound with the phones, then the elements.
  std::string mview(const std::string& name, mat_ft version, const std::vector<Element>& elements,
                    const std::vector<Phone>& spoken = {}) {
    const char* fields[] = {"NAME", "SRATE", "SIGNAL", "PHONES", nullptr};
    size_t dims[2] = {1, elements.size() + 1};
    matvar_t* array = Mat_VarCreateStruct2("take", 2, dims, fields);
    const auto set = [&](const char* field, size_t k, matvar_t* v) {
      Mat_VarSetStructFieldByName(array, field, k, v);
    };
    set("NAME", 0, text("AUDIO")), set("SRATE", 0, number(44100));
    set("SIGNAL", 0, matrix(nullptr, 100, 1, std::vector<float>(100, 0.5f)));
    set("PHONES", 0, spoken.empty() ? nothing() : phones(spoken));
    for (size_t k = 0; k < elements.size(); ++k) {
      const Element& e = elements[k];
      set("PHONES", k + 1, nothing());
      set("NAME", k + 1, text(e.name)), set("SRATE", k + 1, number(e.rate));
      set("SIGNAL", k + 1, matrix(nullptr, e.signal.size() / e.columns, e.columns, e.signal));
    }
    return saved(name, version, {array});
  }
  std::string saved(const std::string& name, mat_ft version, const std::vector<matvar_t*>& values) {
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    std::filesystem::remove(path);
    mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
    for (matvar_t* v : values) {
      // matio 1.5 cannot read arrays of structures again that it compressed itself.
      EXPECT_EQ(Mat_VarWrite(file, v, MAT_COMPRESSION_NONE), 0);
      Mat_VarFree(v);
    }
    Mat_Close(file);
    return path;
  }
  static std::string bytes_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

}  // namespace genio
