#pragma once
// A model becomes a given speaker's.

#include <optional>
#include <string>

#include "forward/geometry/triangle_surface.hpp"
#include "speaker/adaptation/solid_registration.hpp"

namespace genio {

/// The model of a speaker and how well it meets what was given of him.
struct Adaptation {
  ModelDescription model;
  LineDistances distances;            ///< of its midsagittal line and the outline
  double min_jacobian = 0;            ///< smallest ratio of corner Jacobians
  double volume = 0;                  ///< of the mesh [m^3]
  double scale = 1;                   ///< of lengths, from the base model
  double palate_rms = 0;              ///< of the palate's front from the outline's [m]
  double rest_overlap = 0;            ///< of the tongue at rest with palate or jaw [m]
  double max_force_scale = 1;         ///< geometric mean over muscles
  int repaired = 0;                   ///< elements that had to be opened
  std::optional<double> surface_rms;  ///< of the outer nodes from the surface given [m]
  SpeakerOutline outline;             ///< in the model's frame; empty where there was none
  std::string message;                ///< why it cannot be used; empty where it can

  explicit operator bool() const { return message.empty(); }
};

/// A surface of a speaker's tongue [m]. It may be open where nothing is known of it.
struct SpeakerSurface {
  TriangleSurface surface;
  std::string source;  ///< for messages
};

/// Adapts `base` to an outline as read_outline() gives it, and then to a surface in the outline's
/// frame, with z up and y to the right, where there is one. Every muscle's maximum force goes with
/// its cross-section: the volume of its elements over the length of its fibres. Throws InputError
/// naming file, segment and point where the outline cannot be used, and `source` where the model
/// cannot.
Adaptation adapt_model(const ModelDescription& base, const std::string& source,
                       const SpeakerOutline& outline,
                       const std::optional<SpeakerSurface>& surface = {});

/// Adapts `base` to the whole closed surface of a tongue in the model's axes. Where it lies is not
/// changed.
Adaptation adapt_to_surface(const ModelDescription& base, const std::string& source,
                            const SpeakerSurface& surface);

}  // namespace genio
