#pragma once
#include <string>

#include "server/journal/limits.hpp"

namespace genio {

/// Prunes a journal's file to its end, beside its server if it has one. It works in transactions of
/// some milliseconds, `most_at_once` entries in each, for which the server waits. What is not
/// answered is safe, and of other entries the server keeps nothing in memory. Gives the room back
/// to the file system. Throws InputError naming the file.
Pruned prune_journal(const std::string& path, const PruneRule& rule, int most_at_once = 100);

}  // namespace genio
