#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "speaker/volume/nifti_header.hpp"

namespace genio {

/// The voxels of one label, in a box about them with a rim of two voxels.
struct LabelledBox {
  std::array<int, 3> size;       ///< voxels along i, j and k
  std::vector<std::uint8_t> is;  ///< 1 where a voxel has the label; i runs fastest
  Eigen::Affine3d to_metres;     ///< from a voxel's indices in the box to its centre [m]
  std::int64_t label;
  std::int64_t voxels;  ///< that have it
};

/// Reads a NIfTI-1 file, .nii or .nii.gz, whose values are whole numbers. Without `label` there
/// must be one beside 0. Two passes over the file: memory goes by the box. Throws InputError naming
/// the file and the field, and the labels that there are where the one asked for is not.
LabelledBox read_labelled_box(const std::string& path, std::optional<std::int64_t> label);

}  // namespace genio
