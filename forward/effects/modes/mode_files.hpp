#pragma once
// Modes of anatomy as arrays of VTK files, three components a point, in metres a standard
// deviation.

#include <string>

#include "forward/effects/description.hpp"
#include "forward/geometry/vtk_io.hpp"

namespace genio {

/// The file beside the model that holds the modes of its surfaces' vertices.
inline constexpr const char* surface_modes_file = "anatomy.vtp";

/// Adds the modes that a mesh's arrays "anatomy_NAME" are, by name. Throws InputError naming the
/// path and the array.
void read_mesh_modes(const VtkData& mesh, const std::string& path, ModelDescription& description);

/// Their displacements of the fibres' fixed points, once the muscles are known. `points`: which
/// points of the file those are, muscle by muscle and fibre by fibre. Throws as above, also where
/// the file has a mode that the mesh has not.
void read_fibre_modes(const VtkData& fibres, const std::vector<int>& points,
                      const std::string& path, ModelDescription& description);

/// Those of the surfaces' vertices, one polyline a surface in the order palate, jaw, hyoid. It
/// reads no file where the description has no mode or no surface.
void read_surface_modes(const std::string& path, ModelDescription& description);

/// The arrays to write.
void add_mesh_modes(const ModelDescription& description, VtkData& mesh);
void add_fibre_modes(const ModelDescription& description, VtkData& fibres);
/// Writes nothing where there is nothing to read.
void write_surface_modes(const std::string& path, const ModelDescription& description);

}  // namespace genio
