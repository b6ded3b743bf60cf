#include "inverse/recording/session_marks.hpp"

#include <fmt/format.h>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

/// Where a model has its hyoid: the middle of the bone's cut.
Vec2 hyoid_of(const Model& model) {
  if (!model.hyoid) throw InputError("--hyoid: the model file has no hyoid in [surfaces]");
  Vec2 middle = Vec2::Zero();
  double count = 0;
  for (const auto& line : midsagittal_cut(*model.hyoid))
    for (const Vec2& q : line) middle += q, ++count;
  if (count == 0)
    throw InputError("--hyoid: the model's hyoid does not cross the midsagittal plane");
  return middle / count;
}

}  // namespace

std::vector<Vec2> trace_of(const ContourFile& palate) {
  std::vector<Vec2> trace;
  for (const auto& line : midsagittal_points(palate)) {
    trace.insert(trace.end(), line.begin(), line.end());
    if (palate.format.content != Content::sensors) break;
  }
  return trace;
}

HeadMarks marks_as(const Model& model, const SessionMarks& session, const AxesReading& reading) {
  HeadMarks marks;
  if (session.bite_plane)
    marks.bite_plane = bite_plane_of(trace_of(turned(session.bite_plane->file, reading)),
                                     session.bite_plane->path);
  if (session.hyoid)
    marks.hyoid = KnownPlace{trace_of(turned(session.hyoid->file, reading)).front(),
                             hyoid_of(model), hyoid_sd};
  return marks;
}

SessionFile hyoid_at(const std::string& text, const ReadOptions& options,
                     const SessionFile& target) {
  const auto comma = text.find(',');
  double x = 0, y = 0;
  if (comma == std::string::npos || !parse_number(text.substr(0, comma), x) ||
      !parse_number(text.substr(comma + 1), y))
    throw InputError(
        fmt::format("--hyoid {}: expected X,Y, two numbers as the contours have", text));
  if (target.file.format.content != Content::curves)
    throw InputError(fmt::format("--hyoid: does not apply; {} holds no curves", target.path));
  ContourFile file;
  file.format = target.file.format;
  ContourPoint& point = file.frames.emplace_back().points.emplace_back();
  point.position = {x, not_given, y}, point.kind = "hyoid";
  ReadOptions same_units = options;
  same_units.units = target.file.units;
  const std::string name = "--hyoid " + text;
  return {name, in_metres(std::move(file), target.axes, name, same_units), target.axes};
}

}  // namespace genio
