#pragma once
#include <map>
#include <string>

#include "forward/effects/description.hpp"
#include "forward/effects/surroundings/contact_faces.hpp"

namespace genio::bench {

/// How deep the tongue's surface lies in the bones, at a point about every 0.2 mm of it and by the
/// bones' triangles: neither the contact's points nor its smooth distance are asked.
class DensestPenetration {
 public:
  explicit DensestPenetration(const ModelDescription& description);
  /// Of each bone, beyond the overlap at rest [m].
  std::map<std::string, double> operator()(const Positions& x) const;

 private:
  std::map<std::string, std::shared_ptr<const ContactFaces>> bones_;
};

}  // namespace genio::bench
