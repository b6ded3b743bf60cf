#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/offline.hpp"
#include "cli/progress_line.hpp"
#include "cli/result_log.hpp"
#include "cli/together.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/prior/prior_file.hpp"
#include "inverse/recording/frame_target.hpp"
#include "report/run_summary.hpp"

namespace genio::cli {
namespace {

constexpr double outlier_dof = 4;  // of Student's t

struct InvertOptions {
  MeasuredOptions measured;
  std::string model = default_model(), out, prior;
  double deadline_s = 0;
  int starts = 0, threads = 1;
  bool bilateral = false, robust = false, sequence = false, resume = false, json = false;
  bool full_space = false;
  bool smooth = false;
  TogetherOptions together;
};

/// All of them before the first is worked on: a bad point should not end hours of work.
std::vector<Frame> all_frames(const Model& model, const Measured& measured,
                              const InvertOptions& o) {
  std::vector<Frame> frames;
  try {
    for (const ContourFrame& contour : measured.frames) {
      frames.push_back({contour, make_target(model, contour, measured.noise)});
      if (o.robust) frames.back().target.outlier_dof = outlier_dof;
    }
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", o.measured.target, e.what()));
  }
  return frames;
}

/// Errors name the file; a wrong muscle should not wait for the first frame.
Prior checked_prior(const Model& model, const InvertOptions& o) {
  if (o.prior.empty()) return {};
  const Prior prior = read_prior(o.prior);
  try {
    prior_terms(prior, unknowns_of(model, prior, o.bilateral));
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", o.prior, e.what()));
  }
  return prior;
}

/// Everything an answer depends on.
nlohmann::json question(const InvertOptions& o, double noise) {
  return {{"model", o.model},
          {"target", o.measured.target},
          {"palate", o.measured.palate},
          {"noise_mm", 1e3 * noise},
          {"units", o.measured.read.units},
          {"mm_per_px", o.measured.read.mm_per_px},
          {"facing", o.measured.read.facing},
          {"sensors", o.measured.sensors},
          {"registered", o.measured.registered},
          {"prior", o.prior},
          {"starts", o.starts},
          {"bilateral", o.bilateral},
          {"robust", o.robust},
          {"sequence", o.sequence},
          {"full_space", o.full_space},
          {"smooth", o.smooth},
          {"dynamic", o.together.dynamic},
          {"knot_s", o.together.knot_s},
          {"step_s", o.together.step_s},
          {"from_rest", o.together.from_rest},
          {"start_s", o.together.start_s ? nlohmann::json(*o.together.start_s) : nlohmann::json()}};
}

int run(const InvertOptions& o) {
  const bool together = o.smooth || o.together.dynamic;
  if (o.smooth + o.together.dynamic + o.sequence > 1)
    throw InputError("--sequence, --smooth and --dynamic: one of them");
  if (!(o.together.knot_s > 0) || !(o.together.step_s > 0))
    throw InputError("--knot-s and --step-s: must be above 0");
  if (o.resume && o.out.empty()) throw InputError("--resume: needs the --out of the earlier run");
  const Model model = read_model(o.model);
  const Measured measured = read_measured(o.measured, [&]() -> const Model& { return model; });
  std::vector<Frame> frames = all_frames(model, measured, o);
  OfflineOptions offline{checked_prior(model, o), {}, {o.starts}, o.sequence, o.out};
  offline.infer.deadline_s = o.deadline_s;
  offline.infer.full_space = o.full_space;
  if (o.bilateral) offline.infer.bilateral = true;

  std::optional<ResultLog> log;
  if (!o.out.empty()) log.emplace(o.out, question(o, measured.noise), o.resume);
  std::map<int, nlohmann::json> answers;
  if (log) answers = log->known();
  const std::vector<Frame> everything = together ? frames : std::vector<Frame>();
  std::vector<Frame> open;
  for (Frame& frame : frames)
    if (!answers.contains(frame.contour.number)) open.push_back(std::move(frame));
  if (!answers.empty())
    fmt::print(stderr, "{} of {} frames are known from the run before\n", answers.size(),
               frames.size());

  ProgressLine progress(int(answers.size()), int(frames.size()));
  // Runs of neighbours, as each frame starts where the one before ended.
  const int workers = std::clamp(o.threads, 1, std::max(1, int(open.size())));
  const auto share = [&](int k) { return open.size() * size_t(k) / size_t(workers); };
  const auto collect = [&](const nlohmann::json& result) {
    const auto& answer = result["answer"];
    if (log) log->add(answer);
    answers[answer["frame"].get<int>()] = answer;
    if (o.json) fmt::print("{}\n", answer.dump());
    else
      fmt::print("{}\n{}\n", result["title"].get<std::string>(),
                 result["table"].get<std::string>());
    std::fflush(stdout);
    progress.step();
  };
  if (together) {
    TogetherOptions how = o.together;
    how.threads = o.threads, how.resume = o.resume;
    if (!open.empty())
      answer_together(model, everything, offline, how, [&](const auto& result) {
        if (!answers.contains(result["answer"]["frame"].template get<int>())) collect(result);
      });
  } else {
    in_processes(
        workers,
        [&](int k, const Send& send) {
          const std::vector<Frame> mine(open.begin() + long(share(k)),
                                        open.begin() + long(share(k + 1)));
          nlohmann::json before;
          if (!mine.empty())
            if (const auto it = answers.find(mine.front().contour.number - 1); it != answers.end())
              before = it->second;
          answer_frames(model, mine, offline, before, send);
        },
        collect);
  }
  if (frames.size() > 1) fmt::print(stderr, "{}", summary_text(answers));
  if (log) write_summary(answers, o.out);
  return std::all_of(answers.begin(), answers.end(),
                     [](const auto& a) { return a.second.value("status", "") == "converged"; })
             ? done
             : no_answer;
}

}  // namespace

Runner add_invert(CLI::App& app) {
  auto o = std::make_shared<InvertOptions>();
  app.add_option("--model", o->model, "Model folder or model.toml");
  add_measured_options(app, o->measured);
  app.add_option("--prior", o->prior, "What is believed before: TOML, or a CSV of EMG");
  app.add_option("--starts", o->starts,
                 "Descents a frame; more find other answers that fit (0: until the shape is "
                 "explained)")
      ->check(CLI::Range(0, 1000));
  app.add_flag("--sequence", o->sequence, "Activations walk from frame to frame");
  app.add_flag("--smooth", o->smooth, "The same, all frames as one smoothing problem");
  app.add_flag("--dynamic", o->together.dynamic,
               "All frames as one movement, with inertia and viscosity");
  app.add_option("--knot-s", o->together.knot_s, "--dynamic: between bends of the commands [s]")
      ->capture_default_str();
  app.add_option("--step-s", o->together.step_s, "--dynamic: time step [s]")->capture_default_str();
  app.add_option("--start-s", o->together.start_s,
                 "--dynamic: when the movement starts [s] (0.1 s before the first frame)");
  app.add_flag("--from-rest", o->together.from_rest,
               "--dynamic: starts without commands; else from a posture that is found along");
  app.add_flag("--full-space", o->full_space,
               "Positions and commands together as unknowns: slower, to check the default by");
  app.add_flag("--robust", o->robust, "Noise with outliers (Student's t)");
  app.add_flag("--bilateral", o->bilateral, "Left and right together");
  app.add_option("--deadline-s", o->deadline_s, "Time a frame may take");
  app.add_option("--threads", o->threads,
                 "Worker processes, each with a run of neighbouring frames")
      ->check(CLI::Range(1, 256));
  app.add_flag("--json", o->json, "One JSON object a frame on standard output");
  app.add_option("--out", o->out, "Folder for results.jsonl, a summary, pictures and shapes");
  app.add_flag("--resume", o->resume, "Take up an interrupted run with the same --out");
  app.footer("Example: genio invert --target data/examples/example_shape.csv --out results");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
