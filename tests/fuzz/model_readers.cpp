// Models, surfaces, commands and observations.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "discrepancy/conditions/observations.hpp"
#include "forward/anatomy/grenoble_files.hpp"
#include "forward/geometry/box_mesh.hpp"
#include "forward/geometry/surfaces/bone_distance.hpp"
#include "forward/geometry/vtk_io.hpp"
#include "forward/motion/commands_over_time.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {
namespace {

namespace fs = std::filesystem;

/// A model of two elements: what is read with it is built a million times.
ModelDescription two_elements() {
  ModelDescription d = small_block();
  d.mesh = box_mesh({0.01, 5e-3, 5e-3}, {2, 1, 1});  // nodes by x, then y, then z
  d.supports.assign(12, Support::free);
  std::fill_n(d.supports.begin(), 6, Support::fixed);
  d.muscles[0].fibres = {{{6, {}}, {7, {}}, {8, {}}}};
  d.muscles[1].fibres = {{{0, {}}, {6, {}}}, {{-1, Vec3(0.03, 0.01, 0.03)}, {11, {}}}};
  for (Muscle& muscle : d.muscles) muscle.elements = {0, 1};
  d.landmarks = {6, 7, 8};
  d.midsagittal = {3, 6, 7, 8, 11};
  for (Vec3& v : d.palate->vertices) v[2] -= 5e-3;
  return d;
}

/// The files of that model, by name.
std::map<std::string, std::string> model_files() {
  std::string folder = (fs::temp_directory_path() / "genio-seed-XXXXXX").string();
  if (!mkdtemp(folder.data())) throw std::runtime_error(folder + ": cannot be made");
  write_description(two_elements(), folder);
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(in), {}};
  }
  fs::remove_all(folder);
  return files;
}

void build(const ModelDescription& description, const std::string& folder) {
  build_model(description, folder);
}

/// Distances to the palate. A model's fields of them take a fiftieth of a second under the
/// sanitizers: the fuzzer, which calls millions of times, builds one of 32, by what was read.
void ask_palate(const ModelDescription& description, const std::string& folder) {
  static const bool fuzzing = std::getenv("GENIO_FUZZ_READER") != nullptr;
  if (!description.palate) return;
  const std::vector<Vec3>& nodes = description.mesh.nodes;
  const BoneDistance bone(facing_tongue(*description.palate, nodes));
  double sum = 0;
  for (const Vec3& at : nodes) sum += bone(at);
  if (!fuzzing || std::hash<double>()(sum) % 32 == 0) build_model(description, folder);
}

/// One of a model's files, the others as they should be, and what is made of what was read.
FuzzReader model_reader(const std::string& name, const std::string& file,
                        std::map<std::string, std::string> files,
                        void (*use)(const ModelDescription&, const std::string&) = build) {
  FuzzReader reader{name, file, {files.at(file)}, [use](const std::string& path) {
                      const std::string folder = fs::path(path).parent_path().string();
                      use(read_description(folder), folder);
                    }};
  files.erase(file);
  reader.beside = std::move(files);
  return reader;
}

std::string ply(const std::string& form, const std::string& body) {
  return "ply\nformat " + form +
         " 1.0\ncomment a\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nproperty uchar red\nelement face 2\n"
         "property list uchar int vertex_indices\nend_header\n" +
         body;
}

/// The bytes of a value, the first one first where `big`.
template <class T>
std::string bytes(T value, bool big) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  return big ? std::string(raw.rbegin(), raw.rend()) : raw;
}

std::string binary_ply(bool big) {
  std::string body;
  for (const float x : {0.f, 1.f})
    for (const float y : {0.f, 1.f})
      body += bytes(x, big) + bytes(y, big) + bytes(1.5f, big) + '\xFF';
  for (int k = 0; k < 2; ++k)
    body += '\3' + bytes(int32_t(k), big) + bytes(int32_t(1 + 2 * k), big) + bytes(int32_t(2), big);
  return ply(big ? "binary_big_endian" : "binary_little_endian", body);
}

std::string binary_stl() {
  std::string text(80, ' ');
  text += bytes(uint32_t(2), false);
  for (int k = 0; k < 2; ++k) {
    for (const int x : {0, 0, 1, 0, 0, 0, 1, 0, k, 1, 1, 0}) text += bytes(float(x), false);
    text += std::string(2, '\0');
  }
  return text;
}

