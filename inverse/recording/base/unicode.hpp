#pragma once
#include <string>

namespace genio {

void append_utf8(std::string& text, char32_t character);

/// True where all bytes are well-formed UTF-8.
bool is_utf8(const std::string& text);

/// Each byte as the Latin-1 character that it is.
std::string utf8_of_latin1(const std::string& text);

/// The bytes of a text file as UTF-8 without byte-order mark: UTF-16 by its mark or by its zero
/// bytes, UTF-8 where they are that, else Latin-1.
std::string utf8_of(const std::string& bytes);

}  // namespace genio
