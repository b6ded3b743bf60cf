// What `genio surface` reads: stacks of contours, label volumes, regions to keep.

#include <cstdint>
#include <cstring>

#include "speaker/slices/stack_surface.hpp"
#include "speaker/solid/kept_region.hpp"
#include "speaker/volume/label_surface.hpp"
#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {
namespace {

template <class T>
void put_number(std::string& text, size_t at, T value) {
  std::memcpy(text.data() + at, &value, sizeof value);
}

/// A volume of 5 x 4 x 4 voxels, in which the middle has the label 1.
std::string small_volume(int type, bool rows) {
  std::string text(352, '\0');
  put_number(text, 0, std::int32_t(348));
  for (const auto& [at, n] : {std::pair{40, 3},
                              {42, 5},
                              {44, 4},
                              {46, 4},
                              {48, 1},
                              {50, 1},
                              {52, 1},
                              {54, 1},
                              {70, type},
                              {72, type == 16 ? 32 : 8},
                              {252, rows ? 0 : 1},
                              {254, rows ? 1 : 0}})
    put_number(text, size_t(at), std::int16_t(n));
  for (const auto& [at, x] : {std::pair{76, 1.f},
                              {80, 1.f},
                              {84, 1.f},
                              {88, 2.f},
                              {108, 352.f},
                              {112, 1.f},
                              {260, 0.6f},
                              {280, 1.f},
                              {300, 1.f},
                              {320, 2.f}})
    put_number(text, size_t(at), x);
  text[123] = 2;
  text.replace(344, 4, std::string("n+1\0", 4));
  for (int v = 0; v < 80; ++v) {
    const int i = v % 5, j = v / 5 % 4, k = v / 20;
    const bool in = i > 0 && i < 4 && j > 0 && j < 3 && k > 0 && k < 3;
    if (type == 16) {
      text.resize(text.size() + 4);
      put_number(text, text.size() - 4, in ? 1.f : 0.f);
    } else {
      text += char(in);
    }
  }
  return text;
}

}  // namespace

std::vector<FuzzReader> surface_input_readers() {
  const std::string stack =
      "slice,point,x_mm,y_mm,z_mm\n1,1,0,0,0\n1,2,9.5,0,0\n1,3,0,9,0\n2,1,0,0,4\n2,2,9,0,4\n"
      "2,3,9,9,4\n2,4,0,9,4\n2,1,20,0,4\n2,2,25,0,4\n2,3,20,5,4\n";
  const std::string named =
      "slice;contour;point;x_mm;y_mm;z_mm\na;1;1;0;0;0\na;1;2;9,5;0;0\na;1;3;0;9;0\nb;1;1;1;0;-4\n"
      "b;1;2;9;0;-4\nb;1;3;0;9;-4\n";
  return {{"contour_stack",
           "stack.csv",
           {stack, named},
           [](const std::string& path) { stack_surface(read_contour_stack(path), 2e-3); }},
          {"label_volume",
           "volume.nii",
           {small_volume(2, true), small_volume(16, false)},
           [](const std::string& path) { label_surface(read_labelled_box(path, {})); }},
          {"kept_region",
           "keep.csv",
           {"x_mm,y_mm,z_mm,radius_mm\n1,2,3,4\n-1e1,0,.5,2\n"},
           [](const std::string& path) { read_kept_region({path}); }}};
}

}  // namespace genio::test
