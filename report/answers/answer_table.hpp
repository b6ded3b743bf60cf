#pragma once
// An inversion's result as text.

#include <string>

#include "runs/results/answer_view.hpp"

namespace genio {

/// Which muscles act and with what force, fit and verdict, for people.
std::string to_table(const AnswerView& view);

/// "frame 7 at 1.234 s: word: explained, RMS 0.41 mm; GGP 2.1 to 4.0 N, HG 0.0 to 1.4 N": the
/// intervals of the three largest shares of maximum forces among those that rather act than rest.
std::string to_line(const AnswerView& view);

/// "97 %"; "> 99 %" and "< 1 %" at the ends.
std::string percent_text(double probability);

}  // namespace genio
