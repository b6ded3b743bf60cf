#include "runs/frames/frame_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "forward/base/nearest_name.hpp"
#include "inverse/recording/base/table_text.hpp"
#include "runs/frames/labelled_frames.hpp"

namespace genio {
namespace {

using Frames = std::vector<ContourFrame>;

[[noreturn]] void refuse_range(const std::string& text) {
  throw InputError(
      fmt::format("--frames {}: expected A-B with 1 <= A <= B, or times as in 1.2s-1.8s", text));
}

/// The first and last of "3-9" or "1.2s-1.8s", without the s; both the same where there is one.
std::pair<std::string, std::string> ends_of(const std::string& text) {
  const auto dash = text.find('-');
  if (dash == std::string::npos) return {text, text};
  return {text.substr(0, dash), text.substr(dash + 1)};
}

double whole(const std::string& end, const std::string& text) {
  double value = 0;
  if (!parse_number(end, value) || value < 1 || value > 1e9 || value != std::floor(value) ||
      end.find_first_not_of("0123456789") != std::string::npos)
    refuse_range(text);
  return value;
}

double seconds(const std::string& end, const std::string& text) {
  double value = 0;
  if (end.size() < 2 || end.back() != 's' || !parse_number(end.substr(0, end.size() - 1), value) ||
      value < 0)
    refuse_range(text);
  return value;
}

std::string span_of(const Frames& frames) {
  const auto [first, last] =
      std::minmax_element(frames.begin(), frames.end(),
                          [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return fmt::format("{:.3f} to {:.3f} s", first->time_s, last->time_s);
}

Frames by_number(Frames frames, const std::string& text, const std::string& path,
                 const std::function<void(const std::string&)>& remark) {
  const auto [a, b] = ends_of(text);
  const double first = whole(a, text), last = whole(b, text);
  if (last < first) refuse_range(text);
  const auto ends =
      std::minmax_element(frames.begin(), frames.end(),
                          [](const auto& p, const auto& q) { return p.number < q.number; });
  const int lowest = ends.first->number, highest = ends.second->number;
  Frames kept;
  for (ContourFrame& f : frames)
    if (f.number >= first && f.number <= last) kept.push_back(std::move(f));
  if (kept.empty())
    throw InputError(fmt::format("--frames {}: {} has no such frame; its frames are {} to {}", text,
                                 path, lowest, highest));
  if (b != a && highest < last && remark)
    remark(fmt::format("--frames {}: the last frame there is {}", text, highest));
  return kept;
}

Frames by_time(Frames frames, const std::string& text, const std::string& path) {
  const auto [a, b] = ends_of(text);
  const double first = seconds(a, text), last = seconds(b, text);
  if (last < first) refuse_range(text);
  if (std::isnan(frames.front().time_s))
    throw InputError(
        fmt::format("--frames {}: {} gives no times; choose frames by their numbers", text, path));
  constexpr double exact = 1e-9;
  const std::string span = span_of(frames);
  Frames kept;
  if (a == b) {
    const double away = half_spacing(frames) + exact;
    const auto nearest = std::min_element(frames.begin(), frames.end(), [&](auto& p, auto& q) {
      return std::abs(p.time_s - first) < std::abs(q.time_s - first);
    });
    if (std::abs(nearest->time_s - first) <= away) kept.push_back(*nearest);
  } else {
    for (ContourFrame& f : frames)
      if (f.time_s >= first - exact && f.time_s <= last + exact) kept.push_back(std::move(f));
  }
  if (kept.empty())
    throw InputError(
        fmt::format("--frames {}: {} has no frame then; its times are {}", text, path, span));
  return kept;
}

Frames by_label(Frames frames, const std::vector<std::string>& labels, const std::string& from) {
  std::set<std::string> all;
  for (const ContourFrame& f : frames) all.insert(f.label);
  all.erase("");
  if (all.empty())
    throw InputError(fmt::format("--labels {}: {} gives its frames no labels; give a --textgrid",
                                 fmt::join(labels, ","), from));
  for (const std::string& label : labels)
    if (!all.contains(label))
      throw InputError(fmt::format("--labels {}: {} has no such label; did you mean {}?", label,
                                   from, nearest_name(label, {all.begin(), all.end()})));
  Frames kept;
  for (ContourFrame& f : frames)
    if (std::find(labels.begin(), labels.end(), f.label) != labels.end())
      kept.push_back(std::move(f));
  return kept;
}

/// "r1", or "r1 of speaker S2": what a frame belongs to.
std::string take_of(const ContourFrame& f) {
  return f.speaker.empty() ? f.recording : fmt::format("{} of speaker {}", f.recording, f.speaker);
}

std::set<std::string> takes_of(const Frames& frames) {
  std::set<std::string> takes;
  for (const ContourFrame& f : frames) takes.insert(take_of(f));
  return takes;
}

/// A few names, and how many more.
std::string some_of(const std::set<std::string>& names) {
  constexpr size_t most = 5;
  std::vector<std::string> first(names.begin(),
                                 std::next(names.begin(), std::min(most, names.size())));
  return names.size() <= most
             ? fmt::format("{}", fmt::join(first, ", "))
             : fmt::format("{} and {} more", fmt::join(first, ", "), names.size() - most);
}

Frames frames_of_recording(Frames frames, const std::string& recording, const std::string& path) {
  std::set<std::string> all;
  for (const ContourFrame& f : frames) all.insert(f.recording);
  if (!all.contains(recording))
    throw InputError(
        fmt::format("--recording {}: {} has {}", recording, path,
                    all == std::set<std::string>{""} ? "no names of recordings" : some_of(all)));
  std::erase_if(frames, [&](const ContourFrame& f) { return f.recording != recording; });
  return frames;
}

/// Answers are kept by the number of their frame.
void check_numbers(const Frames& frames, const std::string& path) {
  std::map<int, const ContourFrame*> seen;
  for (const ContourFrame& f : frames) {
    const auto [it, fresh] = seen.try_emplace(f.number, &f);
    if (fresh) continue;
    const std::string one = take_of(*it->second), other = take_of(f);
    throw InputError(
        one == other
            ? fmt::format("{}: has two frames {}; number them apart", path, f.number)
            : fmt::format(
                  "{}: {} and {} both have a frame {}, and answers go by numbers; choose one "
                  "with {}",
                  path, one, other, f.number,
                  it->second->recording == f.recording ? "--speaker" : "--recording"));
  }
}

/// Formats without times leave them all at 0.
void forget_missing_times(Frames& frames) {
  if (std::all_of(frames.begin(), frames.end(), [](const auto& f) { return f.time_s == 0; }))
    for (ContourFrame& f : frames) f.time_s = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<ContourFrame> of_one_speaker(std::vector<ContourFrame> frames,
                                         const FrameChoice& choice, const std::string& path) {
  std::set<std::string> speakers;
  for (const ContourFrame& f : frames)
    if (!f.points.empty()) speakers.insert(f.speaker);
  if (choice.speaker.empty()) {
    if (speakers.size() > 1)
      throw InputError(fmt::format(
          "{}: holds {} speakers ({}), and one registration does not place two heads; choose one "
          "with --speaker",
          path, speakers.size(), fmt::join(speakers, ", ")));
    return frames;
  }
  if (!speakers.contains(choice.speaker))
    throw InputError(fmt::format("--speaker {}: {} has {}", choice.speaker, path,
                                 speakers.empty() || speakers.rbegin()->empty()
                                     ? "no names of speakers"
                                     : fmt::format("{}", fmt::join(speakers, ", "))));
  std::erase_if(frames, [&](const ContourFrame& f) { return f.speaker != choice.speaker; });
  return frames;
}

void check_one_recording(const std::vector<ContourFrame>& frames, const std::string& option,
                         const std::string& path) {
  const auto takes = takes_of(frames);
  if (takes.size() < 2) return;
  std::set<std::string> recordings;
  for (const ContourFrame& f : frames) recordings.insert(f.recording);
  throw InputError(fmt::format(
      "{}: makes one problem of all frames, and {} has {} recordings ({}); choose one with {}",
      option, path, takes.size(), some_of(takes),
      recordings.size() > 1 ? "--recording" : "--speaker"));
}

void check_times_rise(const std::vector<ContourFrame>& frames, const std::string& option,
                      const std::string& path) {
  for (size_t k = 1; k < frames.size(); ++k)
    if (frames[k].time_s < frames[k - 1].time_s)
      throw InputError(fmt::format(
          "{}: takes frames for one movement, and in {} the time falls from {:.3f} s to {:.3f} s "
          "at frame {}: does another take begin there? Choose one with --frames",
          option, path, frames[k - 1].time_s, frames[k].time_s, frames[k].number));
}

std::vector<ContourFrame> chosen_frames(std::vector<ContourFrame> frames, const FrameChoice& choice,
                                        const std::string& path,
                                        const std::function<void(const std::string&)>& remark) {
  if (frames.empty()) throw InputError(path + ": has no frame");
  forget_missing_times(frames);
  if (!choice.tier.empty() && choice.textgrid.empty())
    throw InputError(
        fmt::format("--tier {}: is of a TextGrid; give it with --textgrid", choice.tier));
  if (!choice.recording.empty())
    frames = frames_of_recording(std::move(frames), choice.recording, path);
  if (!choice.frames.empty())
    frames = choice.frames.find('s') != std::string::npos
                 ? by_time(std::move(frames), choice.frames, path)
                 : by_number(std::move(frames), choice.frames, path, remark);
  if (!choice.textgrid.empty())
    frames = labelled_frames(std::move(frames), choice.textgrid, choice.tier, path, remark);
  if (!choice.labels.empty())
    frames = by_label(std::move(frames), choice.labels,
                      choice.textgrid.empty() ? path : choice.textgrid);
  check_numbers(frames, path);
  return frames;
}

}  // namespace genio
