#include "inverse/recording/binary/pandas_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/binary/data_tree.hpp"
#include "inverse/recording/binary/hdf5_values.hpp"
#include "inverse/recording/binary/own_process.hpp"
#include "inverse/recording/binary/pickled_text.hpp"

namespace genio {
namespace {

using Titles = std::vector<std::vector<std::string>>;

constexpr size_t most_columns = 100'000, most_levels = 10;

/// "7" of a number of a frame.
std::string number_text(double value) {
  return value == std::floor(value) && std::abs(value) < 1e15 ? fmt::format("{:.0f}", value)
                                                              : fmt::format("{:g}", value);
}

std::vector<std::string> number_texts(const HdfNumbers& numbers) {
  std::vector<std::string> result;
  for (const double value : numbers.values) result.push_back(number_text(value));
  return result;
}

std::vector<std::string> texts_or_numbers(hid_t group, const std::string& name,
                                          const std::string& path) {
  return hdf_is_text(group, name, path) ? hdf_texts(group, name, path)
                                        : number_texts(hdf_numbers(group, name, path));
}

/// The titles of an axis: those of several levels stand as numbers of the levels' texts.
Titles axis_titles(hid_t group, const std::string& axis, const std::string& path) {
  const double levels = hdf_number_attribute(group, axis + "_nlevels", 1);
  Titles titles;
  if (!hdf_has(group, axis + "_level0")) {
    for (std::string& text : texts_or_numbers(group, axis, path)) titles.push_back({text});
    return titles;
  }
  if (!(levels >= 1 && levels <= most_levels))
    throw InputError(fmt::format("{}: {} levels of titles", path, levels));
  for (int k = 0; k < int(levels); ++k) {
    const auto texts = texts_or_numbers(group, fmt::format("{}_level{}", axis, k), path);
    const auto places = hdf_numbers(group, fmt::format("{}_label{}", axis, k), path).values;
    if (k == 0) titles.resize(places.size());
    if (places.size() != titles.size())
      throw InputError(fmt::format("{}: levels of {} differ in length", path, axis));
    for (size_t c = 0; c < places.size(); ++c) {
      if (!(places[c] >= 0 && places[c] < double(texts.size())))
        throw InputError(fmt::format("{}: {} refers to a title that there is not", path, axis));
      titles[c].push_back(texts[size_t(places[c])]);
    }
  }
  return titles;
}

std::string joined_by_slash(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "/") + part;
  return text;
}

/// The columns of one block go where their titles stand among the table's.
void place_block(PandasTable& table, const Titles& titles, const HdfNumbers& values,
                 const std::string& path) {
  if (values.columns != titles.size() || values.rows != table.rows.size())
    throw InputError(fmt::format("{}: a block of {} by {} values; expected {} rows and {} columns",
                                 path, values.rows, values.columns, table.rows.size(),
                                 titles.size()));
  for (size_t c = 0; c < titles.size(); ++c) {
    const auto place = std::find(table.titles.begin(), table.titles.end(), titles[c]);
    if (place == table.titles.end())
      throw InputError(fmt::format("{}: column {} is not among the table's", path,
                                   in_quotes(joined_by_slash(titles[c]))));
    for (size_t r = 0; r < values.rows; ++r)
      table.rows[r][size_t(place - table.titles.begin())] = values.values[r * values.columns + c];
  }
}

HdfNumbers transposed(const HdfNumbers& m) {
  HdfNumbers t{m.columns, m.rows, std::vector<double>(m.values.size())};
  for (size_t r = 0; r < m.rows; ++r)
    for (size_t c = 0; c < m.columns; ++c) t.values[c * m.rows + r] = m.values[r * m.columns + c];
  return t;
}

PandasTable fixed_table(hid_t group, const std::string& path) {
  PandasTable table;
  table.titles = axis_titles(group, "axis0", path);
  for (const auto& parts : axis_titles(group, "axis1", path))
    table.index.push_back(joined_by_slash(parts));
  const double blocks = hdf_number_attribute(group, "nblocks", 0);
  if (table.titles.size() > most_columns || !(blocks >= 0 && blocks <= most_columns))
    throw InputError(path + ": more columns than any recording has");
  table.rows.assign(table.index.size(), std::vector<double>(table.titles.size(), std::nan("")));
  for (int b = 0; b < int(blocks); ++b) {
    const std::string name = fmt::format("block{}_values", b);
    HdfNumbers values = hdf_numbers(group, name, path);
    const HdfId set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, path);
    if (hdf_number_attribute(set, "transposed", 0) == 0) values = transposed(values);
    place_block(table, axis_titles(group, fmt::format("block{}_items", b), path), values, path);
  }
  return table;
}

