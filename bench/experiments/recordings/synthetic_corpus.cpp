#include "bench/experiments/recordings/synthetic_corpus.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "forward/base/text_file.hpp"
#include "forward/model/build_model.hpp"

namespace genio::bench {
namespace {

namespace fs = std::filesystem;

/// The table of elasticity with its constants multiplied: a speaker of other tissue.
std::string stiffened(const std::string& toml, double factor) {
  std::istringstream in(toml);
  std::string out;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("[")) inside = line.starts_with("[effect.elasticity]");
    const auto equals = line.find('=');
    if (inside && equals != std::string::npos)
      line = fmt::format("{}= {:.6g}", line.substr(0, equals),
                         factor * std::stod(line.substr(equals + 1)));
    out += line + "\n";
  }
  return out;
}

/// The folder of a model, whatever names it.
fs::path folder_of(const std::string& model) {
  return fs::is_directory(model) ? fs::path(model) : fs::path(model).parent_path();
}

std::string write_speaker(const fs::path& model, const std::string& folder, double factor) {
  make_folder(folder);
  for (const auto& file : fs::directory_iterator(model))
    if (file.is_regular_file())
      fs::copy_file(file.path(), fs::path(folder) / file.path().filename(),
                    fs::copy_options::overwrite_existing);
  std::ifstream in(model / "model.toml");
  const std::string toml(std::istreambuf_iterator<char>(in), {});
  write_text(folder + "/model.toml", stiffened(toml, factor));
  return folder;
}

/// The options that the recording's owner would give.
std::string options_text(const MeasuredOptions& o) {
  std::string text;
  if (o.read.mm_per_px > 0) text += fmt::format(" --mm-per-px {:g}", o.read.mm_per_px);
  if (!o.sensors.empty()) text += fmt::format(" --sensors {}", fmt::join(o.sensors, ","));
  if (!o.palate_sensor.empty()) text += " --palate-sensor " + o.palate_sensor;
  return text.empty() ? text : text.substr(1);
}

}  // namespace

std::string write_corpus_files(const SyntheticCorpus& c, const std::string& model_folder,
                               const std::string& folder) {
  constexpr Device devices[] = {Device::aaa, Device::edgetrak, Device::articulograph,
                                Device::getcontours, Device::table};
  std::mt19937 random(c.seed);
  std::vector<Model> models;
  for (int s = 0; s < c.speakers; ++s)
    models.push_back(read_model(write_speaker(folder_of(model_folder),
                                              fmt::format("{}/models/S{}", folder, s + 1),
                                              std::pow(1.25, s - 1))));
  std::string manifest = "recording,palate,speaker,model,options\n";
  for (int k = 0; k < c.recordings; ++k) {
    const int speaker = k % c.speakers;
    const WrittenSession w = written(
        draw_session(models[size_t(speaker)], devices[(k / c.speakers) % 5], random, c.frames));
    const std::string name = fmt::format("S{}/take{:02}", speaker + 1, k / c.speakers + 1);
    const std::string take = fmt::format("{}/{}", folder, name);
    make_folder(take);
    write_text(fmt::format("{}/{}", take, w.target), w.target_text);
    if (!w.palate.empty()) write_text(fmt::format("{}/{}", take, w.palate), w.palate_text);
    manifest += fmt::format("{}/{},{},S{},models/S{},\"{}\"\n", name, w.target,
                            w.palate.empty() ? "" : name + "/" + w.palate, speaker + 1, speaker + 1,
                            options_text(w.options));
  }
  write_text(folder + "/manifest.csv", manifest);
  return folder + "/manifest.csv";
}

}  // namespace genio::bench
