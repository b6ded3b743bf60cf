#pragma once
// What was asked of a run: run.json.

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace genio {

/// A file that answers depend on, by what it holds.
struct AskedFile {
  std::string path, content;  ///< content_hash(), empty where there is no file
};

/// Each option's name and value, in any order; std::monostate where it is unset.
using QuestionValue = std::variant<std::monostate, bool, int, double, std::string,
                                   std::vector<std::string>, AskedFile>;
using Question = std::vector<std::pair<std::string, QuestionValue>>;

/// The file with its content; an empty path is no file. Throws InputError where it cannot be read.
AskedFile asked_file(const std::string& path);

/// As one JSON object.
std::string question_json(const Question& asked);

/// The first option in which two questions, as JSON, differ, in words: "starts = 3, not 4". Empty
/// where they ask the same; of a file only its content counts, and of an option `aside` nothing.
std::string difference(const std::string& before, const std::string& now,
                       const std::string& aside = "");

/// An option's number in a question, as JSON; 0 where it is none.
double number_in(const std::string& question, const std::string& option);

}  // namespace genio
