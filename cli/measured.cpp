#include "cli/measured.hpp"

#include <fmt/format.h>

#include <numbers>
#include <optional>

#include "inverse/frame_target.hpp"

namespace genio::cli {
namespace {

/// "7" or "3-9"; empty means all.
std::pair<int, int> parse_frames(const std::string& text) {
  if (text.empty()) return {1, 1 << 30};
  int a = 0, b = 0;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%d-%d%c", &a, &b, &rest);
  if (n == 1 && text.find('-') == std::string::npos) b = a;
  else if (n != 2) a = 0;
  if (a < 1 || b < a)
    throw InputError(fmt::format("--frames {}: expected A-B with 1 <= A <= B", text));
  return {a, b};
}

Similarity registered_by(const Model& model, const ContourFile& file, const MeasuredOptions& o) {
  if (o.palate.empty())
    throw InputError(fmt::format(
        "{}: is in the device's own frame; give the same session's palate trace with --palate",
        o.target));
  const auto r = register_file(model, file, o.palate, o.format);
  fmt::print(stderr,
             "registered by the palate: scale {:.3f}, tilt {:.1f} degrees, palate RMS {:.2f} mm\n",
             r.transform.scale, r.transform.angle * 180 / std::numbers::pi, 1e3 * r.palate_rms);
  return r.transform;
}

}  // namespace

void add_measured_options(CLI::App& app, MeasuredOptions& o) {
  app.add_option("--target", o.target, "Contour file");
  app.add_option("--format", o.format, "auto, csv or aaa");
  app.add_option("--palate", o.palate, "Palate trace of the same session");
  app.add_option("--frames", o.frames, "A-B, counted from 1");
  app.add_option("--noise-mm", o.noise_mm, "Measurement noise (default 0.5 for CSV, 1.5 for AAA)");
}

Measured read_measured(const MeasuredOptions& o, const std::function<const Model&()>& model) {
  if (o.target.empty()) throw InputError("--target: a contour file is needed");
  if (!(o.noise_mm >= 0)) throw InputError("--noise-mm: must be above 0");
  const auto [first, last] = parse_frames(o.frames);
  const ContourFile file = read_contours(o.target, o.format);
  Measured m;
  std::optional<Similarity> transform;
  if (!file.model_frame) transform = registered_by(model(), file, o);
  m.noise = o.noise_mm > 0 ? 1e-3 * o.noise_mm : default_noise(file.format);
  for (const ContourFrame& frame : file.frames)
    if (frame.number >= first && frame.number <= last)
      m.frames.push_back(transform ? registered(model(), frame, *transform) : frame);
  if (m.frames.empty())
    throw InputError(fmt::format("--frames {}: {} has no such frame", o.frames, o.target));
  return m;
}

void print_answer(const AnswerView& view, int frame, bool json) {
  if (json) fmt::print("{}\n", to_json(view, frame).dump());
  else fmt::print("{}\n{}\n", view.title, to_table(view));
  std::fflush(stdout);
}

std::string frame_name(const ContourFrame& frame) {
  return fmt::format("frame{:05d}", frame.number);
}

std::string frame_title(const ContourFrame& frame) {
  return fmt::format("frame {}{}{}", frame.number, frame.label.empty() ? "" : ": ", frame.label);
}

}  // namespace genio::cli
