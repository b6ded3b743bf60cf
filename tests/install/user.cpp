// What a program of somebody else does with the installed package.

#include <cstdio>

#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/shape/infer.hpp"
#include "server/client.hpp"

int main(int, char** argv) {
  using namespace genio;
  const Model m = read_model(argv[1]);
  Workspace ws(m);
  const Answer a = infer(m, curve_target(m, m.rest, 30, 1e-3), Prior{}, ws);
  std::printf("%s %s\n", to_string(a.status), to_string(a.verdict));
  return a.verdict == Verdict::explained ? 0 : 1;
}
