#include "cli/speaker/adapt.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/support.hpp"
#include "forward/base/elapsed.hpp"
#include "forward/model/build_model.hpp"
#include "speaker/adaptation/adapt.hpp"
#include "speaker/adaptation/stack_sides.hpp"

namespace genio::cli {
namespace {

struct AdaptCommand {
  std::string model = default_model(), outline, speaker, palate, slices, surface, out;
  bool json = false;
};

nlohmann::ordered_json adapt_json(const AdaptCommand& o, const Adaptation& a, double wall) {
  nlohmann::ordered_json j{{"status", a ? "converged" : "failed"},
                           {"rms_mm", a.distances.rms * 1e3},
                           {"max_mm", a.distances.most * 1e3},
                           {"free_rms_mm", a.distances.free_rms * 1e3}};
  if (a.outline.free_surface_only) j["floor_rms_mm"] = nullptr;
  else j["floor_rms_mm"] = a.distances.floor_rms * 1e3;
  if (a.surface_rms) j["surface_rms_mm"] = *a.surface_rms * 1e3;
  if (a.outline.has(Segment::palate) && a.model.palate) j["palate_rms_mm"] = a.palate_rms * 1e3;
  else j["palate_rms_mm"] = nullptr;
  j["min_jacobian"] = a.min_jacobian, j["volume_cm3"] = a.volume * 1e6;
  j["modes"] = nlohmann::ordered_json::object(), j["modes_sd"] = nlohmann::ordered_json::object();
  if (a.outline.speaker.empty()) j["speaker"] = nullptr;
  else j["speaker"] = a.outline.speaker;
  j["rest_overlap_mm"] = a.rest_overlap * 1e3;
  j["scale"] = a.scale, j["repaired_elements"] = a.repaired;
  j["max_force_scale"] = a.max_force_scale, j["notes"] = a.outline.notes;
  if (a) j["out"] = o.out;
  else j["message"] = a.message;
  j["wall_s"] = wall;
  return j;
}

std::optional<SpeakerSurface> given_surface(const AdaptCommand& o) {
  if (!o.surface.empty()) return SpeakerSurface{read_surface(o.surface), o.surface};
  if (!o.slices.empty()) return SpeakerSurface{stack_sides(read_contour_stack(o.slices)), o.slices};
  return std::nullopt;
}

Adaptation adapted(const AdaptCommand& o, const ModelDescription& base) {
  const std::optional<SpeakerSurface> surface = given_surface(o);
  if (o.outline.empty()) {
    if (o.surface.empty())
      throw InputError("adapt: expected --outline FILE, or --surface FILE alone");
    return adapt_to_surface(base, o.model, *surface);
  }
  SpeakerOutline outline = read_outline(o.outline, o.speaker);
  if (!o.palate.empty()) read_outline_palate(o.palate, outline);
  return adapt_model(base, o.model, outline, surface);
}

int run_adapt(const AdaptCommand& o) {
  const Stopwatch watch;
  const ModelDescription base = read_description(o.model);
  const Adaptation a = adapted(o, base);
  const std::string name = o.outline.empty() ? o.surface + o.slices : o.outline;
  if (a) {
    build_model(a.model, o.out);  // refuses what could not be computed with
    write_description(a.model, o.out);
  }
  if (o.json) fmt::print("{}\n", adapt_json(o, a, watch.seconds()).dump());
  for (const std::string& note : a.outline.notes) print_line(name + ": " + note);
  if (!a) print_line(name + ": " + a.message);
  else if (!o.json)
    print_line(fmt::format(
        "{}: {:.2f} mm RMS and at most {:.2f} mm from the outline, smallest corner-Jacobian ratio "
        "{:.3f}, {:.1f} cm3, {:.3f} times the base's lengths",
        o.out, a.distances.rms * 1e3, a.distances.most * 1e3, a.min_jacobian, a.volume * 1e6,
        a.scale));
  return a ? done : no_answer;
}

}  // namespace

Runner add_adapt(Options& options) {
  auto o = std::make_shared<AdaptCommand>();
  options.add("--model", o->model, "Model folder or model.toml that is adapted");
  options.add("--outline", o->outline,
              "Midsagittal outline (CSV: segment, point, x_cm and y_cm, or x_mm and y_mm)", {});
  options.add("--speaker", o->speaker, "Whose rows to take, where the file has several speakers",
              {.only_with = {"--outline"}});
  options.add("--palate", o->palate, "Palate of the same origin, in the place of the outline's",
              {.only_with = {"--outline"}});
  options.add("--slices", o->slices,
              "Closed coronal contours of the tongue in the outline's frame (CSV: slice, point, "
              "x_mm, y_mm, z_mm)",
              {.only_with = {"--outline"}, .not_with = {"--surface"}});
  options.add("--surface", o->surface,
              "Closed surface of the tongue in metres (OBJ, STL, PLY), in the outline's frame or, "
              "alone, in the model's axes");
  options.add("--out", o->out, "Model folder to write", {.required = true});
  options.flag("--json", o->json, "One JSON object on standard output");
  options.footer("Example: genio adapt --outline data/examples/adapt/outline.csv --out mine");
  return [o] { return run_adapt(*o); };
}

}  // namespace genio::cli
