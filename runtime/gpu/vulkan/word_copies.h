// Copies of words from buffer to buffer in a frame: lists of regions that one compute shader works off.
// Copies by the transfer stage would make the next frame wait for whatever the caller transfers of this one's
// image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "runtime/gpu/vulkan/memory.h"

namespace hearth::gpu
{

/// Regions of a frame that one dispatch copies.
struct CopyRange
{
    uint32_t first = 0, count = 0; ///< of the frame's regions
};

/// Writes the regions of a frame into its mapped buffer.
class WordCopies
{
public:
    explicit WordCopies(const Buffer& regions) : regions_(regions) {}

    /// Largest number of regions for copies of this many words.
    static uint32_t countRegions(uint64_t words);

    /// Begin the list of another dispatch.
    void begin() { range_ = {range_.first + range_.count, 0}; }

    /// Add a copy, in words.
    void add(uint32_t source, uint32_t target, uint32_t words);

    /// Add a copy of one word that is 0 or 1, of a source that is the buffer of regions itself.
    void addFlag(bool value, uint32_t target) { add(value ? 1 : 0, target, 1); }

    /// Return the copies since begin().
    CopyRange range() const { return range_; }

private:
    const Buffer& regions_;
    CopyRange range_{1, 0}; // the first region has the words 0 and 1
};

/// Write the words 0 and 1 in front of the regions of a new buffer.
void prepareCopyRegions(const Buffer& regions);

} // namespace hearth::gpu
