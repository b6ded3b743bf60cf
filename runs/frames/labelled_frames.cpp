#include "runs/frames/labelled_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "forward/base/median.hpp"
#include "inverse/recording/textgrid.hpp"

namespace genio {
namespace {

/// Those of the one recording that the TextGrid is of.
std::vector<ContourFrame> of_recording(std::vector<ContourFrame> frames,
                                       const std::string& textgrid, const std::string& path) {
  std::set<std::string> recordings;
  for (const ContourFrame& f : frames) recordings.insert(f.recording);
  if (recordings.size() == 1) return frames;
  const std::string stem = std::filesystem::path(textgrid).stem().string();
  std::erase_if(frames, [&](const ContourFrame& f) { return f.recording != stem; });
  if (frames.empty())
    throw InputError(fmt::format(
        "--textgrid {}: is of one recording, and {} holds {}: {}; name the TextGrid after its own",
        textgrid, path, recordings.size(), fmt::join(recordings, ", ")));
  return frames;
}

size_t nearest(const std::vector<ContourFrame>& frames, double time_s) {
  size_t best = 0;
  for (size_t k = 1; k < frames.size(); ++k)
    if (std::abs(frames[k].time_s - time_s) < std::abs(frames[best].time_s - time_s)) best = k;
  return best;
}

std::string first_few(const std::vector<std::string>& labels) {
  const size_t shown = std::min<size_t>(labels.size(), 5);
  return fmt::format("{}{}", fmt::join(labels.begin(), labels.begin() + long(shown), ", "),
                     shown < labels.size() ? ", ..." : "");
}

}  // namespace

double half_spacing(const std::vector<ContourFrame>& frames) {
  std::vector<double> times, gaps;
  for (const ContourFrame& f : frames) times.push_back(f.time_s);
  std::sort(times.begin(), times.end());
  for (size_t k = 1; k < times.size(); ++k)
    if (times[k] > times[k - 1]) gaps.push_back(times[k] - times[k - 1]);
  return 0.5 * median(std::move(gaps));
}

std::vector<ContourFrame> labelled_frames(std::vector<ContourFrame> frames,
                                          const std::string& textgrid, const std::string& name,
                                          const std::string& path,
                                          const std::function<void(const std::string&)>& remark) {
  const auto tiers = read_textgrid(textgrid);
  const TextGridTier& tier = tier_named(tiers, name, textgrid);
  frames = of_recording(std::move(frames), textgrid, path);
  if (std::isnan(frames.front().time_s))
    throw InputError(fmt::format("--textgrid {}: labels frames by their times, and {} gives none",
                                 textgrid, path));
  const double reach = half_spacing(frames) + 1e-9;
  std::map<size_t, std::string> chosen;
  std::vector<std::string> missed, shared;
  int labelled = 0;
  for (const TimedLabel& l : tier.labels) {
    if (l.label.empty()) continue;
    ++labelled;
    const size_t k = nearest(frames, l.middle_s());
    const double away = std::abs(frames[k].time_s - l.middle_s());
    if (away > std::max(reach, 0.5 * (l.last_s - l.first_s))) {
      missed.push_back(l.label);
      continue;
    }
    const auto [at, fresh] = chosen.try_emplace(k, l.label);
    if (fresh) continue;
    shared.push_back(l.label);
    at->second += " + " + l.label;
  }
  if (labelled == 0)
    throw InputError(fmt::format("--tier {}: all labels of {} are empty", tier.name, textgrid));
  if (chosen.empty())
    throw InputError(
        fmt::format("--textgrid {}: its {} labels lie where {} has no frame, whose times are "
                    "{:.3f} to {:.3f} s",
                    textgrid, labelled, path, frames.front().time_s, frames.back().time_s));
  if (!missed.empty())
    remark(fmt::format("{} of {} labels lie where there is no frame: {}", missed.size(), labelled,
                       first_few(missed)));
  if (!shared.empty())
    remark(fmt::format("{} labels share a frame with the label before: {}", shared.size(),
                       first_few(shared)));
  std::vector<ContourFrame> result;
  for (auto& [k, label] : chosen) {
    result.push_back(std::move(frames[k]));
    result.back().label = std::move(label);
  }
  return result;
}

}  // namespace genio
