// Looking after a cache in a folder: how full it is, what may go, what is damaged.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::cache
{

struct Occupancy
{
    uint64_t entries = 0;
    uint64_t contents = 0;
    uint64_t bytes = 0; ///< of both
};

/// An empty cache where there is no folder.
Occupancy occupancyOf(const std::string& folder);

/// Remove what was used least recently until at most `limit_bytes` are left, contents that no entry names, and what
/// interrupted writers left. What is younger than an hour stays where no entry names it: its writer may still be at work.
/// returns  what is left
Occupancy collectGarbage(const std::string& folder, uint64_t limit_bytes);

/// Read every byte; what is damaged, or names what is not there, is removed.
/// returns  the damaged, as "entry KEY" and "content HASH"
std::vector<std::string> verifyFolder(const std::string& folder);

/// Tell that a cook has added so much, and collect garbage where the folder has got too full by that: to nine tenths of the
/// limit, so that not every cook has to.
void noteAdded(const std::string& folder, uint64_t bytes, uint64_t limit_bytes);

} // namespace hearth::cache
