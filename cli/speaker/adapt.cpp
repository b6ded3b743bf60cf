#include "cli/speaker/adapt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/option_sets/changed_model.hpp"
#include "cli/option_sets/measured_options.hpp"
#include "cli/support.hpp"
#include "forward/base/elapsed.hpp"
#include "forward/base/median.hpp"
#include "forward/effects/tissue/named_tissue.hpp"
#include "forward/model/build_model.hpp"
#include "speaker/adaptation/adapt.hpp"
#include "speaker/adaptation/stack_sides.hpp"
#include "speaker/modes/mode_fields.hpp"
#include "speaker/modes/modes_file.hpp"
#include "speaker/modes/recorded_sight.hpp"
#include "speaker/modes/speaker_sight.hpp"

namespace genio::cli {
namespace {

struct AdaptCommand {
  std::string model = default_model(), modes = default_modes();
  std::string outline, contours, slices, surface, tissue, out;
  MeasuredOptions measured;  ///< its palate and speaker are an outline's too
  ModelChanges changes;
  bool json = false;
};

/// A model with the speaker's place among others, where an outline or parts of one tell it.
struct AdaptedSpeaker {
  Adaptation adaptation;
  OutlineModes modes;
  std::optional<AnatomyEstimate> estimate;
  bool from_parts = false;             ///< the outline is the estimate's, not a measured one
  std::optional<int> rest_frame = {};  ///< of a recording, that stands for the rest
  std::vector<std::string> notes = {};
};

double mode_sd(const AnatomyEstimate& e, Eigen::Index k) {
  return std::sqrt(std::max(0.0, e.covariance(k, k)));
}

/// Of the points of the tongue's own line, the median standard deviation [m].
double outline_sd(const AnatomyEstimate& e) {
  std::vector<double> sd(e.sd.begin(), e.sd.begin() + 2 * outline_stretch("palate").first);
  return median(std::move(sd));
}

nlohmann::ordered_json adapt_json(const AdaptCommand& o, const AdaptedSpeaker& s, double wall) {
  const Adaptation& a = s.adaptation;
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
  auto &modes = j["modes"] = nlohmann::ordered_json::object(),
       &sd = j["modes_sd"] = nlohmann::ordered_json::object();
  if (s.estimate) {
    for (Eigen::Index k = 0; k < s.modes.named(); ++k)
      modes[s.modes.names[size_t(k)]] = s.estimate->values[k],
      sd[s.modes.names[size_t(k)]] = mode_sd(*s.estimate, k);
    j["outline_from_parts"] = s.from_parts;
    j["outline_sd_mm"] = outline_sd(*s.estimate) * 1e3;
    j["sight_rms_mm"] = s.estimate->rms * 1e3;
    if (s.rest_frame) j["rest_frame"] = *s.rest_frame;
  }
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

/// What is not known of the anatomy, as a prior for inversions with the model.
void write_anatomy_prior(const AdaptedSpeaker& s, const std::string& path) {
  std::ofstream out(path);
  out << "# Modes of anatomy about this model, in standard deviations among speakers.\n"
         "[parameter]\n";
  for (Eigen::Index k = 0; k < s.modes.named(); ++k)
    out << fmt::format("\"anatomy.{}\" = {{ mean = 0, sd = {:.4f} }}\n", s.modes.names[size_t(k)],
                       mode_sd(*s.estimate, k));
  out.flush();
  if (!out) throw InputError(path + ": cannot be written");
}

AdaptedSpeaker adapted_to_sight(const AdaptCommand& o, const ModelDescription& base,
                                const SpeakerSight& sight, const std::string& source) {
  AdaptedSpeaker s{{}, read_outline_modes(o.modes), {}, true};
  s.estimate = estimate_as_it_faces(s.modes, sight, source);
  s.adaptation = adapt_model(base, o.model, sighted_outline(*s.estimate, sight, source), {});
  return s;
}

AdaptedSpeaker adapted_to_recording(const AdaptCommand& o, const ModelDescription& base) {
  std::vector<std::string> notes;
  const Unregistered seen =
      read_unregistered(o.measured, [&](const std::string& remark) { notes.push_back(remark); });
  const RecordedSight sight = sight_of_recording(seen.frames, seen.palate, seen.noise);
  AdaptedSpeaker s = adapted_to_sight(o, base, sight.sight, o.measured.target);
  s.rest_frame = sight.frame, s.notes = std::move(notes);
  s.notes.push_back(
      fmt::format("{}: the middle of its frames stands for the tongue at rest; frame {} lies "
                  "nearest to all others",
                  o.measured.target, sight.frame));
  return s;
}

AdaptedSpeaker adapted(const AdaptCommand& o, const ModelDescription& base) {
  if (!o.measured.target.empty()) return adapted_to_recording(o, base);
  if (!o.contours.empty())
    return adapted_to_sight(o, base, sight_of_files({o.measured.palate, o.contours}), o.contours);
  const std::optional<SpeakerSurface> surface = given_surface(o);
  if (o.outline.empty()) {
    if (o.surface.empty())
      throw InputError(
          "adapt: expected --outline FILE, --palate FILE with --target FILE or --contours FILE, or "
          "--surface FILE alone");
    return {adapt_to_surface(base, o.model, *surface), {}, {}, false};
  }
  SpeakerOutline outline = read_outline(o.outline, o.measured.choice.speaker);
  if (!o.measured.palate.empty()) read_outline_palate(o.measured.palate, outline);
  AdaptedSpeaker s{
      adapt_model(base, o.model, outline, surface), read_outline_modes(o.modes), {}, false};
  s.estimate = estimate_of_outline(s.modes, s.adaptation.outline);
  return s;
}

/// With the tissue and the effects that the command line asks for; its origin tells of them.
ModelDescription with_chosen_tissue(const AdaptCommand& o, ModelDescription d) {
  if (!o.tissue.empty()) {
    d.effects["elasticity"] = named_tissue(o.tissue);
    d.provenance += fmt::format("; {} tissue", o.tissue);
  }
  d = changed_description(std::move(d), o.changes);
  for (const std::string& effect : o.changes.effects) d.provenance += "; " + effect;
  for (const std::string& effect : o.changes.without) d.provenance += "; without " + effect;
  return d;
}

int run_adapt(const AdaptCommand& o) {
  const Stopwatch watch;
  const ModelDescription base = read_description(o.model);
  AdaptedSpeaker s = adapted(o, base);
  Adaptation& a = s.adaptation;
  const std::string name = s.from_parts        ? o.measured.target + o.contours
                           : o.outline.empty() ? o.surface + o.slices
                                               : o.outline;
  if (a) {
    if (s.estimate) {
      const auto fields = mode_fields(s.modes, a.model, o.out);
      a.model = with_modes(std::move(a.model), fields);
    }
    a.model = with_chosen_tissue(o, std::move(a.model));
    build_model(a.model, o.out);  // refuses what could not be computed with
    write_description(a.model, o.out);
    if (s.from_parts)
      write_anatomy_prior(s, (std::filesystem::path(o.out) / "prior.toml").string());
  }
  if (o.json) fmt::print("{}\n", adapt_json(o, s, watch.seconds()).dump());
  for (const std::string& note : s.notes) print_line(note);
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
  options.add(
      "--target", o->measured.target,
      "A recording of the speaker, as genio invert reads it: the frame that lies nearest to "
      "all others stands for rest, and what nobody saw is estimated from 41 speakers",
      {.only_with = {"--palate"}, .not_with = {"--outline", "--surface", "--contours"}});
  options.add(
      "--contours", o->contours,
      "Contours of the tongue at rest in the palate's frame, x backwards, in the place of a "
      "recording",
      {.only_with = {"--palate"}, .not_with = {"--outline", "--surface"}});
  options.add("--palate", o->measured.palate,
              "Palate of the same origin, in the place of the outline's; of a recording a trace of "
              "the same session",
              {});
  options.add("--speaker", o->measured.choice.speaker,
              "Whose rows to take, where the file has several",
              {.only_with = {"--outline", "--target"}});
  const std::vector<std::string> of_recordings = {"--target"};
  add_reading_options(options, o->measured, of_recordings);
  add_choice_options(options, o->measured.choice, of_recordings);
  options.add("--noise-mm", o->measured.noise_mm, "Measurement noise of the recording",
              {.positive = true, .only_with = of_recordings});
  options.add("--modes", o->modes, "How speakers' outlines vary (data/anatomy/outline_modes.csv)");
  options.add("--slices", o->slices,
              "Closed coronal contours of the tongue in the outline's frame (CSV: slice, point, "
              "x_mm, y_mm, z_mm)",
              {.only_with = {"--outline"}, .not_with = {"--surface"}});
  options.add("--surface", o->surface,
              "Closed surface of the tongue in metres (OBJ, STL, PLY), in the outline's frame or, "
              "alone, in the model's axes");
  options.add("--tissue", o->tissue, "Constants of the tissue, where not the base model's",
              {.among = {"living", "cadaver"}});
  options.add("--effect", o->changes.effects,
              "NAME.param=VALUE, SI units: an effect that the model is to have, such as "
              "mucosa_layer or active_stiffening");
  options.add("--without", o->changes.without, "Leave an effect of the base model out");
  options.add("--out", o->out, "Model folder to write", {.required = true});
  options.flag("--json", o->json, "One JSON object on standard output");
  options.footer("Example: genio adapt --outline data/examples/adapt/outline.csv --out mine");
  return [o] { return run_adapt(*o); };
}

}  // namespace genio::cli
