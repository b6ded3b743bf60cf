#pragma once
// Which column of a long table is what.

#include <map>
#include <string>
#include <vector>

#include "inverse/recording/base/table_text.hpp"

namespace genio {

/// Columns by their role: x, y, frame, time, label, likelihood, recording, speaker, point. Several
/// together tell recordings apart.
struct ColumnRoles {
  std::map<std::string, std::vector<size_t>> of;
  std::vector<size_t> others;  ///< of no role
  bool has(const std::string& role) const { return of.contains(role); }
};

/// As the caller names them: a role to a title, to a number from 1, or to several joined by '+'.
/// Throws InputError naming the option and the titles there are.
ColumnRoles named_roles(const std::vector<std::string>& titles,
                        const std::map<std::string, std::string>& names, const TableLines& lines);

/// By the titles alone; `unknown` gets the first that tells nothing, or stands for what another
/// does.
ColumnRoles guessed_roles(const std::vector<std::string>& titles, std::string& unknown);

}  // namespace genio
