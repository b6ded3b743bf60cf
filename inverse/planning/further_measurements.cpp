#include "inverse/planning/further_measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "forward/base/nearest_name.hpp"
#include "forward/tissue/tongue_faces.hpp"
#include "inverse/recording/sensor_place.hpp"
#include "inverse/target/facets.hpp"

namespace genio {
namespace {

constexpr double apart = 2e-3;         // points of a contour [m]
constexpr double covered = 3e-3;       // what was measured so near is known [m]
constexpr double widest_step = 4e-3;   // of a contour across, from one point to the next [m]
constexpr double contour_noise = 0.5;  // [mm]
constexpr double sensor_noise = 0.3;   // [mm]
constexpr double emg_noise = 0.1;      // of the maximum

struct Region {
  const char* name;
  double from, to;  ///< parts of the way from tip to root, as tongue_region() has them
};
constexpr std::array regions = {Region{"underside", -1e9, 0}, Region{"tip", 0, 0.1},
                                Region{"blade", 0.1, 0.3}, Region{"dorsum", 0.3, 0.65},
                                Region{"root", 0.65, 1}};

/// "sensors=tip+10mm,dorsum@0.3mm" in its parts.
struct Wish {
  std::string text, kind;
  std::vector<std::string> places;
  double noise = 0;  ///< 0: not said
};

[[noreturn]] void fail(const std::string& text, const std::string& expected) {
  throw InputError(fmt::format("--measure {}: {}", text, expected));
}

Wish parsed(const std::string& text) {
  Wish wish{text, text.substr(0, text.find_first_of("=@")), {}};
  std::string rest = text.substr(wish.kind.size());
  if (const auto at = rest.find('@'); at != std::string::npos) {
    const std::string number = rest.substr(at + 1);
    char* end = nullptr;
    wish.noise = std::strtod(number.c_str(), &end);
    const bool lengths = wish.kind == "contour" || wish.kind == "slice" || wish.kind == "sensors";
    if (number.empty() || !(wish.noise > 0) || !std::isfinite(wish.noise) ||
        std::string(end) != (lengths ? "mm" : ""))
      fail(text, lengths ? "expected a noise above 0 after @, as in @0.5mm"
                         : "expected a noise above 0 after @, as in @0.1");
    rest.erase(at);
  }
  while (!rest.empty()) {  // "=a", ",b"
    const auto next = rest.find(',', 1);
    wish.places.push_back(rest.substr(1, next - 1));
    if (wish.places.back().empty()) fail(text, "a place is missing");
    rest = next == std::string::npos ? "" : rest.substr(next);
  }
  return wish;
}

bool is_measured(const Target& measured, const Vec2& q) {
  return std::any_of(measured.curve.begin(), measured.curve.end(),
                     [&](const CurvePoint& p) { return (p.position - q).norm() < covered; });
}

/// Points of the midsagittal line within the region that were not measured.
void add_contour(const TongueLine& line, const Positions& x, const Region& region, double sigma,
                 const Target& measured, Target& target) {
  const int count = int(line.length() / apart) + 1;
  for (int k = 0; k <= count; ++k) {
    const double t = line.length() * k / count;
    const double along = (t - line.tip_parameter()) / (line.length() - line.tip_parameter());
    if (along < region.from || along > region.to) continue;
    const Vec2 q = line.point(x, t);
    if (!is_measured(measured, q)) target.curve.push_back({q, sigma});
  }
}

/// Where a plane through `at` with that normal cuts the tongue's surface: ends of the cuts.
std::vector<std::pair<Vec3, Vec3>> cuts(const Model& model, const Positions& x, const Vec3& at,
                                        const Vec3& normal) {
  std::vector<std::pair<Vec3, Vec3>> segments;
  for (const Facet& f : facets(free_faces(model.mesh, model.supports))) {
    const auto corners = corners_of(f, x);
    std::vector<Vec3> ends;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 &a = corners[k], &b = corners[(k + 1) % 3];
      const double da = (a - at).dot(normal), db = (b - at).dot(normal);
      if ((da < 0) != (db < 0)) ends.push_back(a + da / (da - db) * (b - a));
    }
    if (ends.size() == 2) segments.emplace_back(ends[0], ends[1]);
  }
  return segments;
}

/// The contour across the tongue through a point of its line, out to both sides as far as it goes.
void add_slice(const Model& model, const Positions& x, const Vec3& at, const Vec3& along,
               double sigma, int slice, Target& target) {
  const auto segments = cuts(model, x, at, along);
  for (const double side : {1.0, -1.0}) {
    Vec3 last = at;
    for (int k = side > 0 ? 0 : 1;; ++k) {
      const double y = side * apart * k;
      std::optional<Vec3> next;
      for (const auto& [a, b] : segments) {
        if ((a[1] < y) == (b[1] < y)) continue;
        const Vec3 q = a + (y - a[1]) / (b[1] - a[1]) * (b - a);
        if (!next || (q - last).norm() < (*next - last).norm()) next = q;
      }
      if (!next || (*next - last).norm() > widest_step) break;
      target.surface.push_back({*next, sigma, slice});
      last = *next;
    }
  }
}

FleshPoint sensor(const Model& model, const Positions& x, const std::string& place, double sigma) {
  FleshPoint point{sensor_place(model, place), Vec3::Zero(), sigma, place};
  point.position = point.on(x);
  point.position[1] = std::nan("");
  return point;
}

/// The direction of the tongue's line where it is nearest to a place.
Vec3 direction(const TongueLine& line, const Positions& x, const Vec3& at) {
  const Vec2 normal = line.closest(x, {at[0], at[2]}).normal;
  return {normal[1], 0, -normal[0]};
}

int next_slice(const Target& measured) {
  int last = 0;
  for (const SurfacePoint& p : measured.surface) last = std::max(last, p.slice);
  return last + 1;
}

Target points_of(const Model& model, const Target& measured, const Positions& x, const Wish& wish) {
  const TongueLine line(model);
  const double usual = wish.kind == "sensors" ? sensor_noise : contour_noise;
  const double sigma = 1e-3 * (wish.noise > 0 ? wish.noise : usual);
  Target target;
  if (wish.kind == "contour" && wish.places.empty())
    add_contour(line, x, {"", -1e9, 1e9}, sigma, measured, target);
  int slice = next_slice(measured);
  for (const std::string& place : wish.places) {
    if (wish.kind == "contour") {
      const auto* region = std::find_if(regions.begin(), regions.end(),
                                        [&](const Region& r) { return place == r.name; });
      if (region == regions.end())
        fail(wish.text, "expected underside, tip, blade, dorsum or root");
      add_contour(line, x, *region, sigma, measured, target);
    } else if (wish.kind == "sensors") {
      target.flesh.push_back(sensor(model, x, place, sigma));
    } else {
      const Vec3 at = sensor(model, x, place, sigma).on(x);
      add_slice(model, x, at, direction(line, x, at), sigma, slice++, target);
    }
  }
  if (target.empty())
    fail(wish.text, wish.kind == "contour" ? "all of it is measured already"
                                           : "expected places, as in " + wish.kind + "=tip+20mm");
  return target;
}

}  // namespace

