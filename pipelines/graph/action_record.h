// All that an action's bytes depend on, written down: the record whose SHA-256 is the action's key.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/fields.h"
#include "pipelines/graph/action.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

/// Fields, in this order: "schema", "cooker", "version" of the cooker, "processor" (its class, where bytes depend on it),
/// "word" for each word of the command line (files by role: no path is in it), "input ROLE" for each input (SHA-256, and
/// for the user's files the name without folders, which ends up in packs), "output" for each output. What a cooker found by
/// itself follows as "found ROLE/NAME": SHA-256 or "absent", its name relative to the folder of the input of that role.
using Record = cache::Fields;

inline constexpr std::string_view kFound = "found ";
inline constexpr std::string_view kAbsent = "absent";

/// input_hashes  of each input
Record recordOf(const Action& action, const std::string& cooker_version,
                const std::vector<std::string>& input_hashes);

/// The key under which the results of a record lie.
std::string resultKey(const Record& record);

/// For an action that finds files: the key of the list of what it found, in all states of these files that were cooked.
std::string findingsKey(const Record& record_without_found);

} // namespace hearth::graph
