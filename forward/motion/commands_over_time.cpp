#include "forward/motion/commands_over_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "forward/base/input_file.hpp"

namespace genio {
namespace {

constexpr double activation_step = 2.5e-4;  // [s]
constexpr double longest = 100;             // [s]; at each step of the activation all are kept
constexpr std::uintmax_t largest_commands = std::uintmax_t(64) << 20;  // bytes

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream s(line);
  for (std::string cell; std::getline(s, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r"), last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

/// "GGP_N" -> "GGP", but "GGP_L" stays.
std::string without_unit(const std::string& column) {
  const size_t n = column.size();
  return n > 2 && column.compare(n - 2, 2, "_N") == 0 ? column.substr(0, n - 2) : column;
}

double number(const std::string& cell, const std::string& path, int line,
              const std::string& column) {
  char* end = nullptr;
  const double v = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != 0 || !std::isfinite(v))
    throw InputError(
        fmt::format("{}:{}: column {}: '{}' is not a number", path, line, column, cell));
  return v;
}

CommandsOverTime filtered(const Model& model, const Placed<CommandFilter>& filter,
                          const CommandsOverTime& commands) {
  CommandsOverTime out{{commands.times.front()}, {commands.values.front()}};
  // At rest before; then followed long enough for the last jump to be over.
  for (size_t k = 0; k < model.parameters.size(); ++k)
    if (model.parameters[k].is_command) out.values[0][Eigen::Index(k)] = 0;
  const double end =
      commands.times.back() + 10 * filter->memory(filter.values(commands.values.front()));
  while (out.times.back() < end) {
    const double t = out.times.back() + activation_step;
    const Parameters excitation = commands.at(t - 0.5 * activation_step);
    const auto values = filter.values(excitation);
    Parameters next = commands.at(t);
    for (size_t i = 0; i < model.parameters.size(); ++i) {
      if (!model.parameters[i].is_command) continue;
      const auto k = Eigen::Index(i);
      next[k] = filter->follow(excitation[k], out.values.back()[k], activation_step, values);
    }
    out.times.push_back(t);
    out.values.push_back(std::move(next));
  }
  return out;
}

}  // namespace

Parameters CommandsOverTime::at(double time) const {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return values.front();
  if (after == times.end()) return values.back();
  const size_t i = size_t(after - times.begin());
  const double s = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return (1 - s) * values[i - 1] + s * values[i];
}

CommandsOverTime ramp(const Parameters& from, const Parameters& to, double ramp) {
  return {{0, ramp}, {from, to}};
}

CommandsOverTime read_commands(const Model& model, const std::string& path,
                               const Parameters& base) {
  check_input(path, largest_commands);
  std::ifstream in(path);
  if (!in) throw InputError(path + ": cannot be read");
  CommandsOverTime c;
  std::vector<std::string> columns;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const auto cells = split(text);
    if (cells.empty() || (cells.size() == 1 && cells[0].empty()) || cells[0].starts_with('#'))
      continue;
    if (columns.empty()) {
      if (cells[0] != "time_s" || cells.size() < 2)
        throw InputError(fmt::format("{}:{}: expected a header 'time_s,GGP_N,...'", path, line));
      columns = cells;
      continue;
    }
    if (cells.size() != columns.size())
      throw InputError(fmt::format("{}:{}: {} columns; expected the {} of the header", path, line,
                                   cells.size(), columns.size()));
    const double time = number(cells[0], path, line, "time_s");
    if (std::abs(time) > longest)
      throw InputError(fmt::format("{}:{}: time_s {}; expected seconds from {} to {}", path, line,
                                   time, -longest, longest));
    if (!c.times.empty() && time < c.times.back())
      throw InputError(fmt::format("{}:{}: time_s {} comes before {}; expected rising times", path,
                                   line, time, c.times.back()));
    Parameters p = base;
    for (size_t i = 1; i < cells.size(); ++i) {
      const double value = number(cells[i], path, line, columns[i]);
      try {
        if (ParameterName::try_parse(columns[i])) set_parameter(model, columns[i], value, p);
        else set_command(model, without_unit(columns[i]), value, p);
      } catch (const InputError& e) {
        throw InputError(fmt::format("{}:{}: {}", path, line, e.what()));
      }
    }
    c.times.push_back(time);
    c.values.push_back(std::move(p));
  }
  if (c.times.empty()) throw InputError(path + ": no row of commands");
  return c;
}

CommandsOverTime activated(const Model& model, const CommandsOverTime& commands) {
  CommandsOverTime result = commands;
  for (const auto& filter : model.filters) result = filtered(model, filter, result);
  return result;
}

}  // namespace genio