FurtherMeasurement further_measurement(const Model& model, const Target& measured,
                                       const Positions& x, const std::string& text) {
  const Wish wish = parsed(text);
  FurtherMeasurement result{text};
  if (wish.kind == "contour" || wish.kind == "slice" || wish.kind == "sensors") {
    result.points = points_of(model, measured, x, wish);
    return result;
  }
  if (wish.kind != "emg" && wish.kind != "parameter")
    fail(text,
         fmt::format("expected contour, slice, sensors, emg or parameter; did you mean {}?",
                     nearest_name(wish.kind, {"contour", "slice", "sensors", "emg", "parameter"})));
  if (wish.places.empty()) fail(text, "expected names, as in " + wish.kind + "=NAME");
  if (wish.kind == "parameter" && wish.noise == 0)
    fail(text, "expected its standard deviation once measured, as in " + text + "@0.5");
  for (const std::string& name : wish.places)
    if (wish.kind == "emg") result.emg_sd[name] = wish.noise > 0 ? wish.noise : emg_noise;
    else result.parameter_sd[name] = wish.noise;
  return result;
}

std::vector<std::string> usual_measurements(const Model& model, const Target& measured,
                                            const Positions& x,
                                            const std::vector<std::string>& muscles) {
  std::vector<std::string> result;
  const auto add_contour_of = [&](const std::string& text) {
    try {
      if (further_measurement(model, measured, x, text).points.curve.size() > 2)
        result.push_back(text);
    } catch (const InputError&) {  // measured already
    }
  };
  add_contour_of("contour");
  for (const Region& r : regions) add_contour_of(std::string("contour=") + r.name);
  for (const char* place : {"tip+10mm", "tip+25mm", "dorsum", "root"})
    result.push_back(std::string("slice=") + place);
  result.emplace_back("slice=tip+25mm,dorsum,root");
  for (const char* place : {"tip+5mm", "tip+20mm", "tip+35mm"})
    result.push_back(std::string("sensors=") + place);
  result.emplace_back("sensors=tip+5mm,tip+20mm,tip+35mm");
  for (const std::string& name : muscles) result.push_back("emg=" + name);
  return result;
}

}  // namespace genio
