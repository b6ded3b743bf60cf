#pragma once
// A corpus as one table, one JSON object and a few lines for people.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runs/corpus/corpus_results.hpp"

namespace genio {

/// Counts of recordings, frames, status and verdict; shares of verdicts among the frames; refused
/// recordings and failed tasks, each with its reason.
nlohmann::json corpus_json(const Plan& plan, const CorpusResults& results);

/// The same as lines for people.
std::string corpus_text(const Plan& plan, const CorpusResults& results);

/// Writes DIR/results.csv with a row a frame, DIR/corpus.json, and of every recording with answers
/// results.jsonl and a summary in its folder.
void write_corpus(const std::string& out, const Plan& plan, const CorpusResults& results);

}  // namespace genio
