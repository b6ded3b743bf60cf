#pragma once
// How often what was said of muscles was true.

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "inverse/posterior/estimate.hpp"

namespace genio::bench {

/// The part of the tongue's muscles that one belongs to, by its bilateral name.
std::string muscle_group(const std::string& muscle);

/// Counts of one kind of target.
class CalibrationCount {
 public:
  /// An answer's estimates against the true forces [N] by bilateral name; each of two sides has
  /// half.
  void add(const std::vector<Estimate>& muscles, const std::map<std::string, double>& truth,
           Verdict verdict, double rms);
  /// One that did not converge.
  void add_failure() { ++targets_; }

  /// `targets, failed, explained, rms_mm_median, active, resting, width_of_active,
  /// acts_of_active, acts_of_resting, calibration_error, active_by_group, resting_by_group,
  /// active_by_muscle`: shares
  /// of 90 % intervals that hold the truth, null where there is none; the mean width of those of
  /// muscles that act, over the maximum; the mean probability to act that muscles were told; and
  /// the expected calibration error of it over ten bins (Naeini et al. 2015).
  nlohmann::json json() const;

 private:
  struct Share {
    int inside = 0, of = 0;
    void add(bool holds) { inside += holds, ++of; }
    nlohmann::json json() const;
  };
  /// Of muscles told to act with about the same probability.
  struct Bin {
    int count = 0, acting = 0;
    double told = 0;
  };
  double calibration_error() const;

  int targets_ = 0, answered_ = 0, explained_ = 0;
  Share active_, resting_;
  double width_ = 0, acts_of_active_ = 0, acts_of_resting_ = 0;
  std::array<Bin, 10> bins_ = {};
  std::map<std::string, Share> active_by_group_, resting_by_group_, active_by_muscle_;
  std::vector<double> rms_;
};

}  // namespace genio::bench
