#include "inverse/sequence/sequence_problem.hpp"

#include <atomic>
#include <cmath>
#include <thread>

namespace genio {

SequenceProblem::SequenceProblem(std::vector<std::unique_ptr<JointFrame>>& frames,
                                 std::vector<size_t> groups)
    : frames_(frames),
      groups_(std::move(groups)),
      count_(Eigen::Index(frames.front()->objective.unknowns().size())) {
  for (const Unknown& c : frames_.front()->objective.unknowns())
    walks_.push_back(c.kind != Unknown::Kind::pose);
  std::vector<PriorTerms> points;
  std::vector<double> steps;
  for (const auto& f : frames_) points.push_back(f->objective.prior()), steps.push_back(f->walk_sd);
  prior_ = chained(points, steps, walks_);
}

Vector SequenceProblem::unknowns_of(const Vector& u, size_t frame) const {
  return u.segment(count_ * Eigen::Index(frame), count_);
}

std::pair<Vector, Vector> SequenceProblem::walk_slopes(const Vector& u, size_t k) const {
  const auto slope = [&](size_t from, size_t to) {
    Vector s = (unknowns_of(u, k) - unknowns_of(u, from == k ? to : from)) /
               (frames_[to]->walk_sd * frames_[to]->walk_sd);
    for (size_t c = 0; c < walks_.size(); ++c)
      if (!walks_[c]) s[Eigen::Index(c)] = 0;
    return s;
  };
  return {k > 0 ? slope(k - 1, k) : Vector::Zero(count_),
          k + 1 < frames_.size() ? slope(k, k + 1) : Vector::Zero(count_)};
}

bool SequenceProblem::each(const std::function<bool(size_t)>& act) {
  std::atomic<bool> good = true;
  const auto work = [&](size_t group) {
    const size_t end = group + 1 < groups_.size() ? groups_[group + 1] : frames_.size();
    for (size_t k = groups_[group]; k < end && good; ++k)
      if (!act(k)) good = false;
  };
  std::vector<std::jthread> threads;
  for (size_t g = 1; g < groups_.size(); ++g) threads.emplace_back(work, g);
  work(0);
  threads.clear();
  if (!good)
    for (const auto& f : frames_)
      if (!f->objective.last_failure().empty()) failure_ = f->objective.last_failure();
  return good;
}

std::optional<double> SequenceProblem::value(const Vector& u) {
  std::vector<double> values(frames_.size());
  if (!each([&](size_t k) {
        const auto v = frames_[k]->objective.value(unknowns_of(u, k));
        if (v) values[k] = *v;
        return v.has_value();
      }))
    return {};
  double sum = prior_.walk.value(u);
  for (double v : values) sum += v;
  return sum;
}

std::shared_ptr<LocalModel> SequenceProblem::local(const Vector& u) {
  std::vector<std::optional<LocalShape>> found(frames_.size());
  if (!each([&](size_t k) {
        found[k] = frames_[k]->objective.local_shape(unknowns_of(u, k), int(count_) * int(k));
        return found[k].has_value();
      }))
    return nullptr;
  std::vector<LocalShape> shapes;
  for (auto& shape : found) shapes.push_back(std::move(*shape));
  if (accepted) accepted(u);
  return std::make_unique<LocalProblem>(std::move(shapes), prior_.all, u);
}

bool SequenceProblem::stopped() {
  for (auto& f : frames_)
    if (f->objective.stopped()) return true;
  return false;
}

double SequenceProblem::rms() const {
  double sum = 0;
  for (const auto& f : frames_) sum += std::pow(f->objective.rms(), 2);
  return std::sqrt(sum / double(frames_.size()));
}

}  // namespace genio
