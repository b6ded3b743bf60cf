#pragma once
// Fields and numbers of tables of sensors, as devices, R and spreadsheets write them.

#include "inverse/recording/base/table_text.hpp"

namespace genio {

/// Fields between tabs, semicolons, runs of blanks or commas, the first of these that the line
/// holds; without blanks and quotes at their ends, and without an empty field after the last.
std::vector<std::string> sensor_fields(const std::string& line);

/// True of numbers (with a decimal point or comma) and of marks of a missing one.
bool is_value(const std::string& field);

/// The numbers of one table, whose decimal mark is either the point or the comma.
class SensorNumbers {
 public:
  /// NaN where the field marks a missing value (empty, *, NA, NaN, inf). Throws InputError naming
  /// the line where it is no number, or has the other decimal mark than those before.
  double operator()(const std::string& field, const TableLines& lines);

 private:
  bool commas_ = false, points_ = false;
};

}  // namespace genio
