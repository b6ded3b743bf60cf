#include "inverse/prior/prior.hpp"

namespace genio {

std::vector<Unknown> unknowns_of(const Model& model, const Prior& prior, bool bilateral) {
  std::vector<Unknown> result = muscle_unknowns(model, bilateral);
  prior.each([&]<class Term>(const Term& term) {
    if constexpr (BringsUnknowns<Term>)
      for (Unknown& unknown : term.unknowns(model)) result.push_back(std::move(unknown));
  });
  return result;
}

PriorTerms prior_terms(const Prior& prior, const std::vector<Unknown>& unknowns) {
  PriorRows rows(unknowns);
  prior.each([&](const auto& term) { term.add_rows(unknowns, rows); });
  return rows.terms();
}

std::vector<std::string> names_in_prior(const Prior& prior) {
  std::vector<std::string> result;
  prior.each([&](const auto& term) {
    for (std::string& name : term.names()) result.push_back(std::move(name));
  });
  return result;
}

Prior half_prior(Prior prior) {
  prior.each([](auto& term) { term = term.half(); });
  return prior;
}

Prior with_effort(Prior prior, double times) {
  prior.effort_sd *= times;
  return prior;
}

}  // namespace genio