PandasTable record_table(hid_t group, const std::string& path) {
  PandasTable table;
  const HdfId records(hdf_has(group, "table") ? H5Dopen2(group, "table", H5P_DEFAULT) : -1,
                      H5Dclose, path + ": no dataset 'table'");
  table.index = hdf_field_is_text(records, "index", path)
                    ? hdf_field_texts(records, "index", path)
                    : number_texts(hdf_field_numbers(records, "index", path));
  table.rows.resize(table.index.size());
  for (const std::string& field : hdf_fields(records, path)) {
    if (field == "index") continue;
    const auto titles = pickled_titles(hdf_text_attribute(records, field + "_kind", path), path);
    const HdfNumbers values = hdf_field_numbers(records, field, path);
    if (values.columns != titles.size() || values.rows != table.rows.size())
      throw InputError(fmt::format("{}: {} columns of values and {} titles of them", path,
                                   values.columns, titles.size()));
    table.titles.insert(table.titles.end(), titles.begin(), titles.end());
    for (size_t r = 0; r < values.rows; ++r)
      table.rows[r].insert(table.rows[r].end(), values.values.begin() + long(r * values.columns),
                           values.values.begin() + long((r + 1) * values.columns));
  }
  return table;
}

/// Groups of the file that hold a data frame.
herr_t note_frame(hid_t file, const char* name, const H5L_info_t* link, void* names) {
  if (link->type != H5L_TYPE_HARD) return 0;
  const hid_t object = H5Oopen(file, name, H5P_DEFAULT);
  if (object < 0) return 0;
  if (H5Iget_type(object) == H5I_GROUP && hdf_has_attribute(object, "pandas_type"))
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  H5Oclose(object);
  return 0;
}

std::string frame_name(hid_t file, const std::string& path) {
  std::vector<std::string> names;
  H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, note_frame, &names);
  const std::string usual = "df_with_missing";
  if (std::find(names.begin(), names.end(), usual) != names.end()) return usual;
  if (names.size() == 1) return names.front();
  throw InputError(
      fmt::format("{}: {} data frames of pandas, none of them called {}; expected "
                  "DeepLabCut's",
                  path, names.size(), usual));
}

DataTree text_node(const std::string& text) {
  DataTree node;
  node.kind = DataTree::Kind::text, node.text = text;
  return node;
}

/// For the way between processes.
std::string packed_table(const PandasTable& table) {
  DataTree all, index, titles;
  for (const std::string& text : table.index) index.children.push_back(text_node(text));
  for (const auto& levels : table.titles) {
    DataTree& title = titles.children.emplace_back();
    for (const std::string& text : levels) title.children.push_back(text_node(text));
  }
  for (const auto& row : table.rows) all.numbers.insert(all.numbers.end(), row.begin(), row.end());
  if (!all.numbers.empty()) all.rows = table.rows.size(), all.columns = table.titles.size();
  all.children = {std::move(index), std::move(titles)};
  return packed(all);
}

PandasTable unpacked_table(const std::string& bytes) {
  const DataTree all = unpacked(bytes);
  PandasTable table;
  if (all.children.size() != 2) throw InputError("no table came back");
  for (const DataTree& text : all.children[0].children) table.index.push_back(text.text);
  for (const DataTree& title : all.children[1].children) {
    auto& levels = table.titles.emplace_back();
    for (const DataTree& text : title.children) levels.push_back(text.text);
  }
  const size_t columns = table.titles.size();
  if (all.numbers.size() != table.index.size() * columns)
    throw InputError("a table of another size came back");
  for (size_t r = 0; r < table.index.size(); ++r)
    table.rows.emplace_back(all.numbers.begin() + long(r * columns),
                            all.numbers.begin() + long((r + 1) * columns));
  return table;
}

}  // namespace

PandasTable pandas_file_table(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const HdfId file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
                   path + ": is no HDF5 file that can be read; is it cut short?");
  const std::string name = frame_name(file, path);
  const HdfId group(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose, path);
  const std::string type = hdf_text_attribute(group, "pandas_type", path);
  if (type == "frame") return fixed_table(group, path);
  if (type == "frame_table") return record_table(group, path);
  throw InputError(fmt::format("{}: pandas' {}; expected a data frame", path, in_quotes(type)));
}

PandasTable read_pandas_file(const std::string& path) {
  std::error_code e;
  if (!std::filesystem::is_regular_file(path, e)) throw InputError(path + ": no such file");
  return unpacked_table(in_own_process(path, [&] {
    setenv("HDF5_PLUGIN_PRELOAD", "::", 1);  // no code of others for their filters
    return packed_table(pandas_file_table(path));
  }));
}

}  // namespace genio
