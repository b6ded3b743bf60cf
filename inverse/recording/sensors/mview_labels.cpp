#include "inverse/recording/sensors/mview_labels.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace genio {
namespace {

struct Spoken {
  std::string label;
  double first_s, last_s;
};

/// What one field of any element says: sound carries it as a rule.
std::vector<Spoken> spoken_in(const DataTree& array, const std::string& field) {
  std::vector<Spoken> result;
  for (const DataTree& element : array.children) {
    const DataTree* list = element.find(field);
    if (!list || list->kind != DataTree::Kind::list || !result.empty()) continue;
    for (const DataTree& one : list->children) {
      const DataTree *label = one.find("LABEL"), *times = one.find("OFFS");
      if (label && times && times->numbers.size() == 2)
        result.push_back({label->text, times->numbers[0], times->numbers[1]});
      const DataTree *name = one.find("NAME"), *offset = one.find("OFFSET");
      if (name && offset && offset->numbers.size() == 1)
        result.push_back({name->text, 1e-3 * offset->scalar(), 1e-3 * offset->scalar()});
    }
  }
  return result;
}

void put_u32(std::string& bytes, uint32_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// An element of a MATLAB v5 file: its type, its size and its bytes, filled to a multiple of eight.
std::string element(uint32_t type, const std::string& content) {
  std::string bytes;
  put_u32(bytes, type), put_u32(bytes, uint32_t(content.size()));
  bytes += content;
  bytes.resize((bytes.size() + 7) / 8 * 8, '\0');
  return bytes;
}

constexpr uint32_t int8_type = 1, uint16_type = 4, int32_type = 5, uint32_type = 6, double_type = 9,
                   matrix_type = 14;
constexpr uint32_t struct_class = 2, char_class = 4, double_class = 6;

std::string matrix(uint32_t type_class, uint32_t rows, uint32_t columns, const std::string& name,
                   const std::string& content) {
  std::string flags, size;
  put_u32(flags, type_class), put_u32(flags, 0);
  put_u32(size, rows), put_u32(size, columns);
  return element(matrix_type, element(uint32_type, flags) + element(int32_type, size) +
                                  element(int8_type, name) + content);
}

std::string number_matrix(uint32_t columns, const std::vector<double>& values) {
  const std::string bytes(reinterpret_cast<const char*>(values.data()),
                          values.size() * sizeof(double));
  return matrix(double_class, uint32_t(values.size()) / columns, columns, "",
                element(double_type, bytes));
}

}  // namespace

void label_samples(SensorTable& table, const DataTree& array) {
  for (const char* field : {"PHONES", "SEGMENTS", "WORDS", "LABELS"}) {
    const std::vector<Spoken> spoken = spoken_in(array, field);
    if (spoken.empty()) continue;
    table.labels.assign(table.samples.size(), "");
    const auto most = double(table.samples.size());
    for (const Spoken& s : spoken) {
      const bool point = s.first_s == s.last_s;
      // An interval holds its begin and not its end.
      const double first = point ? std::round(s.first_s * table.rate_hz)
                                 : std::ceil(s.first_s * table.rate_hz - 1e-6),
                   last = point ? first + 1 : std::ceil(s.last_s * table.rate_hz - 1e-6);
      if (!(first < most && last > 0)) continue;
      for (double k = std::max(0.0, first); k < std::min(last, most); ++k)
        table.labels[size_t(k)] = s.label;
    }
    table.remarks.push_back(fmt::format("labels are those of {}", field));
    return;
  }
}

std::string mview_example() {
  std::string file = "MATLAB 5.0 MAT-file, made up";
  file.resize(124, ' ');
  file += std::string("\x00\x01IM", 4);
  std::string name_text("T\0T\0", 4), fields;
  for (const char* field : {"NAME", "SRATE", "SIGNAL"}) {
    std::string padded = field;
    padded.resize(8, '\0');
    fields += padded;
  }
  std::string field_length;  // in the short form of an element, which holds up to four bytes
  put_u32(field_length, 4u << 16 | int32_type), put_u32(field_length, 8);
  const std::string content = field_length + element(int8_type, fields) +
                              matrix(char_class, 1, 2, "", element(uint16_type, name_text)) +
                              number_matrix(1, {100}) + number_matrix(3, {-16.5, -1.5, -7.25});
  return file + matrix(struct_class, 1, 1, "take", content);
}

}  // namespace genio
