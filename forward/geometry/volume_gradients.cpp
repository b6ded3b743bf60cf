#include "forward/geometry/volume_gradients.hpp"

namespace genio {

using lanes::Lane;

VolumeGradients::VolumeGradients(Batches batches, const Positions& x)
    : batches_(std::move(batches)) {
  parts_.resize(batches_->size());
  for (size_t b = 0; b < parts_.size(); ++b) {
    const ElementBatch& batch = (*batches_)[b];
    elements_ += batch.count;
    auto& g = parts_[b].gradient;
    parts_[b].batch = &batch;
    for (auto& corner : g) corner.fill(lanes::splat(0));
    const auto position = gather(batch, x);
    for (int q = 0; q < 8; ++q) {
      Lane f[3][3], cofactor[3][3];
      gradient(batch, q, position, f);
      lanes::cofactors(f, cofactor);
      for (int a = 0; a < 8; ++a) {
        const auto& d = batch.gradient[q][a];
        for (int i = 0; i < 3; ++i)
          g[a][i] += batch.weight[q] *
                     (cofactor[i][0] * d[0] + cofactor[i][1] * d[1] + cofactor[i][2] * d[2]);
      }
    }
  }
}

Vector VolumeGradients::rates(const Vector& v) const {
  Vector result(elements_);
  for (const Part& part : parts_) {
    const auto moved = gather(*part.batch, v);
    Lane rate = lanes::splat(0);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) rate += part.gradient[a][i] * moved[a][i];
    for (int l = 0; l < part.batch->count; ++l) result[part.batch->element[l]] = rate[l];
  }
  return result;
}

void VolumeGradients::add_times(const Vector& values, Vector& field) const {
  for (const Part& part : parts_)
    for (int l = 0; l < part.batch->count; ++l) {
      const double value = values[part.batch->element[l]];
      for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i)
          field[3 * part.batch->node[a][l] + i] += value * part.gradient[a][i][l];
    }
}

Vector VolumeGradients::weighted_diagonal(const Vector& weights, Eigen::Index size) const {
  Vector result = Vector::Zero(size);
  for (const Part& part : parts_)
    for (int l = 0; l < part.batch->count; ++l)
      for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i) {
          const double g = part.gradient[a][i][l];
          result[3 * part.batch->node[a][l] + i] += weights[part.batch->element[l]] * g * g;
        }
  return result;
}

}  // namespace genio
