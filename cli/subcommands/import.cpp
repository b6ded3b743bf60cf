#include "cli/subcommands/import.hpp"

#include <fmt/format.h>

#include <memory>

#include "forward/anatomy/import_grenoble.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"

namespace genio::cli {

Runner add_import(Options& options) {
  auto kind = std::make_shared<std::string>();
  auto from = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>();
  options.add("kind", *kind, "grenoble", {.required = true});
  options.add("folder", *from, "Folder with tongue/ and surfaces_icp_m/", {.required = true});
  options.add("--out", *out, "Model folder to write", {.required = true});
  options.footer("Example: genio import grenoble path/to/grenoble --out grenoble");
  return [=]() -> int {
    if (*kind != "grenoble")
      throw InputError(fmt::format("import {}: unknown; did you mean grenoble?", *kind));
    const auto description = import_grenoble(*from);
    build_model(description, *from);  // refuses what could not be computed with
    write_description(description, *out);
    fmt::print(stderr, "{}: {} nodes, {} elements, {} muscles\n", *out,
               description.mesh.nodes.size(), description.mesh.elements.size(),
               description.muscles.size());
    return done;
  };
}

}  // namespace genio::cli
