#include "tests/fuzz/fuzz_folder.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "forward/base/types.hpp"

namespace genio::test {
namespace {

namespace fs = std::filesystem;

constexpr size_t longest_reason = 5000;

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
    const std::string reason = e.what();
    if (reason.empty() || reason.size() > longest_reason || reason.find('\n') != reason.npos)
      throw std::logic_error("an InputError that is not one line of words: " + reason);
    return false;
  }
}

}  // namespace genio::test
