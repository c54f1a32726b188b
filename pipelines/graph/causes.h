// Explains why an action must run: the differences from the last cook, as text.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/journal.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

/// State of an action whose result is not in the cache.
struct ActionState
{
    /// current record, with current hashes of the files that the last cook found; empty: an input cannot be
    /// read
    Record record;
    bool is_forced = false;  ///< --force
    bool is_damaged = false; ///< the cache has a result, but a damaged one
    std::vector<std::string>
        pending_cookers; ///< cookers that run before it, so that its record is not known yet
};

/// Return the corresponding action of the last cook; nullptr where there is none.
const JournalAction* findLastAction(const Action& action, const Graph& graph, const Journal& journal);

/// Return the causes, one a line, at least one: "parameter --quality: default -> high", "house.glb: its
/// content has changed", ...
/// journal  of the last cook into the same pack; nullopt: none
std::vector<std::string> findCauses(const Action& action, const Graph& graph, const ActionState& state,
                                    const std::optional<Journal>& journal);

} // namespace hearth::graph
