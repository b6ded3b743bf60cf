// What is measured of one speaker's tissue.

#include "speaker/indentation/force_data.hpp"
#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {

std::vector<FuzzReader> speaker_readers() {
  return {{"force_curve",
           "curve.csv",
           {"# indenter = sphere\n# radius_mm = 7\ndepth_mm,force_N,sd\n1,0.01,0.001\n2,0.03,"
            "0.001\n3,0.06,0.002\n4,0.1,0.003\n5,0.15,0.004\n",
            "force_N;depth_mm\n0,15;5\n0,1;4\n0,06;3\n0,03;2\n0,01;1\n"},
           [](const std::string& path) { read_force_file(path); }}};
}

}  // namespace genio::test
