// genio-make-generic FOLDER: writes the generic tongue. data/generic/ holds its output.
#include <cstdio>
#include <exception>

#include "data/generator/generic_tongue.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: genio-make-generic FOLDER\n"), 2;
  try {
    genio::write_description(genio::generic::make_generic_tongue(), argv[1]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "genio-make-generic: %s\n", e.what());
    return 1;
  }
  return 0;
}
