#pragma once
#include <string>

#include "bench/experiments/recordings/synthetic_session.hpp"

namespace genio::bench {

struct SyntheticCorpus {
  int recordings = 60, speakers = 3, frames = 8;  ///< frames a recording
  unsigned seed = 1;
};

/// Writes a manifest, `speakers` models that differ from that of `model_folder` in their stiffness,
/// and recordings of them in the formats of five devices. Gives the manifest's path.
std::string write_corpus_files(const SyntheticCorpus& corpus, const std::string& model_folder,
                               const std::string& folder);

}  // namespace genio::bench
