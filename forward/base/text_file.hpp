#pragma once
#include <functional>
#include <string>

namespace genio {

/// Lets `write` make a file under another name beside `path`, PATH.new, and gives it its name once
/// it is whole: an interruption leaves what stood there before. What is no regular file, such as
/// /dev/stdout, is written in place. Throws InputError naming the path where the file cannot take
/// its place; what `write` throws passes through, and nothing is left beside.
void replace_file(const std::string& path, const std::function<void(const std::string&)>& write);

/// Writes a whole text file by replace_file(). Throws InputError with the path and the reason, such
/// as a full disk.
void write_text(const std::string& path, const std::string& text);

/// Makes a folder and those above it. Throws InputError with the path and the reason.
void make_folder(const std::string& path);

}  // namespace genio
