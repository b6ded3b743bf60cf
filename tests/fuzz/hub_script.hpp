#pragma once
#include <string>

namespace genio::test {

/// Plays a script of what clients do to the connections of a hub, over pairs of sockets without its
/// loop and its network. What each of them receives is compared with what a model of a few lines
/// says, and what the hub holds with its limits. Throws std::logic_error where they differ, and
/// InputError where no client received anything.
void play_hub_script(const std::string& bytes);

/// A script in which messages pass.
std::string sample_hub_script();

}  // namespace genio::test
