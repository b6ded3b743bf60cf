#pragma once
// The files of the Grenoble tongue, one function each. All throw InputError naming file and line.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "forward/effects/description.hpp"

namespace genio::grenoble {

/// Node numbers listed in a file, from 0 there and here.
std::vector<int> read_list(const std::filesystem::path& path, size_t nodes);

/// Nodes and elements (ANSYS .node, .elem), numbered from 1 there.
HexMesh read_mesh(const std::filesystem::path& nodes, const std::filesystem::path& elements);

/// Elements of each muscle, from the selections of CreateMuscles.mac.
std::map<std::string, std::vector<int>> read_muscle_elements(const std::filesystem::path& path,
                                                             int elements);

/// Muscle names in their order, from `muscleName(k) = 'NAME'`.
std::vector<std::string> read_muscle_names(const std::filesystem::path& path);

/// Adds their fibres to the muscles, from `FIBER(point,fibre,muscle) = node`, all in order. The
/// styloid anchors, which are no mesh nodes, stand where ArtiSynth has them.
void read_fibres(const std::filesystem::path& path, size_t nodes, std::vector<Muscle>& muscles);

/// `NAME FORCE` a line [N].
std::map<std::string, double> read_max_forces(const std::filesystem::path& path);

}  // namespace genio::grenoble
