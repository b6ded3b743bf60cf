#pragma once
// Files that others wrote: looked at before they are opened.

#include <cstdint>
#include <string>

namespace genio {

/// More than any file that Genio reads line by line [bytes].
inline constexpr std::uintmax_t largest_input = std::uintmax_t(2) << 30;
/// More than any file that Genio reads whole [bytes].
inline constexpr std::uintmax_t largest_whole = std::uintmax_t(512) << 20;
/// More than any file that people write by hand [bytes].
inline constexpr std::uintmax_t largest_settings = std::uintmax_t(4) << 20;

/// Throws InputError, naming the path and the reason, unless it is a regular file of at most
/// `largest` bytes: a pipe or a device may have no end, and opening one may wait for ever.
void check_input(const std::string& path, std::uintmax_t largest = largest_input);

/// The file's bytes. Throws InputError as check_input() does, and where it cannot be opened.
std::string read_file(const std::string& path, std::uintmax_t largest = largest_whole);

}  // namespace genio
