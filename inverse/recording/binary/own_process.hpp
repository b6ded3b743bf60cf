#pragma once
#include <functional>
#include <string>

namespace genio {

/// What `work` gives, done in a process of its own. Libraries that read strangers' binary files may
/// crash there, or ask for any memory and time: the process gets 2 GB and 30 s, and no standard
/// error. Throws InputError beginning with `path` for whatever goes wrong in it; that of `work`
/// itself goes through as it is.
std::string in_own_process(const std::string& path, const std::function<std::string()>& work);

}  // namespace genio
