#include "forward/geometry/surfaces/distance_field.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <memory>

namespace genio {
namespace {

constexpr double far_away = 0.05;  // [m]; also the largest distance kept
constexpr double band = 0.008;     // samples farther away than this need no exact distance [m]
constexpr int group = 6;           // samples along the side of a block that may be skipped whole
constexpr int refinement = 4;
constexpr int cells = 8;         // along the side of a brick
constexpr int kept = cells + 3;  // coefficients that its cells reach
constexpr int asked = kept + 2;  // samples that those are made of

}  // namespace

struct DistanceField::Brick {
  std::array<float, size_t(kept) * kept * kept> coefficient;
  std::bitset<cells * cells * cells> touching;  ///< cells where the spline may be less than `touch`

  const float* row(int i, int j, int k) const {
    return &coefficient[size_t((k * kept + j) * kept + i)];
  }
  /// The coefficients of a cell as the blending asks for them.
  auto rows(const std::array<int, 3>& c) const {
    return [this, c](int j, int k) { return row(c[0], c[1] + j, c[2] + k); };
  }
  bool may_touch(const std::array<int, 3>& c) const {
    return touching[size_t((c[2] * cells + c[1]) * cells + c[0])];
  }
  template <class Sample>
  void mark_cells(double spacing, Sample sample);
};

/// A brick, a cell of it and the place within that.
struct DistanceField::Spot {
  std::array<int, 3> brick, cell;
  Vec3 fraction;
};

/// `sample(i, j, k)`: the distance at a node of a cell. Where it leaves a doubt, values of the
/// spline half a cell apart decide: none changes by more than 1.1 times the way between them.
template <class Sample>
void DistanceField::Brick::mark_cells(double spacing, Sample sample) {
  const double way = 0.5 * std::sqrt(3.0) * spacing, rounded = 0.3 * spacing;
  for (int k = 0, bit = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i, ++bit) {
        double least = far_away;
        for (int c = 0; c < 8; ++c)
          least = std::min(least, sample(i + c % 2, j + c / 2 % 2, k + c / 4));
        if (least > touch + way + rounded) continue;
        bool inside = least < touch;
        for (int c = 0; c < 27 && !inside; ++c) {
          const int half[3] = {c % 3, c / 3 % 3, c / 9};  // of a cell
          const Vec3 at(0.5 * half[0], 0.5 * half[1], 0.5 * half[2]);
          const auto value = [&](int y, int z) { return row(i, j + y, k + z); };
          inside = blended_value(at, value) < touch + 0.55 * way;
        }
        touching[size_t(bit)] = inside;
      }
}

DistanceField::DistanceField(const TriangleSurface& surface, const Vec3& low, const Vec3& high,
                             double spacing)
    : distance_(surface), low_(low), spacing_(spacing), fine_(spacing / refinement) {
  nx_ = int((high[0] - low[0]) / spacing) + 4;
  ny_ = int((high[1] - low[1]) / spacing) + 4;
  nz_ = int((high[2] - low[2]) / spacing) + 4;
  int closest = -1;
  const auto bounded = [&](const Vec3& p) {
    return std::clamp(distance_(p, closest), -far_away, far_away);
  };
  samples_.resize(size_t(nx_) * ny_ * nz_);
  const double half_diagonal = 0.5 * std::sqrt(3.0) * (group - 1) * spacing;
  for (int k0 = 0; k0 < nz_; k0 += group)
    for (int j0 = 0; j0 < ny_; j0 += group)
      for (int i0 = 0; i0 < nx_; i0 += group) {
        const double middle = 0.5 * (group - 1);
        const double centre = bounded(low + spacing * Vec3(i0 + middle, j0 + middle, k0 + middle));
        const bool skip = std::abs(centre) > band + half_diagonal;
        for (int k = k0; k < std::min(nz_, k0 + group); ++k)
          for (int j = j0; j < std::min(ny_, j0 + group); ++j)
            for (int i = i0; i < std::min(nx_, i0 + group); ++i)
              samples_[(size_t(k) * ny_ + j) * nx_ + i] =
                  skip ? centre : bounded(low + spacing * Vec3(i, j, k));
      }
  const auto bricks = [&](int n) { return (n * refinement + cells - 1) / cells; };
  bx_ = bricks(nx_), by_ = bricks(ny_), bz_ = bricks(nz_);
  bricks_ = std::vector<std::atomic<const Brick*>>(size_t(bx_) * by_ * bz_);
}

DistanceField::~DistanceField() {
  for (auto& brick : bricks_) delete brick.load();
}

double DistanceField::rough(const Vec3& p) const {
  const int size[3] = {nx_, ny_, nz_};
  int c[3];
  Vec3 t;
  for (int d = 0; d < 3; ++d) {
    const double s = (p[d] - low_[d]) / spacing_;
    if (!(s >= 1) || s >= size[d] - 2) return far_away;
    c[d] = int(s);
    t[d] = s - c[d];
  }
  double v = 0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      v += (k ? t[2] : 1 - t[2]) * (j ? t[1] : 1 - t[1]) *
           ((1 - t[0]) * at(c[0], c[1] + j, c[2] + k) + t[0] * at(c[0] + 1, c[1] + j, c[2] + k));
  return v;
}

std::unique_ptr<DistanceField::Brick> DistanceField::make_brick(
    const std::array<int, 3>& index) const {
  std::vector<double> samples(size_t(asked) * asked * asked);
  const auto sample = [&](int i, int j, int k) -> double& {
    return samples[size_t((k * asked + j) * asked + i)];
  };
  const auto first = [&](int d) { return cells * index[size_t(d)] - 2; };
  for (int k = 0, near = -1; k < asked; ++k)
    for (int j = 0; j < asked; ++j)
      for (int i = 0; i < asked; ++i) {
        const std::array<int, 3> node = {first(0) + i, first(1) + j, first(2) + k};
        const int64_t number =
            (int64_t(node[2] + 2) << 42) + (int64_t(node[1] + 2) << 21) + node[0] + 2;
        const auto [it, fresh] = fine_samples_.try_emplace(number, 0.f);
        if (fresh)
          it->second = float(distance_(low_ + fine_ * Vec3(node[0], node[1], node[2]), near));
        sample(i, j, k) = it->second;
      }
  auto made = std::make_unique<Brick>();
  float* out = made->coefficient.data();
  for (int k = 1; k <= kept; ++k)
    for (int j = 1; j <= kept; ++j)
      for (int i = 1; i <= kept; ++i) {
        const double around = sample(i - 1, j, k) + sample(i + 1, j, k) + sample(i, j - 1, k) +
                              sample(i, j + 1, k) + sample(i, j, k - 1) + sample(i, j, k + 1);
        *out++ = float(2 * sample(i, j, k) - around / 6);
      }
  made->mark_cells(fine_, [&](int i, int j, int k) { return sample(i + 2, j + 2, k + 2); });
  return made;
}

bool DistanceField::locate(const Vec3& p, Spot& spot) const {
  const Vec3 s = (1 / fine_) * (p - low_);
  const int size[3] = {nx_, ny_, nz_};
  for (int d = 0; d < 3; ++d) {
    if (!(s[d] >= refinement) || s[d] >= refinement * (size[d] - 2)) return false;
    const int cell = int(s[d]);
    spot.brick[size_t(d)] = cell / cells, spot.cell[size_t(d)] = cell % cells;
    spot.fraction[d] = s[d] - cell;
  }
  return true;
}

std::optional<DistanceField::Cell> DistanceField::cell(const Vec3& p) const {
  Spot spot;
  if (!locate(p, spot)) return {};
  Cell c{spot.brick, spot.fraction};
  for (size_t d = 0; d < 3; ++d) c.node[d] = cells * spot.brick[d] + spot.cell[d];
  return c;
}

const DistanceField::Brick* DistanceField::there(const Spot& spot) const {
  const auto& b = spot.brick;
  return bricks_[(size_t(b[2]) * by_ + b[1]) * bx_ + b[0]].load(std::memory_order_acquire);
}

const DistanceField::Brick& DistanceField::brick(const Spot& spot) const {
  if (const Brick* made = there(spot)) return *made;
  const std::lock_guard lock(filling_);
  if (const Brick* made = there(spot)) return *made;  // by another thread meanwhile
  const auto& b = spot.brick;
  const Brick* made = make_brick(b).release();
  bricks_[(size_t(b[2]) * by_ + b[1]) * bx_ + b[0]].store(made, std::memory_order_release);
  return *made;
}

double DistanceField::at_least(const Vec3& p, double radius) const {
  Spot spot;
  if (!locate(p, spot)) return far_away - radius;
  // The spline's slope is a little more than 1 at edges.
  if (const Brick* b = there(spot))
    return blended_value(spot.fraction, b->rows(spot.cell)) - 1.1 * radius - 1e-5;
  return std::min(rough(p) - coarse_error(), band) - radius;
}

double DistanceField::fine(const Vec3& p) const {
  Spot spot;
  if (!locate(p, spot)) return far_away;
  return blended_value(spot.fraction, brick(spot).rows(spot.cell));
}

double DistanceField::value(const Vec3& p) const {
  const double near = rough(p);
  return near > touch + coarse_error() ? near : fine(p);
}

double DistanceField::value_if_touching(const Vec3& p) const {
  Spot spot;
  if (!locate(p, spot)) return far_away;
  const Brick* b = there(spot);
  if (!b) {
    if (rough(p) > touch + coarse_error()) return far_away;
    b = &brick(spot);
  }
  if (!b->may_touch(spot.cell)) return far_away;
  return blended_value(spot.fraction, b->rows(spot.cell));
}

DistanceSample DistanceField::sample(const Vec3& p) const {
  Spot spot;
  if (!locate(p, spot)) return {far_away, Vec3::Zero(), Mat3::Zero()};
  return blended_sample(spot.fraction, fine_, brick(spot).rows(spot.cell));
}

}  // namespace genio
