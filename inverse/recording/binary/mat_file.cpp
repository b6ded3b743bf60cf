#include "inverse/recording/binary/mat_file.hpp"

#include <fmt/format.h>
#include <matio.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/base/unicode.hpp"
#include "inverse/recording/binary/own_process.hpp"

namespace genio {
namespace {

constexpr size_t most_numbers = 50'000'000, most_elements = 100'000, longest_column = 100'000;
constexpr int deepest = 5;

using Kind = DataTree::Kind;

/// Rows and columns; false where it has more dimensions or more elements than can be.
bool size_of(const matvar_t& v, DataTree& tree) {
  if (v.rank != 2 || !v.dims) return false;
  tree.rows = v.dims[0], tree.columns = v.dims[1];
  return tree.columns == 0 || tree.rows <= most_numbers / tree.columns;
}

template <class T>
void copy_numbers(const matvar_t& v, DataTree& tree) {
  const size_t count = tree.rows * tree.columns;
  if (size_t(v.data_size) != sizeof(T) || v.nbytes < count * sizeof(T)) return;
  tree.kind = Kind::numbers;
  if (tree.columns == 1 && tree.rows > longest_column) return;
  const auto* from = static_cast<const char*>(v.data);
  tree.numbers.reserve(count);
  for (size_t k = 0; k < count; ++k) {
    T value;
    std::memcpy(&value, from + k * sizeof(T), sizeof(T));
    tree.numbers.push_back(double(value));
  }
}

void take_numbers(const matvar_t& v, DataTree& tree) {
  if (v.isComplex) return;
  switch (v.class_type) {
    case MAT_C_DOUBLE:
      return copy_numbers<double>(v, tree);
    case MAT_C_SINGLE:
      return copy_numbers<float>(v, tree);
    case MAT_C_INT8:
      return copy_numbers<int8_t>(v, tree);
    case MAT_C_UINT8:
      return copy_numbers<uint8_t>(v, tree);
    case MAT_C_INT16:
      return copy_numbers<int16_t>(v, tree);
    case MAT_C_UINT16:
      return copy_numbers<uint16_t>(v, tree);
    case MAT_C_INT32:
      return copy_numbers<int32_t>(v, tree);
    case MAT_C_UINT32:
      return copy_numbers<uint32_t>(v, tree);
    case MAT_C_INT64:
      return copy_numbers<int64_t>(v, tree);
    case MAT_C_UINT64:
      return copy_numbers<uint64_t>(v, tree);
    default:
      return;
  }
}

/// One line of text, in bytes or in units of UTF-16.
void take_text(const matvar_t& v, DataTree& tree) {
  if (tree.rows > 1) return;
  const auto* bytes = static_cast<const char*>(v.data);
  if (v.data_type == MAT_T_UINT16 || v.data_type == MAT_T_UTF16) {
    std::string text = "\xFF\xFE";
    text.append(bytes, v.nbytes / 2 * 2);
    tree.text = utf8_of(text);
  } else if (v.data_type == MAT_T_UINT8 || v.data_type == MAT_T_INT8 || v.data_type == MAT_T_UTF8) {
    const std::string text(bytes, v.nbytes);
    tree.text = is_utf8(text) ? text : utf8_of_latin1(text);
  } else {
    return;
  }
  tree.kind = Kind::text;
  while (!tree.text.empty() && (tree.text.back() == '\0' || tree.text.back() == ' '))
    tree.text.pop_back();
}

DataTree tree_of(matvar_t* v, const std::string& name, int depth);

void take_structs(matvar_t* v, DataTree& tree, int depth) {
  const unsigned fields = Mat_VarGetNumberOfFields(v);
  char* const* names = Mat_VarGetStructFieldnames(v);
  if (fields == 0 || fields > most_elements || !names) return;
  tree.kind = Kind::list;
  for (size_t k = 0; k < tree.rows * tree.columns; ++k) {
    DataTree& record = tree.children.emplace_back();
    record.kind = Kind::record;
    for (unsigned f = 0; f < fields; ++f)
      if (names[f])
        record.children.push_back(
            tree_of(Mat_VarGetStructFieldByIndex(v, f, k), names[f], depth + 2));
  }
}

DataTree tree_of(matvar_t* v, const std::string& name, int depth) {
  DataTree tree;
  tree.name = is_utf8(name) ? name : utf8_of_latin1(name);
  if (!v || depth > deepest || !size_of(*v, tree) || !v->data) return tree;
  const bool few = tree.rows * tree.columns <= most_elements;
  if (v->class_type == MAT_C_STRUCT && few) take_structs(v, tree, depth);
  else if (v->class_type == MAT_C_CELL && few) {
    tree.kind = Kind::list;
    for (size_t k = 0; k < tree.rows * tree.columns; ++k)
      tree.children.push_back(tree_of(Mat_VarGetCell(v, int(k)), "", depth + 1));
  } else if (v->class_type == MAT_C_CHAR) take_text(*v, tree);
  else take_numbers(*v, tree);
  return tree;
}

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

bool is_wanted(const matvar_t& v) {
  DataTree size;
  return v.class_type != MAT_C_SPARSE && v.class_type != MAT_C_FUNCTION &&
         v.class_type != MAT_C_OBJECT && v.class_type != MAT_C_OPAQUE && size_of(v, size);
}

}  // namespace

DataTree mat_file_tree(const std::string& path) {
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_Open(path.c_str(), MAT_ACC_RDONLY),
                                                          Mat_Close);
  if (!file) throw InputError(path + ": is no MATLAB file; expected one of v4 to v7.3");
  DataTree all;
  all.kind = Kind::record;
  std::vector<std::pair<std::string, bool>> names;
  for (;;) {
    const Variable info(Mat_VarReadNextInfo(file.get()), Mat_VarFree);
    if (!info || names.size() > most_elements) break;
    if (info->name) names.emplace_back(info->name, is_wanted(*info));
  }
  if (names.empty()) throw InputError(path + ": holds no variable that can be read; is it broken?");
  for (const auto& [name, wanted] : names) {
    const Variable read(wanted ? Mat_VarRead(file.get(), name.c_str()) : nullptr, Mat_VarFree);
    if (wanted && !read)
      throw InputError(fmt::format("{}: its variable {} cannot be read; is it cut short?", path,
                                   in_quotes(name)));
    all.children.push_back(tree_of(read.get(), name, 1));
  }
  return all;
}

DataTree read_mat_file(const std::string& path) {
  std::error_code e;
  if (!std::filesystem::is_regular_file(path, e)) throw InputError(path + ": no such file");
  return unpacked(in_own_process(path, [&] { return packed(mat_file_tree(path)); }));
}

}  // namespace genio
