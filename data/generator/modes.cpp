// genio-make-modes OUTLINES OUT: how the speakers of a file of outlines vary.
// data/anatomy/outline_modes.csv is its output for the 41 speakers that data/anatomy/README.md
// names.
#include <cstdio>
#include <exception>

#include "speaker/modes/modes_file.hpp"
#include "speaker/outline/outline_facing.hpp"

int main(int argc, char** argv) {
  using namespace genio;
  if (argc != 3) return std::fprintf(stderr, "usage: genio-make-modes OUTLINES OUT\n"), 2;
  try {
    std::vector<OutlinePoints> speakers;
    for (const std::string& speaker : outline_speakers(argv[1]))
      speakers.push_back(outline_points(facing_model(read_outline(argv[1], speaker))));
    write_outline_modes(modes_of_outlines(speakers),
                        "statistics of midsagittal outlines of 41 speakers by Antoine Serrurier, "
                        "see README.md",
                        argv[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "genio-make-modes: %s\n", e.what());
    return 1;
  }
  return 0;
}
