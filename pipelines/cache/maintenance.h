// Maintenance of a cache directory: size, garbage collection, verification.
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
    uint64_t bytes = 0; ///< of entries and contents
};

/// Measure a cache directory; all zero where there is none.
Occupancy measureOccupancy(const std::string& folder);

/// Collect garbage: remove the least recently used entries until at most `limit_bytes` are left, contents
/// that no entry refers to, and temporary files of interrupted writers. Contents and temporary files younger
/// than an hour stay even if no entry refers to them: their writer may still be at work.
/// returns  size of the remaining cache
Occupancy collectGarbage(const std::string& folder, uint64_t limit_bytes);

/// Verify every byte. Damaged files, and entries whose contents are missing, are removed.
/// returns  the damaged files, as "entry KEY" and "content HASH"
std::vector<std::string> verifyFolder(const std::string& folder);

/// Record that a cook has added `bytes`. If the directory exceeds its limit then, collect garbage down to
/// nine tenths of the limit, so that not every cook has to.
void recordGrowth(const std::string& folder, uint64_t bytes, uint64_t limit_bytes);

} // namespace hearth::cache
