#include "server/answer/request_prior.hpp"

#include <fmt/format.h>

#include "inverse/prior/prior_file.hpp"

namespace genio {

Prior prior_of(const Model& model, const shape_request_t& r) {
  if (r.prior.empty()) return {};
  if (r.prior.size() > size_t(max_string_length))
    throw InputError(
        fmt::format("prior: has {} bytes; expected at most {}", r.prior.size(), max_string_length));
  Prior prior = prior_of_text("prior", r.prior);
  try {
    prior_terms(prior, unknowns_of(model, prior, r.bilateral == 1));
  } catch (const InputError& e) {
    throw InputError(fmt::format("prior: {}", e.what()));
  }
  return prior;
}

}  // namespace genio
