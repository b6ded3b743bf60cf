#pragma once
// What Gerard, Perrier & Payan, "3D biomechanical tongue modeling to study speech production",
// section 5.3, print of five postures, and the same measured on any tongue.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/problems/benchmark.hpp"
#include "forward/model/model.hpp"

namespace genio::bench {

struct PrintedResult {
  const char *measure, *words;
  double value;  ///< [mm]; NaN where the paper gives a direction only
  int sign;      ///< of that direction
};

struct PrintedRow {
  const char* name;
  std::vector<std::pair<const char*, double>> forces;  ///< as printed [N]
  std::vector<PrintedResult> printed;
};

const std::vector<PrintedRow>& printed_rows();

/// What moved [mm]: of the midsagittal line's rear (behind the dorsum) and top (within 15 mm of the
/// dorsum), of the tip, and how much deeper the middle of the blade lies than its sides.
std::map<std::string, double> measured_moves(const Model& model, const Positions& x);

/// Beside each printed result of a row, ours: how far off it is, or whether the direction agrees.
Json compared(const PrintedRow& row, const std::map<std::string, double>& moves);

}  // namespace genio::bench