std::vector<FuzzReader> surface_readers() {
  const auto read = [](const std::string& path) { midsagittal_cut(read_surface(path)); };
  const std::string strips =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty float64 y\n"
      "property float32 z\nelement tristrips 1\nproperty list int int vertex_indices\n"
      "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 1\n2 2 2\n6 0 1 2 3 -1 4\n";
  return {{"ply",
           "scan.ply",
           {ply("ascii", "0 0 0 1\n0 1 0 2\n1 1 0 3\n1 0 0 4\n4 0 1 2 3\n3 0 1 2\n"),
            binary_ply(false), binary_ply(true), strips},
           read},
          {"obj",
           "scan.obj",
           {"mtllib a.mtl\no a\nv 0 0 0\nv 0 1 0 1\nv 1 1 0 0.5 0.5 0.5\nv 1 0 0\nv .5 -.5 0\n"
            "vn 0 0 1\nusemtl m\nf 1/1/1 2//1 3\nf 1 2 3 4\nf -5 -4 \\\n -3 -2 -1\nl 1 2\n"},
           read},
          {"stl",
           "scan.stl",
           {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
            "vertex 0 1e-1 0\nendloop\nendfacet\nendsolid a\n",
            binary_stl()},
           read}};
}

std::string vtk_grid(const std::string& format, const std::string& values) {
  return "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\"><UnstructuredGrid><Piece>"
         "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"" +
         format + "\">" + values +
         "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\">0 "
         "1</DataArray>"
         "<DataArray type=\"Int64\" Name=\"offsets\">1 2</DataArray><DataArray type=\"UInt8\" "
         "Name=\"types\">1 1</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

std::vector<FuzzReader> grenoble_readers() {
  const auto fibres = [](const std::string& path) {
    std::vector<Muscle> muscles(2);
    grenoble::read_fibres(path, 900, muscles);
  };
  const auto selections = [](const std::string& path) {
    grenoble::read_muscle_elements(path, 740);
    grenoble::read_muscle_names(path);
  };
  const auto elements = [](const std::string& path) {
    grenoble::read_mesh(fs::path(path).parent_path() / "a.node", path);
  };
  const auto nodes = [](const std::string& path) {
    grenoble::read_mesh(path, fs::path(path).parent_path() / "a.elem");
  };
  const std::string node = "1 0 0 0\n2 0.1 -2e-2 0\n", element = "1 2 1 2 1 2 1 2 1 1\n";
  return {{"grenoble_fibres",
           "Fibers.mac",
           {"! fibres\nFIBER(1,1,1) = 7\nFIBER(2,1,1) = 8\nFIBER(1,2,1) = 4037\nFIBER(1,1,2)=9\n"},
           fibres},
          {"grenoble_muscles",
           "CreateMuscles.mac",
           {"ESEL,S,ELEM,,1,20,2\nESEL,A,ELEM,,7\nCM,GGP_L,ELEM\nESEL, S, ELEM, , 3, 4\n"
            "CM,SL,ELEM\nmuscleName(1) = 'GGP_L'\nmuscleName(2)='SL'\n"},
           selections},
          {"grenoble_nodes", "a.node", {node}, nodes, {{"a.elem", element}}},
          {"grenoble_elements", "a.elem", {element}, elements, {{"a.node", node}}},
          {"grenoble_list",
           "list.txt",
           {"0 7 8\n899\n"},
           [](const std::string& path) { grenoble::read_list(path, 900); }},
          {"grenoble_forces",
           "MuscleMaxForce.txt",
           {"GGP 32.8\nSL 1e1\n\n"},
           [](const std::string& path) { grenoble::read_max_forces(path); }}};
}

}  // namespace

std::vector<FuzzReader> model_readers() {
  static const Model model = small_model();
  const auto files = model_files();
  std::vector<FuzzReader> readers = {
      model_reader("model", "model.toml", files),
      model_reader("model_mesh", "mesh.vtu", files),
      model_reader("model_fibres", "fibres.vtp", files),
      model_reader("model_palate", "palate.obj", files, ask_palate),
      {"vtk",
       "grid.vtu",
       {vtk_grid("ascii", "0 0 0 1 1 1"),
        vtk_grid("binary", "GAAAAAAAAAA=AAAAAAAAgD8AAABAAABAQAAAgEAAAKBA")},
       [](const std::string& path) { read_vtk(path); }},
      {"commands",
       "commands.csv",
       {"# word\ntime_s,GGP_N,gravity.z\n0,0,-9.81\n0.1,1.5,0\n0.1, 2e-1 ,3\n"},
       [](const std::string& path) { read_commands(model, path, default_parameters(model)); }},
      {"observations",
       "observations.toml",
       {"noise_mm = 0.4\nforce_sd_percent = 5\nbilateral = true\nhead_pose = { shift_sd_mm = 1 }\n"
        "[[condition]]\nname = \"i\"\ntarget = \"i.csv\"\nframe = 1\nforces_N = { GGP = 1.0 }\n"
        "effects = { \"gravity.z\" = -9.81 }\nheldout = false\n"},
       [](const std::string& path) { read_observations(path, model); },
       {{"i.csv", "frame,point,x_mm,z_mm\n1,1,0,10\n1,2,5,10\n1,3,10,10\n1,4,15,10\n"}}}};
  for (auto&& some : {surface_readers(), grenoble_readers()})
    readers.insert(readers.end(), some.begin(), some.end());
  return readers;
}

}  // namespace genio::test
