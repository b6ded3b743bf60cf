#include "cli/service/key.hpp"

#include <fmt/format.h>

#include <memory>

#include "cli/support.hpp"
#include "server/seal/seal_key.hpp"

namespace genio::cli {

Runner add_key(Options& options) {
  auto file = std::make_shared<std::string>();
  options.add("file", *file, "Name of the new key file, which only its owner may read",
              {.required = true});
  options.footer(
      "Example: genio key genio.key\n"
      "         genio serve --key genio.key\n"
      "         genio request --key genio.key --target data/examples/example_shape.csv");
  return [file]() -> int {
    make_key_file(*file);
    print_line(fmt::format("{}: a new key; give it to the server and to all who may ask", *file));
    return done;
  };
}

}  // namespace genio::cli
