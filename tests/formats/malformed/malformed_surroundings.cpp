// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

namespace hearth::test
{

const std::vector<MalformedPack>& malformedSurroundings()
{
    static const std::vector<MalformedPack> list = {
        {"surroundingsOfTooFewInstances", Issue::meaning_range, "surroundings 1",
         [](PackModel& p) { p.surroundings.pop_back(); }},
        {"surroundingsOfTooManyInstances", Issue::meaning_range, "surroundings 3",
         [](PackModel& p) { p.surroundings.push_back(formats::kPlainSurroundings); }},
        {"transfersWithoutSurroundings", Issue::meaning_range, "surroundings 0",
         [](PackModel& p) { p.surroundings.clear(); }},
        {"surroundingsTransfer", Issue::meaning_reference, "surroundings 1",
         [](PackModel& p) { p.surroundings[1].transfer = 1; }},
        {"surroundingsVisibility", Issue::meaning_value, "surroundings 0",
         [](PackModel& p) { p.surroundings[0].visibility[3] = 0x7C00; }},
        {"transferInfinite", Issue::meaning_value, "radiance transfer 0",
         [](PackModel& p) { p.radiance_transfers[0].values[107] = 0xFC00; }},
        {"transferNotANumber", Issue::meaning_value, "radiance transfer 0",
         [](PackModel& p) { p.radiance_transfers[0].values[0] = 0x7E01; }},
    };
    return list;
}

} // namespace hearth::test
