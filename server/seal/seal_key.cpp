#include "server/seal/seal_key.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "forward/base/types.hpp"
#include "server/hub/descriptor.hpp"

namespace genio {
namespace {

constexpr size_t key_digits = 2 * seal_key_bytes;

[[noreturn]] void refuse_key(const std::string& path, const std::string& why) {
  throw InputError(fmt::format("{}: {}", path, why));
}

/// Lets the library choose what is fast on this processor, too.
void start_sodium() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium finds no source of random numbers");
}

/// Text that is wiped from memory at its end. `Size` bytes.
template <size_t Size>
struct SecretText {
  std::array<char, Size> bytes{};
  SecretText() = default;
  SecretText(const SecretText&) = delete;
  SecretText& operator=(const SecretText&) = delete;
  ~SecretText() { sodium_memzero(bytes.data(), Size); }
};

/// Judged by the open file, which nobody can exchange.
void check_is_private(const std::string& path, int fd) {
  struct stat status {};
  if (fstat(fd, &status) != 0) refuse_key(path, std::strerror(errno));
  if (!S_ISREG(status.st_mode)) refuse_key(path, "is no file; expected a key file");
  const unsigned others = status.st_mode & (S_IRWXG | S_IRWXO);
  if (others != 0)
    refuse_key(path, fmt::format("its mode {:04o} lets others than its owner at the key; expected "
                                 "0600 or 0400 (chmod 600)",
                                 status.st_mode & 07777));
  if (status.st_uid != geteuid() && status.st_uid != 0)
    refuse_key(path, "belongs to another user, who knows the key; expected a file of your own");
}

}  // namespace

SealKey::SealKey(std::span<const uint8_t, seal_key_bytes> secret) {
  start_sodium();
  std::copy(secret.begin(), secret.end(), secret_.begin());
}

SealKey::~SealKey() { sodium_memzero(secret_.data(), secret_.size()); }

SharedKey read_key_file(const std::string& path) {
  // Without waiting for the other end of a pipe.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!file) refuse_key(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  check_is_private(path, file.get());
  // The digits, a line end, and one more, which shows that the file is too long.
  SecretText<key_digits + 2> text;
  size_t size = 0;
  while (size < text.bytes.size()) {
    const ssize_t n = read(file.get(), text.bytes.data() + size, text.bytes.size() - size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse_key(path, fmt::format("cannot be read: {}", std::strerror(errno)));
    if (n == 0) break;
    size += size_t(n);
  }
  constexpr const char* expected = "expected one line of 64 hexadecimal digits, as genio key makes";
  if (size > key_digits + 1 || (size > key_digits && text.bytes[key_digits] != '\n'))
    refuse_key(path, fmt::format("is too long for a key; {}", expected));
  SecretText<seal_key_bytes> secret;
  auto* const bytes = reinterpret_cast<uint8_t*>(secret.bytes.data());
  size_t count = 0;
  if (size < key_digits || sodium_hex2bin(bytes, seal_key_bytes, text.bytes.data(), key_digits,
                                          nullptr, &count, nullptr) != 0)
    refuse_key(path, fmt::format("is no key; {}", expected));
  return std::make_shared<const SealKey>(
      std::span<const uint8_t, seal_key_bytes>(bytes, seal_key_bytes));
}

void make_key_file(const std::string& path) {
  start_sodium();
  const Descriptor file(
      open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (!file && errno == EEXIST)
    refuse_key(path, "is there already, and a key is not written over; expected a new name");
  if (!file) refuse_key(path, fmt::format("cannot be made: {}", std::strerror(errno)));
  SecretText<seal_key_bytes> secret;
  randombytes_buf(secret.bytes.data(), secret.bytes.size());
  SecretText<key_digits + 1> text;
  sodium_bin2hex(text.bytes.data(), text.bytes.size(),
                 reinterpret_cast<const uint8_t*>(secret.bytes.data()), seal_key_bytes);
  text.bytes[key_digits] = '\n';  // in the place of the zero
  const ssize_t written = write(file.get(), text.bytes.data(), text.bytes.size());
  if (written != ssize_t(text.bytes.size()) || fsync(file.get()) != 0 ||
      fchmod(file.get(), S_IRUSR | S_IWUSR) != 0) {
    const int error = errno;
    unlink(path.c_str());
    refuse_key(path, fmt::format("cannot be written: {}", std::strerror(error)));
  }
}

}  // namespace genio
