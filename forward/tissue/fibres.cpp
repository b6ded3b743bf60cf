#include "forward/tissue/fibres.hpp"

#include <algorithm>

namespace genio {
namespace {

/// Volume that segment (a, b) stands for [m^3]; see share_by_volume.
double segment_volume(const HexMesh& mesh, const Positions& x, const std::vector<int>& elements,
                      const FibrePoint& a, const FibrePoint& b) {
  double both = 0, first = 0;
  int count = 0;
  for (int e : elements) {
    const auto& nodes = mesh.elements[e];
    const bool has_a = a.node >= 0 && std::find(nodes.begin(), nodes.end(), a.node) != nodes.end();
    const bool has_b = b.node >= 0 && std::find(nodes.begin(), nodes.end(), b.node) != nodes.end();
    if (!has_a && !has_b) continue;
    const double volume = element_volume(mesh, x, e);
    if (has_a && has_b) both += volume;
    if (a.node >= 0 ? has_a : has_b) first += volume, ++count;
  }
  if (both > 0) return both;
  return count ? first / count : 0.0;
}

}  // namespace

std::vector<FibreSegment> share_by_volume(const HexMesh& mesh, const std::vector<Fibre>& fibres,
                                          const std::vector<int>& elements) {
  const Positions x = rest_positions(mesh);
  std::vector<FibreSegment> segments;
  double total = 0;
  for (const Fibre& fibre : fibres) {
    double thickest = 0;
    for (size_t i = 0; i + 1 < fibre.size(); ++i) {
      const double v = segment_volume(mesh, x, elements, fibre[i], fibre[i + 1]);
      const double length = (fibre[i + 1].position(x) - fibre[i].position(x)).norm();
      segments.push_back({fibre[i], fibre[i + 1], v, shortest_fibre * length});
      thickest = std::max(thickest, v);
    }
    total += thickest;
  }
  for (auto& s : segments) s.share = total > 0 ? s.share / total : 0.0;
  return segments;
}

double fibre_length(const Fibre& fibre, const Positions& x) {
  double length = 0;
  for (size_t i = 0; i + 1 < fibre.size(); ++i)
    length += (fibre[i + 1].position(x) - fibre[i].position(x)).norm();
  return length;
}

std::string bilateral_name(const std::string& command) {
  const size_t n = command.size();
  const bool sided =
      n > 2 && command[n - 2] == '_' && (command[n - 1] == 'L' || command[n - 1] == 'R');
  return sided ? command.substr(0, n - 2) : command;
}

}  // namespace genio
