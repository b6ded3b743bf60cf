#pragma once
// The table that lists the recordings of a corpus.

#include <functional>
#include <string>
#include <vector>

#include "runs/frames/inversion.hpp"

namespace genio {

/// Reads words as `genio invert` reads its command line. Throws InputError with what is wrong.
using ReadWords = std::function<InversionOptions(const std::vector<std::string>& words)>;

/// One recording, as a row of the table gives it.
struct ManifestRow {
  int line = 0;
  std::string recording, speaker;  ///< the file as it is written there
  std::string name;                ///< of its folder; no two rows share it
  std::vector<std::string> words;  ///< of `genio invert`; paths are as they are written there
};

struct Manifest {
  std::string path, folder;  ///< the folder that its paths start from
  std::vector<ManifestRow> rows;
};

/// Reads a table with the column `recording` and, where wanted, palate, speaker, model, textgrid
/// and options, and has `read` look at the words of every row. Throws InputError that names line
/// and column of every bad cell: an unknown column, a file that is not there, an option that
/// `genio invert` refuses or that is the corpus's own.
Manifest read_manifest(const std::string& path, const ReadWords& read);

/// What the words of a row ask, with all paths from `folder`.
InversionOptions asked_of(const std::vector<std::string>& words, const std::string& folder,
                          const ReadWords& read);

/// The cells of a line: quotes may stand around a cell, and are doubled inside it. Throws
/// InputError where a quote is not closed.
std::vector<std::string> quoted_cells(const std::string& line, char separator);

/// Words between blanks; quotes of either kind hold a word together. Throws InputError where one is
/// not closed.
std::vector<std::string> words_of(const std::string& text);

}  // namespace genio
