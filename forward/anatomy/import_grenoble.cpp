#include "forward/anatomy/import_grenoble.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "forward/anatomy/grenoble_files.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

constexpr Landmarks published = {919, 869, 927};
constexpr int most_muscles = 52;  // bits of a mask that a double holds

}  // namespace

ModelDescription import_grenoble(const std::string& folder) {
  const fs::path tongue = fs::path(folder) / "tongue",
                 surfaces = fs::path(folder) / "surfaces_icp_m";
  if (!fs::is_directory(tongue))
    throw InputError(fmt::format("{}: expected a folder with tongue/ and surfaces_icp_m/", folder));
  ModelDescription d;
  d.name = "Grenoble tongue";
  d.provenance =
      "Gerard et al. 2003/2006, Buchaillard, Perrier & Payan 2009, Stavness et al. 2011/2012";
  d.mesh = grenoble::read_mesh(tongue / "tongue.node", tongue / "tongue.elem");
  check_mesh(d.mesh, (tongue / "tongue.elem").string());
  const size_t n = d.mesh.nodes.size();
  if (int(n) <= published.root)
    throw InputError(fmt::format("{}: {} nodes; the landmarks of this tongue are nodes up to {}",
                                 (tongue / "tongue.node").string(), n, published.root + 1));
  d.supports.assign(n, Support::free);
  for (int a : grenoble::read_list(tongue / "jawAttachments.txt", n))
    d.supports[a] = Support::fixed;
  for (int a : grenoble::read_list(tongue / "hyoidAttachments.txt", n))
    d.supports[a] = Support::horizontal;

  const auto elements =
      grenoble::read_muscle_elements(tongue / "CreateMuscles.mac", int(d.mesh.elements.size()));
  const auto forces = grenoble::read_max_forces(tongue / "MuscleMaxForce.txt");
  for (const auto& name : grenoble::read_muscle_names(tongue / "CreateMuscles.mac")) {
    const std::string both = bilateral_name(name);
    if (!forces.contains(both))
      throw InputError(fmt::format("{}: muscle {} has no maximum force",
                                   (tongue / "MuscleMaxForce.txt").string(), both));
    if (!elements.contains(name))
      throw InputError(fmt::format("{}: muscle {} has no elements",
                                   (tongue / "CreateMuscles.mac").string(), name));
    Muscle m;
    m.name = name;
    m.max_force = forces.at(both) * (both == name ? 1.0 : 0.5);
    m.elements = elements.at(name);
    d.muscles.push_back(std::move(m));
  }
  if (d.muscles.empty() || int(d.muscles.size()) > most_muscles)
    throw InputError(fmt::format("{}: {} muscles; expected 1 to {}",
                                 (tongue / "CreateMuscles.mac").string(), d.muscles.size(),
                                 most_muscles));
  grenoble::read_fibres(tongue / "Fibers.mac", n, d.muscles);
  for (const Muscle& m : d.muscles)
    for (const Fibre& fibre : m.fibres)
      if (fibre.size() < 2)
        throw InputError(fmt::format("{}: a fibre of muscle {} has one point; expected 2 or more",
                                     (tongue / "Fibers.mac").string(), m.name));

  // The outline runs from the jaw insertion over tip and dorsum to the hyoid, then back along the
  // floor; the part up to the hyoid is the tongue's surface line.
  for (int a : grenoble::read_list(tongue / "tongueContourNodes.txt", n)) {
    d.midsagittal.push_back(a);
    if (a == 847) break;
  }
  d.landmarks = published;
  d.palate = read_surface((surfaces / "ICPPalate3.obj").string());
  d.jaw = read_surface((surfaces / "ICPJaw3.obj").string());
  d.hyoid = read_surface((surfaces / "ICPHyoid3.obj").string());
  d.effects["elasticity"] = {{"a10", 1037}, {"a20", 486}, {"kappa", 1037000}};
  d.effects["palate_contact"] = {{"stiffness", 2e8}, {"damping", 5}};
  d.effects["jaw_contact"] = {{"stiffness", 2e8}, {"damping", 5}};
  d.effects["viscosity"] = {{"alpha", 40}, {"beta", 0.03}};
  return d;
}

}  // namespace genio
