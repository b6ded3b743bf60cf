// genio-make-example MODEL FILE: writes the example shape, the midsagittal line of the model under
// known forces with 0.3 mm of noise from a fixed seed. data/examples/ holds its output.
#include <fmt/format.h>
#include <fmt/os.h>

#include <cstdio>
#include <random>

#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "forward/statics/equilibrium.hpp"
#include "inverse/target/target.hpp"

int main(int argc, char** argv) {
  using namespace genio;
  if (argc != 3) return std::fprintf(stderr, "usage: genio-make-example MODEL FILE\n"), 2;
  try {
    const Model model = read_model(argv[1]);
    Parameters p = default_parameters(model);
    set_command(model, "GGP", 2.5, p);
    set_command(model, "SL", 0.4, p);
    set_command(model, "TRANS", 1.0, p);
    Workspace ws(model);
    const auto e = solve_equilibrium(model, p, model.rest, ws);
    if (!e) throw std::runtime_error(e.message);
    std::mt19937 bits(20261122);
    auto out = fmt::output_file(argv[2]);
    out.print("frame,point,x_mm,z_mm,sigma_mm,label\n");
    int number = 0;
    for (const Vec2& q : TongueLine(model).sample(e.x, 36)) {
      // Sum of uniforms: the standard's normal distribution differs between libraries.
      const auto normal = [&] {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += double(bits()) / 4294967296.0;
        return sum;
      };
      const double dx = 0.3 * normal(), dz = 0.3 * normal();
      out.print("1,{},{:.3f},{:.3f},0.3,GGP 2.5 N with TRANS 1 N and SL 0.4 N\n", ++number,
                1e3 * q[0] + dx, 1e3 * q[1] + dz);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "genio-make-example: %s\n", e.what());
    return 1;
  }
  return 0;
}
