#include "inverse/sequence_problem.hpp"

#include <atomic>
#include <cmath>
#include <thread>

namespace genio {

SequenceProblem::SequenceProblem(std::vector<std::unique_ptr<JointFrame>>& frames,
                                 std::vector<size_t> groups)
    : frames_(frames),
      groups_(std::move(groups)),
      count_(Eigen::Index(frames.front()->objective.commands().size())) {
  const auto n = count_ * Eigen::Index(frames_.size());
  for (const Command& c : frames_.front()->objective.commands())
    walks_.push_back(c.kind != Command::Kind::pose);
  lower_.resize(n), upper_.resize(n);
  std::vector<Eigen::Triplet<double>> own, steps;
  std::vector<double> values;
  int step = 0;
  for (size_t k = 0; k < frames_.size(); ++k) {
    const PriorTerms& terms = frames_[k]->objective.prior();
    const auto first = count_ * Eigen::Index(k);
    lower_.segment(first, count_) = terms.lower, upper_.segment(first, count_) = terms.upper;
    for (Eigen::Index r = 0; r < terms.rows.rows(); ++r) {
      for (Eigen::Index c = 0; c < count_; ++c)
        if (terms.rows(r, c) != 0) own.emplace_back(int(values.size()), int(first + c), terms.rows(r, c));
      values.push_back(terms.values[r]);
    }
    for (Eigen::Index c = 0; k > 0 && c < count_; ++c) {
      if (!walks_[size_t(c)]) continue;
      steps.emplace_back(step, int(first + c), 1 / frames_[k]->walk_sd);
      steps.emplace_back(step++, int(first - count_ + c), -1 / frames_[k]->walk_sd);
    }
  }
  const int of_frames = int(values.size());
  walk_.rows.resize(step, n);
  walk_.rows.setFromTriplets(steps.begin(), steps.end());
  walk_.values = Vector::Zero(step);
  for (auto& e : steps) own.emplace_back(of_frames + e.row(), e.col(), e.value());
  prior_.rows.resize(of_frames + step, n);
  prior_.rows.setFromTriplets(own.begin(), own.end());
  prior_.values = Vector::Zero(of_frames + step);
  prior_.values.head(of_frames) = Eigen::Map<const Vector>(values.data(), of_frames);
}

Vector SequenceProblem::unknowns_of(const Vector& u, size_t frame) const {
  return u.segment(count_ * Eigen::Index(frame), count_);
}

std::vector<Vector> SequenceProblem::by_frame(const Vector& u) const {
  std::vector<Vector> result;
  for (size_t k = 0; k < frames_.size(); ++k) result.push_back(unknowns_of(u, k));
  return result;
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
  double sum = walk_.value(u);
  for (double v : values) sum += v;
  return sum;
}

std::unique_ptr<LocalProblem> SequenceProblem::local(const Vector& u) {
  std::vector<std::optional<LocalShape>> found(frames_.size());
  if (!each([&](size_t k) {
        found[k] = frames_[k]->objective.local_shape(unknowns_of(u, k), int(count_) * int(k));
        return found[k].has_value();
      }))
    return nullptr;
  std::vector<LocalShape> shapes;
  for (auto& shape : found) shapes.push_back(std::move(*shape));
  if (accepted) accepted(u);
  return std::make_unique<LocalProblem>(std::move(shapes), prior_, u);
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
