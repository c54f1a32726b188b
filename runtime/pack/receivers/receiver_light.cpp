// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/receivers/receiver_light.h"

#include "formats/base/assert.h"

namespace hearth::pack
{

using formats::ReceiverBlockRecord;
using formats::ReceiverLampKind;

void updateReceivers(const formats::ReceiverTables& tables, std::span<const Float3> weights, uint32_t groups,
                     std::span<uint32_t> texels)
{
    HEARTH_ASSERT(weights.size() == tables.lamps.size());
    HEARTH_ASSERT(texels.size() == size_t{tables.atlas.width} * tables.atlas.height);
    for (const ReceiverBlockRecord& block : tables.blocks)
    {
        if ((groups >> block.group & 1) == 0)
            continue;
        for (uint32_t i = 0; i < block.texel_count; ++i)
        {
            uint32_t word = block.first_word + i;
            const uint32_t place = tables.words[word];
            Float3 sum{};
            for (uint32_t color = 0; color < block.color_count; ++color)
            {
                word += block.texel_count;
                sum = shared::addReceiverLight(
                    sum, weights[shared::receiverLamp(block, color)],
                    shared::decodeReceiverColor(tables.words[word], tables.atlas.codec));
            }
            texels[size_t{shared::receiverY(place)} * tables.atlas.width + shared::receiverX(place)] =
                shared::encodeSharedExponentWord(sum);
        }
    }
}

ReceiverCost countUpdate(const formats::ReceiverTables& tables, uint32_t groups)
{
    ReceiverCost cost;
    for (const ReceiverBlockRecord& block : tables.blocks)
    {
        if ((groups >> block.group & 1) == 0)
            continue;
        cost.texels += block.texel_count;
        cost.read_bytes +=
            sizeof(block) + uint64_t{block.texel_count} * (1 + block.color_count) * sizeof(uint32_t);
    }
    if (groups != 0)
        cost.read_bytes += tables.lamps.size() * sizeof(Float4);
    cost.written_bytes = cost.texels * sizeof(uint32_t);
    return cost;
}

ReceiverLight::ReceiverLight(const formats::ReceiverTables& tables)
    : tables_(tables),
      schedule_(tables.lamps.size()),
      texels_(size_t{tables.atlas.width} * tables.atlas.height)
{
}

void ReceiverLight::setWeight(size_t lamp, Float3 weight)
{
    HEARTH_ASSERT(lamp < tables_.lamps.size());
    const bool is_steady = tables_.lamps[lamp].kind == static_cast<uint32_t>(ReceiverLampKind::steady);
    HEARTH_ASSERT(!is_steady || weight == Float3(1, 1, 1));
    schedule_.setWeight(lamp, weight);
}

uint32_t ReceiverLight::update()
{
    const uint32_t groups = schedule_.nextGroups();
    updateReceivers(tables_, schedule_.weights(), groups, texels_);
    return groups;
}

} // namespace hearth::pack
