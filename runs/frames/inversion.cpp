#include "runs/frames/inversion.hpp"

#include <fmt/format.h>

#include "inverse/prior/prior_file.hpp"
#include "inverse/recording/sensors/ssff.hpp"

namespace genio {
namespace {

constexpr double outlier_dof = 4;  // of Student's t

Prior checked_prior(const Model& model, const InversionOptions& o) {
  if (o.prior.empty()) return {};
  Prior prior = read_prior(o.prior);
  try {
    prior_terms(prior, unknowns_of(model, prior, o.bilateral));
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", o.prior, e.what()));
  }
  return prior;
}

/// Which frames were asked for matters where all are one problem; else each is one of its own, and
/// another range goes on where this one ends.
QuestionValue asked_range(const InversionOptions& o) {
  const FrameChoice& c = o.measured.choice;
  if (!o.joint()) return {};
  return fmt::format("{} {} {}", c.frames, fmt::join(c.labels, ","), c.recording);
}

/// All files of a target that names several of one take.
AskedFile asked_target(const std::string& target) {
  AskedFile asked{target, {}};
  for (const std::string& path : joined_paths(target)) asked.content += asked_file(path).content;
  return asked;
}

}  // namespace

std::vector<OptionFile> files_beside(InversionOptions& o) {
  return {{"--palate", &o.measured.palate},
          {"--bite-plane", &o.measured.bite_plane},
          {"--textgrid", &o.measured.choice.textgrid},
          {"--model", &o.model},
          {"--prior", &o.prior}};
}

void check(const InversionOptions& o) {
  if (!(o.movement.knot_s > 0) || !(o.movement.step_s > 0))
    throw InputError("--knot-s and --step-s: must be above 0");
}

Question question_of(const InversionOptions& o, double noise) {
  const MeasuredOptions& m = o.measured;
  return {{"genio", GENIO_VERSION},
          {"model", asked_file(o.model)},
          {"target", asked_target(m.target)},
          {"palate", asked_file(m.palate)},
          {"palate_sensor", m.palate_sensor},
          {"bite_plane", asked_file(m.bite_plane)},
          {"hyoid", m.hyoid},
          {"short_tendon", m.short_tendon},
          {"jaw_shadow", m.jaw_shadow},
          {"ignore_marks", m.ignore_marks},
          {"bite_plane_sensors", m.bite_plane_sensors},
          {"textgrid", asked_file(m.choice.textgrid)},
          {"tier", m.choice.tier},
          {"speaker", m.choice.speaker},
          {"frames", asked_range(o)},
          {"noise_mm", 1e3 * noise},
          {"format", m.read.format},
          {"units", m.read.units},
          {"mm_per_px", m.read.mm_per_px},
          {"facing", m.read.facing},
          {"y_grows", m.read.up},
          {"axes", m.read.axes},
          {"forced", m.force},
          {"sensors", m.sensors},
          {"columns", m.columns},
          {"spline", m.read.spline},
          {"points", m.read.points},
          {"palate_format", m.palate_format},
          {"palate_units", m.palate_units},
          {"palate_spline", m.palate_spline},
          {"rate_hz", m.read.rate_hz},
          {"registered", m.registered},
          {"prior", asked_file(o.prior)},
          {"deadline_s", o.deadline_s},
          {"starts", o.starts},
          {"bilateral", o.bilateral},
          {"robust", o.robust},
          {"sequence", o.sequence},
          {"full_space", o.full_space},
          {"smooth", o.smooth},
          {"dynamic", o.dynamic},
          {"knot_s", o.movement.knot_s},
          {"step_s", o.movement.step_s},
          {"from_rest", o.movement.from_rest},
          {"start_s", o.movement.start_s ? QuestionValue(*o.movement.start_s) : QuestionValue()}};
}

std::vector<Frame> frames_of(const Model& model, const std::vector<ContourFrame>& contours,
                             double noise, const InversionOptions& o) {
  for (const auto& [asked, option] :
       {std::pair{o.sequence, "--sequence"}, {o.smooth, "--smooth"}, {o.dynamic, "--dynamic"}})
    if (asked) {
      check_one_recording(contours, option, o.measured.target);
      check_times_rise(contours, option, o.measured.target);
    }
  try {
    return make_frames(model, contours, noise, o.robust ? outlier_dof : 0);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", o.measured.target, e.what()));
  }
}

FrameOptions frame_options(const Model& model, const InversionOptions& o,
                           const std::optional<HeadPosePrior>& head_pose) {
  FrameOptions options;
  options.prior = checked_prior(model, o);
  if (!options.prior.head_pose && head_pose && o.dynamic && o.measured.palate.empty())
    throw InputError(fmt::format(
        "--dynamic: takes the head's place as known, and without a palate it is within {:.1f} mm "
        "only; give --palate, or --registered where it is known",
        1e3 * head_pose->shift_sd));
  if (!options.prior.head_pose && !o.dynamic) options.prior.head_pose = head_pose;
  if (head_pose) options.infer.model_error = ModelError().of_another_speaker();
  options.infer.deadline_s = o.deadline_s;
  options.infer.full_space = o.full_space;
  if (o.bilateral) options.infer.bilateral = true;
  options.starts = {o.starts};
  return options;
}

std::optional<MotionAnswer> answer_jointly(const Model& model, const std::vector<Frame>& frames,
                                           const FrameOptions& options, const InversionOptions& o,
                                           int threads, const Checkpoint& checkpoint,
                                           const TakeProgress& progress, const TakeAnswer& take) {
  if (o.dynamic)
    return answer_movement(model, frames, options, o.movement, checkpoint, progress, take);
  answer_smooth(model, frames, options, threads, checkpoint, progress, take);
  return std::nullopt;
}

}  // namespace genio
