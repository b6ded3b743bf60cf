#pragma once
#include <vector>

#include "forward/effects/kind.hpp"
#include "forward/effects/modes/moved_rest.hpp"

namespace genio {

/// Modes of a speaker's anatomy: X -> X + sum_k m_k U_k(X) for every point X of the rest
/// configuration, that of nodes, fixed fibre points and bones. The term has no energy of its own:
/// the energies of all others are those of the rest configuration that it says. Parameters: one a
/// mode, m_k [standard deviations among speakers], 0 the model as it stands.
class AnatomyModes final : public Term {
 public:
  explicit AnatomyModes(std::vector<ParameterInfo> info) : info_(std::move(info)) {}

  std::string_view name() const override { return "anatomy"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }

 private:
  std::vector<ParameterInfo> info_;
};

/// Two modes in closed form, for a tongue without measured ones: `size`, 5 % of all lengths about
/// the attachments at the jaw, and `pharynx`, 3 mm of depth that sets in smoothly behind the middle
/// between tip and root.
std::vector<NamedField> plain_modes(const ModelDescription& description);

EffectKind anatomy_kind();

}  // namespace genio
