#pragma once
#include <string>
#include <vector>

namespace genio {

struct ProgramEnd {
  int status = 0;    ///< exit status; 128 and the signal where one ended it
  std::string said;  ///< on standard output and standard error
};

/// Runs a program that is found as a shell finds it, and waits for it. Throws InputError where
/// there is none.
ProgramEnd run_program(std::vector<std::string> words);

}  // namespace genio
