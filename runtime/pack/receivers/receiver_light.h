// Light of a receiver atlas under the weights that a game gives its lamps: E(x) = sum of w_k E_k(x), computed
// by the CPU. The compute shader receivers_update.comp gives the same bytes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/receivers.h"
#include "runtime/pack/receivers/receiver_schedule.h"

#include <vector>

namespace hearth::pack
{

/// Write the texels of some update groups. Reads nothing of `texels`: repeated updates change nothing.
/// tables   of a checked pack
/// weights  [tables.lamps.size()]; of steady light 1
/// groups   by bits
/// texels   [width * height], row by row: words of E5B9G9R9, irradiance / scale
void updateReceivers(const formats::ReceiverTables& tables, std::span<const Float3> weights, uint32_t groups,
                     std::span<uint32_t> texels);

/// Work of an update, and the bytes that it moves if each is read and written once.
struct ReceiverCost
{
    uint64_t texels = 0;
    uint64_t read_bytes = 0; ///< of blocks, words and weights
    uint64_t written_bytes = 0;

    bool operator==(const ReceiverCost&) const = default;
};

/// Count what the update of some groups costs: nothing for none.
/// groups  by bits
ReceiverCost countUpdate(const formats::ReceiverTables& tables, uint32_t groups);

/// Atlas of one checked pack, which must outlive it. All texels begin with no light; those of no block keep
/// it. Only the constructor allocates.
class ReceiverLight
{
public:
    explicit ReceiverLight(const formats::ReceiverTables& tables);

    /// Set the weight of a lamp: finite and at least 0, and 1 for steady light (asserted). All begin with 1.
    void setWeight(size_t lamp, Float3 weight);

    /// Update the texels that are due in this frame.
    /// returns  their groups, by bits; 0 if nothing was to be done
    uint32_t update();

    /// Return all texels, row by row: words of E5B9G9R9, irradiance / scale.
    std::span<const uint32_t> texels() const { return texels_; }

private:
    formats::ReceiverTables tables_;
    ReceiverSchedule schedule_;
    std::vector<uint32_t> texels_;
};

} // namespace hearth::pack
