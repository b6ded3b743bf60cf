#include "tests/fuzz/fuzz_folder.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "forward/base/types.hpp"

namespace genio::test {
namespace {

namespace fs = std::filesystem;

void put(const std::string& path, const std::string& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

FuzzFolder::FuzzFolder(const FuzzReader& reader) : reader_(reader) {
  const fs::path memory = "/dev/shm";
  const fs::path where = fs::is_directory(memory) ? memory : fs::temp_directory_path();
  std::string name = (where / "genio-fuzz-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be made");
  folder_ = name;
  for (const auto& [file, text] : reader_.beside) put(folder_ + "/" + file, text);
}

FuzzFolder::~FuzzFolder() {
  std::error_code none;
  fs::remove_all(folder_, none);
}

bool FuzzFolder::reads(const std::string& input) {
  const std::string path = folder_ + "/" + reader_.file;
  put(path, input);
  try {
    reader_.read(path);
    return true;
  } catch (const InputError& e) {
    if (std::string(e.what()).empty()) throw std::logic_error("an InputError without a reason");
    return false;
  }
}

}  // namespace genio::test
