#pragma once
#include <string>
#include <vector>

namespace genio::test {

/// Plays a script of what clients send to a dispatcher and what workers make of it, message by
/// message. Throws std::logic_error where a law of it does not hold, as that whoever asked is
/// answered, and InputError where nothing was computed.
void play_dispatch_script(const std::string& bytes);

/// Scripts in which requests are answered.
std::vector<std::string> sample_dispatch_scripts();

}  // namespace genio::test
