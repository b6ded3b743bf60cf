#include "forward/tissue/fibres.hpp"

#include <algorithm>

namespace genio {
namespace {

/// Volume that segment (a, b) stands for [m^3]; see share_by_volume. `volumes`: of the elements.
double segment_volume(const HexMesh& mesh, const std::vector<int>& elements,
                      const std::vector<double>& volumes, const FibrePoint& a,
                      const FibrePoint& b) {
  double both = 0, first = 0;
  int count = 0;
  for (size_t i = 0; i < elements.size(); ++i) {
    const auto& nodes = mesh.elements[size_t(elements[i])];
    const bool has_a = a.node >= 0 && std::find(nodes.begin(), nodes.end(), a.node) != nodes.end();
    const bool has_b = b.node >= 0 && std::find(nodes.begin(), nodes.end(), b.node) != nodes.end();
    if (has_a && has_b) both += volumes[i];
    if (a.node >= 0 ? has_a : has_b) first += volumes[i], ++count;
  }
  if (both > 0) return both;
  return count ? first / count : 0.0;
}

}  // namespace

std::vector<FibreSegment> segments_of(const HexMesh& mesh, const std::vector<Fibre>& fibres) {
  const Positions x = rest_positions(mesh);
  std::vector<FibreSegment> segments;
  for (const Fibre& fibre : fibres)
    for (size_t i = 0; i + 1 < fibre.size(); ++i) {
      const double length = (fibre[i + 1].position(x) - fibre[i].position(x)).norm();
      segments.push_back({fibre[i], fibre[i + 1], 0, shortest_fibre * length});
    }
  return segments;
}

std::vector<FibreSegment> share_by_volume(const HexMesh& mesh, const std::vector<Fibre>& fibres,
                                          const std::vector<int>& elements) {
  const Positions x = rest_positions(mesh);
  std::vector<double> volumes;
  for (int e : elements) volumes.push_back(element_volume(mesh, x, e));
  std::vector<FibreSegment> segments = segments_of(mesh, fibres);
  double total = 0;
  auto s = segments.begin();
  for (const Fibre& fibre : fibres) {
    double thickest = 0;
    for (size_t i = 0; i + 1 < fibre.size(); ++i, ++s) {
      s->share = segment_volume(mesh, elements, volumes, fibre[i], fibre[i + 1]);
      thickest = std::max(thickest, s->share);
    }
    total += thickest;
  }
  for (auto& segment : segments) segment.share = total > 0 ? segment.share / total : 0.0;
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
