#pragma once
#include <string>

namespace genio::test {

/// Plays a script in which parts of messages come in any order, some of them wrong. Throws
/// std::logic_error where more is held than the limits say, or a message comes that was not sent,
/// and InputError where none came whole.
void play_parts_script(const std::string& bytes);

/// A script in which messages come whole.
std::string sample_parts_script();

}  // namespace genio::test
