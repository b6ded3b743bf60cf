#include "cli/landmarks.hpp"

#include <fmt/format.h>

namespace genio::cli {

std::vector<LandmarkShift> landmark_shifts(const Model& m, const Positions& x) {
  std::vector<LandmarkShift> shifts;
  for (const auto& [name, node] : {std::pair{"tip", m.landmarks.tip},
                                   {"dorsum", m.landmarks.dorsum},
                                   {"root", m.landmarks.root}})
    shifts.push_back({name, 1e3 * (node_position(x, node) - node_position(m.rest, node))});
  return shifts;
}

void print_anatomy(const std::map<std::string, double>& values) {
  std::string text;
  for (const auto& [mode, value] : values)
    if (value != 0) text += fmt::format(" {} {:+g} sd", mode, value);
  if (!text.empty()) fmt::print("  from the rest of the anatomy:{}\n", text);
}

void print_landmarks(const std::vector<LandmarkShift>& landmarks) {
  for (const LandmarkShift& l : landmarks)
    fmt::print("  {:<7} dx {:7.2f}  dy {:7.2f}  dz {:7.2f} mm\n", l.name, l.mm[0], l.mm[1],
               l.mm[2]);
}

}  // namespace genio::cli
