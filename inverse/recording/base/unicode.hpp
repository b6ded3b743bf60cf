#pragma once
#include <string>

namespace genio {

void append_utf8(std::string& text, char32_t character);

/// True where all bytes are well-formed UTF-8.
bool is_utf8(const std::string& text);

/// Each byte as the Latin-1 character that it is.
std::string utf8_of_latin1(const std::string& text);

}  // namespace genio
