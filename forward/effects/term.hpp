#pragma once
// What every term of a model says of itself.

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "forward/base/parameter_name.hpp"
#include "forward/effects/parameter.hpp"

namespace genio {

/// A term of the model: the parameters it reads and the nodes it couples. Terms are constant and
/// have no scratch: one object serves any number of threads.
class Term {
 public:
  virtual ~Term() = default;
  /// The effect that it is a part of ("gravity").
  virtual std::string_view name() const = 0;
  /// Its own parameters. Those of all terms of an effect, one after another, are the effect's.
  virtual std::span<const ParameterInfo> parameters() const = 0;
  /// Parameters of other terms that it reads. Their values follow its own, and it gives
  /// derivatives with respect to them by their place there too.
  virtual std::vector<ParameterName> borrows() const { return {}; }
  /// Node pairs that it couples beyond those that share an element.
  virtual std::vector<std::pair<int, int>> couplings() const { return {}; }
};

}  // namespace genio
