#pragma once
// An inversion's result as table, picture, JSON and CSV.

#include <string>

#include "runs/results/answer_view.hpp"

namespace genio {

/// Muscle forces, fit and verdict for people.
std::string to_table(const AnswerView& view);

/// "frame 7 at 1.234 s: word: explained, RMS 0.41 mm; GGP 3.2 N, HG 1.1 N, ...": the three largest
/// shares of maximum forces.
std::string to_line(const AnswerView& view);

/// Midsagittal plane (rest, measured, predicted, palate, jaw) beside a bar chart of the forces with
/// their 90 % intervals, as SVG text.
std::string draw(const Model& model, const AnswerView& view);

/// Writes NAME.svg, NAME.png, NAME.csv and NAME.json into `folder`.
void write_report(const Model& model, const AnswerView& view, int frame, const std::string& folder,
                  const std::string& name);

}  // namespace genio
