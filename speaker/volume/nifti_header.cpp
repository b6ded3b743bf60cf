#include "speaker/volume/nifti_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace genio {
namespace {

constexpr int most_along = 4096;
constexpr double most_voxels = 1 << 30;
constexpr double most_offset = 64 << 20;  // bytes; extensions stand before the voxels
constexpr double least_voxel = 1e-6, largest_voxel = 0.05;  // [m]
constexpr double farthest = 10;                             // from the origin [m]

/// A value of the file, in either byte order.
template <class T>
T stored(const char* at, bool swapped) {
  char raw[sizeof(T)];
  std::copy_n(at, sizeof(T), raw);
  if (swapped) std::reverse(raw, raw + sizeof(T));
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

class HeaderFields {
 public:
  HeaderFields(const std::string& bytes, const std::string& path) : bytes_(bytes), path_(path) {
    if (bytes.size() < NiftiHeader::bytes)
      throw InputError(
          fmt::format("{}: {} bytes; expected a NIfTI header of 348", path, bytes.size()));
    swapped_ = stored<std::int32_t>(bytes.data(), false) != 348;
    if (get<std::int32_t>(0) == 540) fail("sizeof_hdr", "540, which is NIfTI-2; expected NIfTI-1");
    if (get<std::int32_t>(0) != 348) fail("sizeof_hdr", "is not 348; expected a NIfTI-1 file");
    const std::string magic = bytes.substr(344, 4);
    if (magic == std::string("ni1\0", 4))
      fail("magic", "ni1, a header without its image; expected one file, .nii or .nii.gz");
    if (magic != std::string("n+1\0", 4)) fail("magic", "is not n+1; expected a NIfTI-1 file");
  }

  template <class T>
  T get(size_t offset) const {
    return stored<T>(bytes_.data() + offset, swapped_);
  }
  /// A number that is finite.
  double real(size_t offset, const char* field) const {
    const double value = get<float>(offset);
    if (!std::isfinite(value)) fail(field, "is not finite");
    return value;
  }
  bool swapped() const { return swapped_; }
  [[noreturn]] void fail(const std::string& field, const std::string& what) const {
    throw InputError(fmt::format("{}: field {}: {}", path_, field, what));
  }

 private:
  const std::string& bytes_;
  const std::string& path_;
  bool swapped_;
};

size_t bytes_of_type(const HeaderFields& fields, int type) {
  switch (type) {
    case 2:
    case 256:
      return 1;
    case 4:
    case 512:
      return 2;
    case 8:
    case 768:
    case 16:
      return 4;
    case 1024:
    case 1280:
    case 64:
      return 8;
    default:
      fields.fail("datatype", fmt::format("{}; expected whole numbers of 8 to 64 bits or floating "
                                          "point of 32 or 64",
                                          type));
  }
}

double metres_of_unit(const HeaderFields& fields) {
  switch (fields.get<std::uint8_t>(123) & 7) {
    case 0:
    case 2:
      return 1e-3;  // unknown: millimetres, as everybody writes
    case 1:
      return 1;
    case 3:
      return 1e-6;
    default:
      fields.fail("xyzt_units", "is no unit of length; expected m, mm or micrometres");
  }
}

/// By a quaternion, voxel sizes and an offset.
Eigen::Affine3d qform(const HeaderFields& fields, const Vec3& voxel) {
  const double b = fields.real(256, "quatern_b"), c = fields.real(260, "quatern_c"),
               d = fields.real(264, "quatern_d");
  const double squares = b * b + c * c + d * d;
  if (squares > 1.001) fields.fail("quatern_b", "no rotation; expected b^2 + c^2 + d^2 <= 1");
  const Eigen::Quaterniond turn(std::sqrt(std::max(0.0, 1 - squares)), b, c, d);
  Eigen::Affine3d to = Eigen::Affine3d::Identity();
  const Vec3 signed_size(voxel[0], voxel[1], (fields.get<float>(76) < 0 ? -1 : 1) * voxel[2]);
  to.linear() = turn.normalized().toRotationMatrix() * signed_size.asDiagonal();
  to.translation() = Vec3(fields.real(268, "qoffset_x"), fields.real(272, "qoffset_y"),
                          fields.real(276, "qoffset_z"));
  return to;
}

Eigen::Affine3d sform(const HeaderFields& fields) {
  Eigen::Affine3d to = Eigen::Affine3d::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      to.matrix()(r, c) = fields.real(size_t(280 + 16 * r + 4 * c), r == 0   ? "srow_x"
                                                                    : r == 1 ? "srow_y"
                                                                             : "srow_z");
  return to;
}

Eigen::Affine3d placement(const HeaderFields& fields) {
  Eigen::Affine3d to = Eigen::Affine3d::Identity();
  std::string field = "srow_x";
  if (fields.get<std::int16_t>(254) > 0) {
    to = sform(fields);
  } else {
    Vec3 voxel;
    for (int d = 0; d < 3; ++d) voxel[d] = std::abs(fields.real(size_t(80 + 4 * d), "pixdim"));
    field = "pixdim";
    if (fields.get<std::int16_t>(252) > 0) to = qform(fields, voxel);
    else to.linear() = voxel.asDiagonal();
  }
  const double metres = metres_of_unit(fields);
  to = Eigen::Affine3d(Eigen::Scaling(metres) * to);
  double product = 1;
  for (int d = 0; d < 3; ++d) {
    const double length = to.linear().col(d).norm();
    if (!(length >= least_voxel && length <= largest_voxel))
      fields.fail(field, fmt::format("a voxel measures {:.3g} mm; expected 0.001 to 50 mm (is "
                                     "xyzt_units right?)",
                                     length * 1e3));
    product *= length;
  }
  if (std::abs(to.linear().determinant()) < 0.05 * product)
    fields.fail(field, "the voxels' axes lie in one plane; expected three directions");
  if (!(to.translation().norm() <= farthest))
    fields.fail(field, "the volume lies more than 10 m from the origin");
  return to;
}

}  // namespace

NiftiHeader read_nifti_header(const std::string& bytes, const std::string& path) {
  const HeaderFields fields(bytes, path);
  NiftiHeader header{};
  header.swapped = fields.swapped();
  const int dimensions = fields.get<std::int16_t>(40);
  if (dimensions < 3 || dimensions > 7)
    fields.fail("dim[0]", fmt::format("{} dimensions; expected 3", dimensions));
  double voxels = 1;
  for (int d = 1; d <= dimensions; ++d) {
    const int n = fields.get<std::int16_t>(size_t(40 + 2 * d));
    const std::string field = fmt::format("dim[{}]", d);
    if (d > 3 && n != 1)
      fields.fail(field, fmt::format("{} volumes; expected one volume of labels", n));
    if (n < 1 || n > most_along)
      fields.fail(field, fmt::format("{} voxels; expected 1 to {}", n, most_along));
    if (d <= 3) header.size[size_t(d - 1)] = n;
    voxels *= n;
  }
  if (voxels > most_voxels)
    fields.fail("dim", fmt::format("{:.3g} voxels; expected at most {:.3g}", voxels, most_voxels));
  header.type = fields.get<std::int16_t>(70);
  header.voxel_bytes = bytes_of_type(fields, header.type);
  if (const int bits = fields.get<std::int16_t>(72); size_t(bits) != 8 * header.voxel_bytes)
    fields.fail("bitpix", fmt::format("{}; expected {} for datatype {}", bits,
                                      8 * header.voxel_bytes, header.type));
  const double offset = fields.real(108, "vox_offset");
  if (!(offset >= 352 && offset <= most_offset) || offset != std::floor(offset))
    fields.fail("vox_offset", fmt::format("{}; expected whole bytes from 352", offset));
  header.offset = std::uint64_t(offset);
  header.slope = fields.get<float>(112), header.intercept = fields.get<float>(116);
  if (header.slope == 0) header.slope = 1, header.intercept = 0;  // not scaled, says the format
  if (!std::isfinite(header.slope)) fields.fail("scl_slope", "is not finite");
  if (!std::isfinite(header.intercept)) fields.fail("scl_inter", "is not finite");
  header.to_metres = placement(fields);
  return header;
}

double nifti_value(const NiftiHeader& header, const char* at) {
  const bool s = header.swapped;
  switch (header.type) {
    case 2:
      return stored<std::uint8_t>(at, s);
    case 256:
      return stored<std::int8_t>(at, s);
    case 4:
      return stored<std::int16_t>(at, s);
    case 512:
      return stored<std::uint16_t>(at, s);
    case 8:
      return stored<std::int32_t>(at, s);
    case 768:
      return stored<std::uint32_t>(at, s);
    case 16:
      return stored<float>(at, s);
    case 64:
      return stored<double>(at, s);
    case 1024:
      return double(stored<std::int64_t>(at, s));
    default:
      return double(stored<std::uint64_t>(at, s));
  }
}

}  // namespace genio
