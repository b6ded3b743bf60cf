#pragma once
// Which of several curves in a file is meant.

#include "inverse/recording/base/contours.hpp"

namespace genio {

/// What the role's curve may be called: true of "DLC_Tongue" for the tongue, of "Roof" for the
/// palate. Throws InputError where there is no such role.
bool is_called_for(const std::string& name, const std::string& role);

/// The name to take of those that stand in a file: what the options say, else the only one that is
/// called for the role; a palate file with a single curve means that. Throws InputError beginning
/// with `where` and naming all of them, where none or several fit.
std::string named_curve(const std::vector<std::string>& names, const ReadOptions& options,
                        const std::string& where);

}  // namespace genio
