#include "forward/algebra/cholesky.hpp"

#include <cholmod.h>

#include <algorithm>
#include <new>

#include "forward/algebra/half_factor.hpp"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" void omp_set_max_active_levels(int) __attribute__((weak));

namespace genio {
namespace {

/// OpenBLAS and CHOLMOD's OpenMP loops would otherwise wake threads for each of the many small
/// supernodes, which costs more than the arithmetic. CHOLMOD asks for four by a clause that
/// omp_set_num_threads() does not reach; with no active level allowed every loop stays here. OpenMP
/// keeps this a thread, so the thread that calls CHOLMOD has to say it.
void stay_on_this_thread() {
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  if (omp_set_max_active_levels) omp_set_max_active_levels(0);
}

cholmod_sparse view(const Eigen::SparseMatrix<double>& m) {
  cholmod_sparse s{};
  s.nrow = s.ncol = size_t(m.rows());
  s.nzmax = size_t(m.nonZeros());
  s.p = const_cast<int*>(m.outerIndexPtr());
  s.i = const_cast<int*>(m.innerIndexPtr());
  s.x = const_cast<double*>(m.valuePtr());
  s.stype = -1;
  s.itype = CHOLMOD_INT;
  s.xtype = CHOLMOD_REAL;
  s.dtype = CHOLMOD_DOUBLE;
  s.sorted = s.packed = 1;
  return s;
}

}  // namespace

ReducedStiffness::ReducedStiffness(const BlockPattern& pattern, const DofMap& dofs) {
  const int n = dofs.unknowns();
  for (int a = 0; a < pattern.nodes(); ++a)
    for (int i = 0; i < 3; ++i)
      if (const int u = dofs.unknown(3 * a + i); u >= 0) {
        groups_.push_back(u);
        break;
      }
  groups_.push_back(n);
  std::sort(groups_.begin(), groups_.end());
  groups_.erase(std::unique(groups_.begin(), groups_.end()), groups_.end());
  const size_t count = size_t(9) * pattern.blocks();
  target_.assign(count, -1);
  twice_.assign(count, false);
  std::vector<Eigen::Triplet<double>> entries;
  const auto visit = [&](auto&& act) {
    for (int a = 0; a < pattern.nodes(); ++a)
      for (int s = pattern.row_start(a); s < pattern.row_start(a + 1); ++s)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            const int b = pattern.column(s);
            const int row = dofs.unknown(3 * a + i), column = dofs.unknown(3 * b + j);
            if (row < 0 || column < 0) continue;
            if (a == b && column > row) continue;  // symmetric block: keep one half
            act(size_t(9) * s + 3 * i + j, std::max(row, column), std::min(row, column),
                a != b && row == column);
          }
  };
  visit([&](size_t, int row, int column, bool) { entries.emplace_back(row, column, 0.0); });
  matrix_.resize(n, n);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  matrix_.makeCompressed();
  visit([&](size_t entry, int row, int column, bool twice) {
    const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
    const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
    target_[entry] = int(std::lower_bound(first, last, row) - matrix_.innerIndexPtr());
    twice_[entry] = twice;
  });
}

void ReducedStiffness::assign(const Stiffness& k) {
  double* values = matrix_.valuePtr();
  std::fill(values, values + matrix_.nonZeros(), 0.0);
  const double* blocks = k.block(0);
  for (size_t i = 0; i < target_.size(); ++i)
    if (target_[i] >= 0) values[target_[i]] += twice_[i] ? 2 * blocks[i] : blocks[i];
}

struct Cholesky::Impl {
  mutable cholmod_common common;
  cholmod_factor* factor = nullptr;
  HalfFactor half;

  void copy_half() {
    half.clear(static_cast<const int*>(factor->Perm), int(factor->n));
    if (!factor->is_super) return;
    const auto *super = static_cast<const int*>(factor->super),
               *row_start = static_cast<const int*>(factor->pi),
               *value_start = static_cast<const int*>(factor->px),
               *rows = static_cast<const int*>(factor->s);
    for (size_t k = 0; k < factor->nsuper; ++k)
      half.add_panel(rows + row_start[k], row_start[k + 1] - row_start[k], super[k + 1] - super[k],
                     static_cast<const double*>(factor->x) + value_start[k]);
  }
};

