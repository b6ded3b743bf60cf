#include "cli/speaker/surface.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/support.hpp"
#include "forward/base/elapsed.hpp"
#include "speaker/decimation/decimate.hpp"
#include "speaker/slices/stack_surface.hpp"
#include "speaker/solid/largest_part.hpp"
#include "speaker/solid/surface_figures.hpp"
#include "speaker/volume/label_surface.hpp"

namespace genio::cli {
namespace {

struct SurfaceCommand {
  std::string from, out;
  std::optional<double> triangles, distance_mm, keep_distance_mm, label, step_mm;
  std::vector<std::string> keep;
  bool largest = false, model_axes = false, json = false;
};

struct Made {
  TriangleSurface surface;
  nlohmann::ordered_json origin;  ///< what it was made from
};

bool ends(const std::string& path, std::initializer_list<std::string_view> endings) {
  std::string small = path;
  for (char& c : small) c = char(std::tolower(static_cast<unsigned char>(c)));
  return std::any_of(endings.begin(), endings.end(), [&](auto e) { return small.ends_with(e); });
}

/// Throws InputError where an option is given that goes with another kind of input.
void refuse(bool given, const char* option, const char* only) {
  if (given) throw InputError(fmt::format("{}: goes with {} only", option, only));
}

Made from_stack(const SurfaceCommand& o) {
  const ContourStack stack = read_contour_stack(o.from);
  auto [surface, step] = stack_surface(stack, o.step_mm.value_or(0) * 1e-3);
  return {std::move(surface),
          {{"from", "contours"}, {"slices", stack.slices.size()}, {"step_mm", step * 1e3}}};
}

Made from_labels(const SurfaceCommand& o) {
  std::optional<std::int64_t> label;
  if (o.label) label = std::int64_t(std::llround(*o.label));
  LabelledBox box = read_labelled_box(o.from, label);
  if (o.model_axes) {  // a scan's x is to the right, its y forwards
    Mat3 turn;
    turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    box.to_metres = Eigen::Affine3d(turn) * box.to_metres;
  }
  Made made{label_surface(box), {{"from", "labels"}, {"label", box.label}, {"voxels", box.voxels}}};
  made.origin["voxels_cm3"] =
      1e6 * std::abs(box.to_metres.linear().determinant()) * double(box.voxels);
  if (made.surface.triangles.empty())
    throw InputError(fmt::format("{}: label {} is thinner than a voxel everywhere; expected a body",
                                 o.from, box.label));
  return made;
}

Made make(const SurfaceCommand& o) {
  if (ends(o.from, {".nii", ".nii.gz"})) {
    refuse(o.step_mm.has_value(), "--step", "a stack of contours");
    return from_labels(o);
  }
  refuse(o.label.has_value(), "--label", "a label volume");
  refuse(o.model_axes, "--model-axes", "a label volume");
  if (ends(o.from, {".csv", ".tsv", ".txt"})) return from_stack(o);
  refuse(o.step_mm.has_value(), "--step", "a stack of contours");
  if (ends(o.from, {".obj", ".stl", ".ply"})) return {read_surface(o.from), {{"from", "surface"}}};
  throw InputError(o.from +
                   ": unknown kind; expected a stack of contours (.csv), a label volume "
                   "(.nii, .nii.gz) or a surface (.obj, .stl, .ply)");
}

void check(const SurfaceCommand& o) {
  if (!ends(o.out, {".obj"})) throw InputError("--out " + o.out + ": expected a name in .obj");
  if (o.triangles &&
      (*o.triangles < 4 || *o.triangles > 1e9 || *o.triangles != std::floor(*o.triangles)))
    throw InputError(fmt::format("--triangles {}: expected a whole number from 4", *o.triangles));
  if (o.label && (*o.label != std::floor(*o.label) || std::abs(*o.label) > 1e15))
    throw InputError(fmt::format("--label {}: expected a whole number", *o.label));
}

void add_figures(nlohmann::ordered_json& j, const SurfaceFigures& f) {
  j["triangles"] = f.triangles, j["vertices"] = f.vertices, j["parts"] = f.parts;
  j["closed"] = f.closed, j["manifold"] = f.manifold, j["euler"] = f.euler;
  j["area_cm2"] = f.area * 1e4;
  if (f.closed) j["volume_cm3"] = f.volume * 1e6;
  else j["volume_cm3"] = nullptr;
}

int run_surface(const SurfaceCommand& o) {
  check(o);
  DecimateOptions wanted{int(o.triangles.value_or(0)), {}, read_kept_region(o.keep), {}};
  if (o.distance_mm) wanted.distance = *o.distance_mm * 1e-3;
  if (o.keep_distance_mm) wanted.keep_distance = *o.keep_distance_mm * 1e-3;
  const Stopwatch watch;
  Made made = make(o);
  if (o.largest) made.surface = largest_part(made.surface);
  nlohmann::ordered_json j{{"status", "converged"}, {"out", o.out}, {"unit", "m"}};
  j.update(made.origin);
  const SurfaceFigures fine = surface_figures(made.surface);
  j["triangles_before"] = fine.triangles;
  j["volume_before_cm3"] = fine.closed ? nlohmann::ordered_json(fine.volume * 1e6) : nullptr;
  DecimatedSurface result{made.surface, 0, 0, true, true};
  if (o.triangles || wanted.distance || wanted.keep_distance)
    result = decimate(made.surface, wanted);
  const SurfaceFigures figures = surface_figures(result.surface);
  add_figures(j, figures);
  j["hausdorff_mm"] = result.hausdorff * 1e3;
  if (!wanted.keep.empty()) j["hausdorff_keep_mm"] = result.hausdorff_kept * 1e3;
  j["reached"] = result.reached;
  std::string message;
  if (!result.within_bounds)
    message = "no surface was found within the bounds of the distance; none was written";
  else if (!result.reached)
    message = fmt::format(
        "{} triangles are left, as the bounds of the distance or the surface's "
        "shape allow no fewer",
        figures.triangles);
  if (!result.within_bounds) j["status"] = "failed";
  else write_obj(o.out, result.surface);
  if (!message.empty()) j["message"] = message;
  j["wall_s"] = watch.seconds();
  if (o.json) fmt::print("{}\n", j.dump());
  if (!message.empty()) print_line(o.from + ": " + message);
  if (!o.json)
    print_line(fmt::format(
        "{}: {} triangles of {}, {}, Euler number {}, {} part{}; Hausdorff "
        "distance {:.3f} mm",
        o.out, figures.triangles, fine.triangles,
        figures.closed ? fmt::format("closed, {:.2f} cm3", figures.volume * 1e6)
                       : std::string("open"),
        figures.euler, figures.parts, figures.parts == 1 ? "" : "s", result.hausdorff * 1e3));
  return result.within_bounds ? done : no_answer;
}

}  // namespace

Runner add_surface(Options& options) {
  auto o = std::make_shared<SurfaceCommand>();
  options.add("file", o->from,
              "Stack of closed contours (CSV: slice, point, x_mm, y_mm, z_mm, perhaps contour), "
              "label volume (NIfTI-1), or surface in metres (OBJ, STL, PLY)",
              {.required = true});
  options.add("--out", o->out, "OBJ to write, in metres", {.required = true});
  options.add("--triangles", o->triangles, "Triangles to come down to (as fine as it was made)",
              {.positive = true});
  options.add("--distance", o->distance_mm,
              "Bound of the distance to the fine surface [mm]; it comes before --triangles",
              {.positive = true});
  options.add("--keep", o->keep,
              "Where to stay finer, in mm: a ball X,Y,Z,R, a box X,Y,Z,X,Y,Z, or a CSV of balls "
              "with x_mm, y_mm, z_mm, radius_mm");
  options.add("--keep-distance", o->keep_distance_mm,
              "Bound of the distance there [mm] (0.3 of --distance)",
              {.positive = true, .only_with = {"--keep"}});
  options.add("--label", o->label, "Label of the volume, where it has several");
  options.add("--step", o->step_mm, "Step of the grid between contours [mm] (by the size)",
              {.positive = true});
  options.flag("--largest", o->largest, "Only the largest part");
  options.flag("--model-axes", o->model_axes,
               "Turn a scan's axes (right, forwards, up) to the model's (backwards, right, up)");
  options.flag("--json", o->json, "One JSON object on standard output");
  options.footer("Example: genio surface jaw.csv --out jaw.obj --triangles 1450 --keep 12,0,-8,10");
  return [o] { return run_surface(*o); };
}

}  // namespace genio::cli
