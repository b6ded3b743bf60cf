#pragma once
// An inversion's result as table, picture, JSON and CSV.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "inverse/shape/infer.hpp"

namespace genio {

/// What a report shows; filled from an Answer or from a reply over LCM.
struct AnswerView {
  std::string title, status, message, verdict;
  std::vector<Estimate> muscles;
  std::vector<Estimate> others; ///< parameters and head pose
  std::vector<std::vector<std::string>> unidentified;
  std::vector<TradeOff> trade_offs;  ///< of each unidentified group
  double weight = 1;
  std::vector<Alternative> alternatives;
  int outliers = 0;
  double rms_mm = 0, max_mm = 0, chi2_per_dof = 0, wall_s = 0;
  int iterations = 0, factorizations = 0;
  std::vector<Vec2> measured, predicted;  ///< midsagittal, (x, z) [m]
};

AnswerView view_of(const Model& model, const Target& target, const Answer& answer,
                   const std::string& title);

/// The keys of the command line's JSON for one frame.
nlohmann::json to_json(const AnswerView& view, int frame);

/// Muscle forces, fit and verdict for people.
std::string to_table(const AnswerView& view);

/// Midsagittal plane (rest, measured, predicted, palate, jaw) beside a bar chart of the forces with
/// their 90 % intervals, as SVG text.
std::string draw(const Model& model, const AnswerView& view);

/// Writes NAME.svg, NAME.png, NAME.csv and NAME.json into `folder`.
void write_report(const Model& model, const AnswerView& view, int frame, const std::string& folder,
                  const std::string& name);

}  // namespace genio
