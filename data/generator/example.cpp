// genio-make-example MODEL FOLDER: writes the example files from fixed seeds. data/examples/ holds
// its output, and data/examples/README.md states the truth behind each file.
#include <cstdio>
#include <exception>
#include <string>

#include "data/generator/example_files.hpp"

int main(int argc, char** argv) {
  using namespace genio;
  if (argc != 3) return std::fprintf(stderr, "usage: genio-make-example MODEL FOLDER\n"), 2;
  try {
    const ModelDescription tongue = read_description(argv[1]);
    const std::string folder = argv[2];
    write_shape(tongue, folder);
    write_recording(tongue, folder + "/recording");
    write_word(tongue, folder + "/word");
    write_prior(folder + "/prior");
    write_manifest(folder);
    write_observations(tongue, folder + "/discover");
    write_outline(tongue, folder + "/adapt");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "genio-make-example: %s\n", e.what());
    return 1;
  }
  return 0;
}
