#include "bench/truths/calibration_count.hpp"

#include <algorithm>
#include <cmath>

#include "bench/problems/clock.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio::bench {

std::string muscle_group(const std::string& muscle) {
  static const std::map<std::string, std::vector<std::string>> members_of = {
      {"genioglossus", {"GGP", "GGM", "GGA"}},
      {"other extrinsic", {"STY", "HG", "PG"}},
      {"intrinsic", {"VERT", "TRANS", "IL", "SL"}},
      {"floor", {"GH", "MH"}}};
  for (const auto& [group, members] : members_of)
    if (std::find(members.begin(), members.end(), muscle) != members.end()) return group;
  return "other";
}

nlohmann::json CalibrationCount::Share::json() const {
  return of == 0 ? nlohmann::json() : nlohmann::json(double(inside) / of);
}

void CalibrationCount::add(const std::vector<Estimate>& muscles,
                           const std::map<std::string, double>& truth, Verdict verdict,
                           double rms) {
  ++targets_, ++answered_;
  explained_ += verdict == Verdict::explained;
  rms_.push_back(rms);
  for (const Estimate& e : muscles) {
    const std::string both = bilateral_name(e.name);
    const auto found = truth.find(both);
    const double force = found == truth.end() ? 0 : found->second / (both == e.name ? 1 : 2);
    const bool holds = force >= e.low - 1e-9 && force <= e.high + 1e-9;
    const std::string group = muscle_group(both);
    (force > 0 ? active_ : resting_).add(holds);
    (force > 0 ? active_by_group_ : resting_by_group_)[group].add(holds);
    if (force > 0) active_by_muscle_[both].add(holds);
    (force > 0 ? acts_of_active_ : acts_of_resting_) += e.acts;
    if (force > 0) width_ += (e.high - e.low) / e.maximum;
    if (!std::isfinite(e.acts)) continue;
    Bin& bin = bins_[std::min(bins_.size() - 1, size_t(e.acts * double(bins_.size())))];
    ++bin.count, bin.acting += force > 0, bin.told += e.acts;
  }
}

double CalibrationCount::calibration_error() const {
  double off = 0, all = 0;
  for (const Bin& bin : bins_) off += std::abs(bin.told - bin.acting), all += bin.count;
  return off / all;
}

nlohmann::json CalibrationCount::json() const {
  const auto by = [](const std::map<std::string, Share>& shares) {
    nlohmann::json json = nlohmann::json::object();
    for (const auto& [name, share] : shares) json[name] = share.json();
    return json;
  };
  const auto part = [&](int count) {
    return answered_ == 0 ? nlohmann::json() : nlohmann::json(double(count) / answered_);
  };
  const auto mean = [](double sum, const Share& share) {
    return share.of == 0 ? nlohmann::json() : nlohmann::json(sum / share.of);
  };
  return {{"targets", targets_},
          {"failed", targets_ - answered_},
          {"explained", part(explained_)},
          {"rms_mm_median", rms_.empty() ? nlohmann::json() : nlohmann::json(1e3 * median(rms_))},
          {"active", active_.json()},
          {"resting", resting_.json()},
          {"width_of_active", mean(width_, active_)},
          {"acts_of_active", mean(acts_of_active_, active_)},
          {"acts_of_resting", mean(acts_of_resting_, resting_)},
          {"calibration_error", calibration_error()},
          {"active_by_group", by(active_by_group_)},
          {"resting_by_group", by(resting_by_group_)},
          {"active_by_muscle", by(active_by_muscle_)}};
}

}  // namespace genio::bench
