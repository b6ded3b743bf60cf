#include "cli/file_hashes.hpp"

#include <sodium.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "forward/base/types.hpp"

namespace genio::cli {
namespace {

std::string sha256(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": cannot be read");
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  std::array<char, 65536> part{};
  while (in.read(part.data(), std::streamsize(part.size())) || in.gcount() > 0)
    crypto_hash_sha256_update(&state, reinterpret_cast<const unsigned char*>(part.data()),
                              static_cast<unsigned long long>(in.gcount()));
  std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
  crypto_hash_sha256_final(&state, hash.data());
  std::array<char, 2 * crypto_hash_sha256_BYTES + 1> text{};
  return sodium_bin2hex(text.data(), text.size(), hash.data(), hash.size());
}

}  // namespace

std::map<std::string, std::string> model_file_hashes(const std::string& model) {
  namespace fs = std::filesystem;
  const fs::path given(model);
  const fs::path folder = fs::is_directory(given) ? given : given.parent_path();
  std::map<std::string, std::string> hashes;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder))
    if (entry.is_regular_file())
      hashes[entry.path().filename().string()] = sha256(entry.path().string());
  return hashes;
}

}  // namespace genio::cli
