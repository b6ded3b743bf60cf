#pragma once
#include <string>

namespace genio {

/// The bytes of a text file as UTF-8 without byte-order mark: UTF-16 by its mark or by its zero
/// bytes, UTF-8 where they are that, else Latin-1.
std::string utf8_of(const std::string& bytes);

}  // namespace genio
