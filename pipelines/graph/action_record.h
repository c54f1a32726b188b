// Record of everything that an action's output bytes depend on; its SHA-256 is the action's cache key.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/fields.h"
#include "pipelines/graph/action.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

/// Fields, in this order: "schema", "cooker", "version" of the cooker, "processor" (its class, where bytes
/// depend on it), "word" for each word of the command line (files by role, no paths), "input ROLE" for each
/// input (SHA-256, and for user files the name without folders, which ends up in packs), "output" for each
/// output. Files that a cooker found by itself follow as "found ROLE/NAME": SHA-256 or "absent"; the name is
/// relative to the folder of the input of that role.
using Record = cache::Fields;

inline constexpr std::string_view kFound = "found ";
inline constexpr std::string_view kAbsent = "absent";

/// Return the record of an action without found files.
/// input_hashes  SHA-256 of each input
Record makeRecord(const Action& action, const std::string& cooker_version,
                  const std::vector<std::string>& input_hashes);

/// Return the cache key of a record's result.
std::string resultKey(const Record& record);

/// Return the cache key of the list of files that an action found, in all states of these files that were
/// cooked.
std::string findingsKey(const Record& record_without_found);

} // namespace hearth::graph
