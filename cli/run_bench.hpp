#pragma once
#include <string>
#include <vector>

namespace genio::cli {

/// Goes on as genio-bench, which stands beside this program, with these arguments. In a build tree
/// it is built first where it is missing or older than the libraries that it is made of. Never
/// returns; throws InputError that says what to do where genio-bench cannot be had.
[[noreturn]] void run_bench(const std::vector<std::string>& arguments);

}  // namespace genio::cli