namespace {

/// Nested dissection of the graph of groups, written out for unknowns.
std::vector<int> dissected(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& groups,
                           cholmod_common& c) {
  const int n = int(groups.size()) - 1;
  std::vector<int> group_of(size_t(groups.back()));
  for (int g = 0; g < n; ++g)
    for (int u = groups[size_t(g)]; u < groups[size_t(g + 1)]; ++u) group_of[size_t(u)] = g;
  std::vector<Eigen::Triplet<double>> pairs;
  for (int g = 0; g < n; ++g)  // the first unknown of each speaks for all
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower, groups[size_t(g)]); it; ++it)
      pairs.emplace_back(group_of[size_t(it.row())], g, 1.0);
  Eigen::SparseMatrix<double> graph(n, n);
  graph.setFromTriplets(pairs.begin(), pairs.end());
  graph.makeCompressed();
  cholmod_sparse s = view(graph);
  std::vector<int> place(static_cast<size_t>(n)), parent = place, member = place, order;
  if (cholmod_nested_dissection(&s, nullptr, 0, place.data(), parent.data(), member.data(), &c) < 0)
    throw std::bad_alloc();
  for (int g : place)
    for (int u = groups[size_t(g)]; u < groups[size_t(g + 1)]; ++u) order.push_back(u);
  return order;
}

}  // namespace

Cholesky::Cholesky(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& groups)
    : impl_(std::make_unique<Impl>()) {
  stay_on_this_thread();
  cholmod_common& c = impl_->common;
  cholmod_start(&c);
  c.print = 0;
  c.error_handler = nullptr;
#ifdef GENIO_SUPERNODAL
  c.supernodal = CHOLMOD_SUPERNODAL;
#else
  c.supernodal = CHOLMOD_SIMPLICIAL;
#endif
  c.final_ll = 1;
  c.quick_return_if_not_posdef = 1;
  // Left alone, CHOLMOD is content with minimum degree; nested dissection halves the work here.
  c.nmethods = 2;
  c.method[0].ordering = CHOLMOD_GIVEN;
  c.method[1].ordering = CHOLMOD_AMD;
  cholmod_sparse s = view(lower);
  std::vector<int> order = dissected(lower, groups, c);
  impl_->factor = cholmod_analyze_p(&s, order.data(), nullptr, 0, &c);
  if (!impl_->factor) throw std::bad_alloc();
}

Cholesky::~Cholesky() {
  cholmod_free_factor(&impl_->factor, &impl_->common);
  cholmod_finish(&impl_->common);
}

bool Cholesky::factorize(const Eigen::SparseMatrix<double>& lower, double shift) {
  cholmod_sparse s = view(lower);
  double beta[2] = {shift, 0};
  ++factorizations_;
  stay_on_this_thread();
  cholmod_factorize_p(&s, beta, nullptr, 0, impl_->factor, &impl_->common);
  valid_ = impl_->common.status == CHOLMOD_OK && impl_->factor->minor == impl_->factor->n;
  if (valid_) impl_->copy_half();
  return valid_;
}

Vector Cholesky::precondition(const Vector& right_hand_side) const {
  return impl_->half.empty() ? solve(right_hand_side) : impl_->half.solve(right_hand_side);
}

double Cholesky::flops() const { return impl_->common.fl; }

int Cholesky::iterations_per_factor() const {
  // A solve does four operations an entry of L, at the pace of memory: a quarter of the
  // arithmetic's.
  return int(impl_->common.fl / (4 * 4 * std::max(1.0, impl_->common.lnz)));
}

Vector Cholesky::solve(const Vector& right_hand_side) const {
  Vector x(right_hand_side.size());
  solve(right_hand_side.data(), x.data(), 1);
  return x;
}

Matrix Cholesky::solve(const Matrix& right_hand_sides) const {
  Matrix x(right_hand_sides.rows(), right_hand_sides.cols());
  solve(right_hand_sides.data(), x.data(), x.cols());
  return x;
}

void Cholesky::solve(const double* right, double* solution, Eigen::Index columns) const {
  stay_on_this_thread();
  cholmod_dense b{};
  b.nrow = b.d = impl_->factor->n;
  b.ncol = size_t(columns);
  b.nzmax = b.nrow * b.ncol;
  b.x = const_cast<double*>(right);
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, impl_->factor, &b, &impl_->common);
  if (!x) throw std::bad_alloc();
  std::copy_n(static_cast<double*>(x->x), b.nzmax, solution);
  cholmod_free_dense(&x, &impl_->common);
}

}  // namespace genio
