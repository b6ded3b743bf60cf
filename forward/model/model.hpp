#pragma once
// A tongue: mesh, supports, surfaces and the effects whose energies add up.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forward/algebra/stiffness.hpp"
#include "forward/algebra/supports.hpp"
#include "forward/base/parameter_name.hpp"
#include "forward/effects/description.hpp"
#include "forward/effects/effect.hpp"
#include "forward/geometry/element_batches.hpp"
#include "forward/geometry/mesh.hpp"
#include "forward/geometry/triangle_surface.hpp"
#include "forward/geometry/volume_gradients.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// Values of all parameters of all effects, in the order of Model::parameters.
using Parameters = Eigen::VectorXd;

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
  std::vector<std::shared_ptr<const Effect>> effects;
  NodeMatrix tissue_mass;  ///< [kg]; empty where there are no dynamics
};

/// A tongue, assembled once and then constant: a changed model is a new one, made from changed
/// parts(). What solvers need of the parts is derived when it is made. Copies may share workspaces.
struct Model {
  /// Throws InputError where an effect borrows a parameter that no effect has.
  explicit Model(ModelParts parts);

  const std::string name;
  const std::shared_ptr<const ModelDescription> description;
  const HexMesh mesh;
  const std::vector<Support> supports;
  const std::vector<Muscle> muscles;
  const Landmarks landmarks;
  const std::vector<int> midsagittal;
  const std::optional<TriangleSurface> palate, jaw, hyoid;
  const std::vector<std::shared_ptr<const Effect>> effects;
  const NodeMatrix tissue_mass;

  // Derived:
  const Positions rest;             ///< [m]
  const std::vector<Quad> surface;  ///< boundary faces
  const std::vector<ElementBatch> batches;
  const DofMap dofs;
  const std::vector<ParameterSlot> parameters;  ///< all effects' parameters, one after another
  /// Of each effect: where its parameters, then those it borrows, stand in Parameters.
  const std::vector<std::vector<int>> inputs;
  /// Which node pairs couple. Workspaces share it, so that they cannot outlive it.
  const std::shared_ptr<const BlockPattern> pattern;

  /// What it was assembled from, to make a changed model of.
  ModelParts parts() const;
};

/// Parameter values as the model file states them; muscle commands 0.
Parameters default_parameters(const Model& model);

/// Index of "effect.parameter"; throws InputError that suggests the nearest name.
int parameter_index(const Model& model, const std::string& name);

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

/// The values of one effect within `p`, those it borrows last.
std::vector<double> effect_parameters(const Model& model, const Parameters& p, int effect);

/// Total potential energy [J]; +infinity for inverted tissue.
double energy(const Model& model, const Positions& x, const Parameters& p);
/// Total nodal forces [N].
Forces force(const Model& model, const Positions& x, const Parameters& p);
/// Those of some of its effects.
Forces forces_of(const Model& model, const Positions& x, const Parameters& p,
                 const std::function<bool(const Effect&)>& which);
/// Norm of the nodal forces of loads and contacts, which a residual is compared with [N]; at least
/// 1 mN.
double load_size(const Model& model, const Positions& x, const Parameters& p);
/// Total stiffness into `k` (overwritten) [N/m].
void stiffness(const Model& model, const Positions& x, const Parameters& p, Stiffness& k);
/// Total stiffness for a Newton step, see Effect::add_step_stiffness.
void step_stiffness(const Model& model, const Positions& x, const LinearStep& led,
                    const Parameters& p, Stiffness& k);
/// The part of the stiffness at x that keeps volumes. It refers to the model's batches.
Bulk bulk(const Model& model, const Positions& x, const Parameters& p);
/// Smallest of the effects' step limits.
double step_limit(const Model& model, const Positions& x, const Positions& along,
                  const Parameters& p);
/// Total nodal forces at the velocities v: those of the potential and, in `viscous`, those of the
/// dissipation [N].
Forces forces_in_motion(const Model& model, const Positions& x, const Vector& v,
                        const Parameters& p, Forces& viscous);
/// Adds the total damping, times `scale`, to `k`; `scratch` is overwritten.
void add_damping(const Model& model, const Positions& x, const Vector& v, const Parameters& p,
                 double scale, Stiffness& scratch, Stiffness& k);
/// The tissue's and the effects' mass [kg]. Throws InputError for a model without.
NodeMatrix mass_matrix(const Model& model, const Parameters& p);
/// dF/dp_k as nodal forces, for each of the given parameters: 3 n x count [N per unit].
Matrix force_derivatives(const Model& model, const Positions& x, const Parameters& p,
                         std::span<const int> parameters);

/// The same of the forces in motion, those of the potential and of the dissipation together.
Matrix motion_force_derivatives(const Model& model, const Positions& x, const Vector& v,
                                const Parameters& p, std::span<const int> parameters);
/// The derivative of the viscous forces along each column of `along`, nodal displacements at fixed
/// v. `scratch` is overwritten.
Matrix viscous_slope(const Model& model, const Positions& x, const Vector& v, const Parameters& p,
                     const Matrix& along, Stiffness& scratch);

/// Deepest penetration of any surface [m].
double max_penetration(const Model& model, const Positions& x, const Parameters& p);

}  // namespace genio
