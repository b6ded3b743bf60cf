#pragma once
#include <string_view>

namespace genio {

/// True where brackets of the JSON text stand deeper than in any file of ours. Copying, comparing
/// and printing such values takes a call a level, and a stack ends.
bool nested_too_deep(std::string_view json);

}  // namespace genio
