#pragma once
#include <fcntl.h>
#include <sys/resource.h>

#include <utility>
#include <vector>

#include "server/hub/descriptor.hpp"

namespace genio::test {

/// While it lives, the process has only a few descriptors left.
class FewDescriptors {
 public:
  explicit FewDescriptors(size_t left) {
    getrlimit(RLIMIT_NOFILE, &before_);
    taken_.emplace_back(open("/dev/null", O_RDONLY | O_CLOEXEC));
    rlimit lower = before_;
    lower.rlim_cur = rlim_t(taken_.front().get()) + 64;
    setrlimit(RLIMIT_NOFILE, &lower);
    for (;;) {
      Descriptor one(open("/dev/null", O_RDONLY | O_CLOEXEC));
      if (!one) break;
      taken_.push_back(std::move(one));
    }
    taken_.resize(taken_.size() - left);
  }
  /// Not even one that was closed can be had again.
  void take_all() {
    rlimit none = before_;
    none.rlim_cur = 0;
    setrlimit(RLIMIT_NOFILE, &none);
  }
  ~FewDescriptors() { setrlimit(RLIMIT_NOFILE, &before_); }
  FewDescriptors(const FewDescriptors&) = delete;
  FewDescriptors& operator=(const FewDescriptors&) = delete;

 private:
  rlimit before_{};
  std::vector<Descriptor> taken_;
};

}  // namespace genio::test
