#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>

#include "forward/base/types.hpp"

namespace genio {

/// What the header of a NIfTI-1 file says, checked.
struct NiftiHeader {
  static constexpr size_t bytes = 348;

  std::array<int, 3> size;  ///< voxels along i, j and k
  int type;                 ///< the field datatype
  size_t voxel_bytes;
  bool swapped;               ///< the other byte order than this machine's
  std::uint64_t offset;       ///< of the first voxel [bytes]
  double slope, intercept;    ///< value = slope * stored + intercept
  Eigen::Affine3d to_metres;  ///< from a voxel's indices to its centre [m]
};

/// Of the first 348 bytes. The place is that of sform, else of qform, else voxel sizes alone;
/// metres, millimetres and micrometres are understood. Throws InputError naming `path` and the
/// field.
NiftiHeader read_nifti_header(const std::string& bytes, const std::string& path);

/// The stored value at `at`, without slope and intercept.
double nifti_value(const NiftiHeader& header, const char* at);

}  // namespace genio
