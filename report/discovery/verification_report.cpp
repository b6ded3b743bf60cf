#include "report/discovery/verification_report.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "forward/base/text_file.hpp"
#include "report/pictures/plot.hpp"
#include "report/pictures/svg.hpp"

namespace genio {
namespace {

using Json = nlohmann::json;

/// A line for each value of name(row), through (x(row), y(row)).
template <class Name, class X, class Y>
std::vector<Series> grouped(const Json& rows, Name name, X x, Y y) {
  std::vector<Series> series;
  for (const Json& row : rows) {
    const std::string key = name(row);
    if (series.empty() || series.back().name != key) {
      const auto it = std::find_if(series.begin(), series.end(),
                                   [&](const Series& s) { return s.name == key; });
      if (it != series.end()) {
        it->points.emplace_back(x(row), y(row));
        continue;
      }
      series.push_back({key, {}});
    }
    series.back().points.emplace_back(x(row), y(row));
  }
  return series;
}

double value(const Json& row, const char* key) { return row.at(key).get<double>(); }

}  // namespace

void write_verification(const Json& tables, const std::string& folder) {
  make_folder(folder);
  write_text(folder + "/verification.json", tables.dump(2) + "\n");
  const auto n = [](const Json& r) { return value(r, "n"); };
  write_text(folder + "/manufactured.svg",
             plot("Manufactured solution", "elements along an edge", "relative L2 error",
                  grouped(
                      tables.at("manufactured"),
                      [](const Json& r) {
                        return fmt::format("nu {}, distortion {}", value(r, "poisson_ratio"),
                                           value(r, "distortion"));
                      },
                      n, [](const Json& r) { return value(r, "relative_l2_error"); }),
                  true, true));
  write_text(folder + "/cook.svg",
             plot("Cook's membrane", "elements along an edge", "rise of the corner [mm]",
                  grouped(
                      tables.at("cook"),
                      [](const Json& r) { return fmt::format("nu {}", value(r, "poisson_ratio")); },
                      n, [](const Json& r) { return value(r, "corner_mm"); }),
                  true, false));
  const auto code = [](const Json& r) { return r.at("code").get<std::string>(); };
  const auto elements = [](const Json& r) { return value(r, "elements"); };
  write_text(folder + "/block.svg",
             plot("Block under 1 N", "elements", "top centre, forwards [mm]",
                  grouped(tables.at("block"), code, elements,
                          [](const Json& r) { return r.at("mm")[0].get<double>(); }),
                  true, false));
  write_text(
      folder + "/time.svg",
      plot("Order in time", "step [ms]", "relative error",
           grouped(
               tables.at("time"), [](const Json& r) { return r.at("scheme").get<std::string>(); },
               [](const Json& r) { return value(r, "step_ms"); },
               [](const Json& r) { return value(r, "relative_error"); }),
           true, true));
}

}  // namespace genio
