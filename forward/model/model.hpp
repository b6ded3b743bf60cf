#pragma once
// A tongue: mesh, supports, surfaces and the effects whose energies add up.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forward/algebra/stiffness.hpp"
#include "forward/algebra/supports.hpp"
#include "forward/base/parameter_name.hpp"
#include "forward/effects/contact_potential.hpp"
#include "forward/effects/description.hpp"
#include "forward/effects/effect.hpp"
#include "forward/geometry/element_batches.hpp"
#include "forward/geometry/mesh.hpp"
#include "forward/geometry/triangle_surface.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

class AnatomyShapes;

/// Values of all parameters of all effects, in the order of Model::parameters.
using Parameters = Eigen::VectorXd;

/// A term of a model and where the parameters that it reads stand in Parameters.
template <class T>
struct Placed {
  std::shared_ptr<const T> term;
  int effect;               ///< index into Model::effects
  std::vector<int> inputs;  ///< its own parameters, then those that it borrows

  const T* operator->() const { return term.get(); }
  /// What it reads.
  std::vector<double> values(const Parameters& p) const {
    std::vector<double> result;
    for (int k : inputs) result.push_back(p[k]);
    return result;
  }
};

/// A parameter and where it lives.
struct ParameterSlot {
  int effect;  ///< index into Model::effects
  int index;   ///< index into that effect's parameters
  ParameterName name;
  ParameterInfo info;
  bool is_command = false;  ///< the tension of a muscle of the model [N]
};

/// What a model is assembled from. Anybody may put one together and change it.
struct ModelParts {
  std::string name;
  /// What a file says of it; null where it was put together by hand.
  std::shared_ptr<const ModelDescription> description;
  HexMesh mesh;
  std::vector<Support> supports;  ///< one a node
  std::vector<Muscle> muscles;
  Landmarks landmarks;
  /// Nodes of the tongue's midsagittal surface line, from the floor of the mouth below the tip
  /// over tip and dorsum to the root.
  std::vector<int> midsagittal;
  std::optional<TriangleSurface> palate, jaw, hyoid;
  std::vector<Effect> effects;
  NodeMatrix tissue_mass;  ///< [kg]; empty where there are no dynamics
  /// True where its rest configuration is moved along the modes of anatomy already.
  bool is_moved = false;
  /// Of a model that couples the same nodes, to share; null: made anew.
  std::shared_ptr<const BlockPattern> pattern = nullptr;
};

/// A tongue, assembled once and then constant: a changed model is a new one, made from changed
/// parts(). What solvers need of the parts is derived when it is made. Copies may share workspaces.
struct Model {
  /// Throws InputError where a term borrows a parameter that no effect has.
  explicit Model(ModelParts parts);

  const std::string name;
  const std::shared_ptr<const ModelDescription> description;
  const HexMesh mesh;
  const std::vector<Support> supports;
  const std::vector<Muscle> muscles;
  const Landmarks landmarks;
  const std::vector<int> midsagittal;
  const std::optional<TriangleSurface> palate, jaw, hyoid;
  const std::vector<Effect> effects;
  const NodeMatrix tissue_mass;
  const bool is_moved;

  // Derived:
  const Positions rest;             ///< [m]
  const std::vector<Quad> surface;  ///< boundary faces
  const DofMap dofs;
  const std::vector<ParameterSlot> parameters;  ///< all effects' parameters, one after another
  // The effects' terms, each kind in the order of the effects:
  const std::vector<Placed<Potential>> potentials;
  const std::vector<Placed<Dissipation>> dissipations;
  const std::vector<Placed<JointForces>> joint_forces;  ///< each reads what the dissipation reads
  const std::vector<Placed<Inertia>> inertias;
  const std::vector<Placed<CommandFilter>> filters;      ///< commands pass them one after another
  const std::vector<Placed<ContactPotential>> contacts;  ///< among the potentials
  const std::vector<Placed<Term>> anatomy;               ///< the values of its modes; one at most
  /// Its rest configurations at other anatomies, see at_anatomy(); null without modes to move it.
  const std::shared_ptr<AnatomyShapes> shapes;
  /// Which node pairs couple. Workspaces share it, so that they cannot outlive it.
  const std::shared_ptr<const BlockPattern> pattern;
  /// The elements, batch by batch; shared for the same reason.
  const std::shared_ptr<const std::vector<ElementBatch>> batches;

  /// What it was assembled from, to make a changed model of.
  ModelParts parts() const;
};

/// Parameter values as the model file states them; muscle commands 0.
Parameters default_parameters(const Model& model);

/// Index of "effect.parameter"; throws InputError that suggests the nearest name.
int parameter_index(const Model& model, const std::string& name);
int parameter_index(const Model& model, const ParameterName& name);

/// Parameter indices a command name drives: "GGP" gives GGP_L and GGP_R, "GGP_L" itself.
/// Throws InputError that suggests the nearest name.
std::vector<int> command_parameters(const Model& model, const std::string& name);

/// Sets a command [N]; a bilateral name shares it over both sides. Throws InputError when it is
/// not finite, negative or above the muscle's maximum.
void set_command(const Model& model, const std::string& name, double newtons, Parameters& p);

/// Sets "effect.parameter"; throws InputError when unknown or out of bounds.
void set_parameter(const Model& model, const std::string& name, double value, Parameters& p);

/// Effect by name; nullptr when the model has none.
const Effect* find_effect(const Model& model, std::string_view name);

/// The values of an effect's own parameters within `p`.
std::vector<double> effect_parameters(const Model& model, const Parameters& p, int effect);

}  // namespace genio
