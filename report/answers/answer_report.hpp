#pragma once
// An inversion's result as picture, JSON and CSV.

#include <string>

#include "runs/results/answer_view.hpp"

namespace genio {

/// Midsagittal plane (rest, measured, predicted, palate, jaw) beside the forces' 90 % intervals,
/// medians and best fits, as SVG text. A bar is the paler the rather its muscle rests.
std::string draw(const Model& model, const AnswerView& view);

/// Writes NAME.svg, NAME.png, NAME.csv and NAME.json into `folder`.
void write_report(const Model& model, const AnswerView& view, int frame, const std::string& folder,
                  const std::string& name);

}  // namespace genio
