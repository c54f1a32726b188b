// Why an action has to run: what differs from the last cook, in words.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/journal.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

/// What is known of an action whose result is not in the cache.
struct Situation
{
    Record record; ///< now, with what the last cook found, as it is now; empty: an input cannot be read
    bool is_forced = false;             ///< --force
    bool is_damaged = false;            ///< its result is there, but not whole
    std::vector<std::string> waits_for; ///< cookers that run before it, so that its record cannot be known
};

/// The action of the last cook that stands where this one does; nullptr where there is none.
const JournalAction* lastOf(const Action& action, const Graph& graph, const Journal& journal);

/// One line or more: "parameter --quality: default -> high", "house.glb: its content has changed", ...
/// journal  of the last cook into the same pack; none: there was none
std::vector<std::string> causesOf(const Action& action, const Graph& graph, const Situation& situation,
                                  const std::optional<Journal>& journal);

} // namespace hearth::graph
