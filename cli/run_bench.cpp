#include "cli/run_bench.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "forward/base/types.hpp"

namespace genio::cli {
namespace {

namespace fs = std::filesystem;

/// As execv() and its kin want them: they live as long as `words`.
std::vector<char*> c_strings(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

/// Runs a program with its standard output on standard error. False where it fails.
bool succeeds(std::vector<std::string> words) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t process = 0;
  const bool started = posix_spawnp(&process, words.front().c_str(), &actions, nullptr,
                                    c_strings(words).data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return started && waitpid(process, &status, 0) == process && status == 0;
}

/// Whether a room of the tree (rooms.txt) was built after the program that it is part of.
bool outdated(const fs::path& tree, const fs::path& program) {
  std::ifstream rooms(tree / "rooms.txt");
  for (std::string line; std::getline(rooms, line);) {
    const std::string name = line.substr(0, line.find('|'));
    const fs::path library = tree / name / fmt::format("libgenio_{}.a", name);
    if (fs::exists(library) && fs::last_write_time(program) < fs::last_write_time(library))
      return true;
  }
  return false;
}

void build(const fs::path& tree, const std::string& why) {
  fmt::print(stderr, "genio: {}\n", why);
  if (!succeeds({"cmake", "--build", tree.string(), "--target", "genio-bench"}))
    throw InputError(
        fmt::format("bench: genio-bench cannot be built; see what "
                    "`cmake --build {} --target genio-bench` says",
                    tree.string()));
}

}  // namespace

void run_bench(const std::vector<std::string>& arguments) {
  const fs::path self = fs::read_symlink("/proc/self/exe");
  const fs::path program = self.parent_path() / "genio-bench";
  const fs::path tree = self.parent_path().parent_path();
  if (fs::exists(tree / "CMakeCache.txt")) {
    if (!fs::exists(program))
      build(tree, "building genio-bench, once; this takes about two minutes on two processors");
    else if (outdated(tree, program))
      build(tree, "building genio-bench again: it is older than the rooms it is made of");
  }
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::fflush(nullptr);
  execv(program.c_str(), c_strings(words).data());
  if (errno == ENOENT)
    throw InputError(fmt::format("bench: {} is missing; build all of Genio and install it again",
                                 program.string()));
  throw InputError(fmt::format("bench: {}: {}", program.string(), std::strerror(errno)));
}

}  // namespace genio::cli
