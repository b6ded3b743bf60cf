#pragma once
// The files of data/examples, made from the generic tongue by known causes.

#include <random>
#include <string>

#include "forward/model/model_file.hpp"

namespace genio {

/// Normal noise that is the same with every standard library. The sum of twelve uniform numbers
/// stands for a normal number, because std::normal_distribution differs between libraries.
class Noise {
 public:
  explicit Noise(unsigned seed) : bits_(seed) {}
  /// A number of mean 0 and standard deviation 1.
  double operator()();

 private:
  std::mt19937 bits_;
};

/// Each function writes the files of one example into `folder`, which it creates. The files' first
/// purpose is to be small; data/examples/README.md states what made them. Throws
/// std::runtime_error where a shape has no equilibrium.

/// FOLDER/example_shape.csv: one midsagittal line with 0.3 mm of noise.
void write_shape(const ModelDescription& tongue, const std::string& folder);
/// FOLDER/contours.tsv and palate.tsv: four ultrasound frames in the form of AAA exports, in a
/// device's own axes, with 0.5 mm of noise.
void write_recording(const ModelDescription& tongue, const std::string& folder);
/// FOLDER/commands.csv and contours.csv: a movement of 100 ms and five midsagittal lines of it with
/// 0.3 mm of noise.
void write_word(const ModelDescription& tongue, const std::string& folder);
/// FOLDER/beliefs.toml and emg.csv: a prior for the example shape.
void write_prior(const std::string& folder);
/// FOLDER/corpus.csv: the recordings of the other examples as a corpus.
void write_manifest(const std::string& folder);
/// FOLDER/observations.toml and its targets: five postures of a tongue of eight times the elements
/// under an airway pressure that the model does not have, with 0.4 mm of noise.
void write_observations(const ModelDescription& tongue, const std::string& folder);
/// FOLDER/outline.csv: the midsagittal outline of a smaller tongue with a higher dorsum, looking
/// the way of the model, in a frame of its own.
void write_outline(const ModelDescription& tongue, const std::string& folder);

}  // namespace genio
