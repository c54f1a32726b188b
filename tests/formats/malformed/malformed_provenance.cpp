// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

#include <limits>
#include <utility>

namespace hearth::test
{

using namespace formats;

const std::vector<MalformedPack>& malformedProvenance()
{
    static const std::vector<MalformedPack> list = {
        {"assetNameOutside", Issue::meaning_range, "asset 0",
         [](PackModel& p) { p.assets[0].name.offset = 0xFFFFFFF0u; }},
        {"assetNameCutsCharacter", Issue::meaning_text, "asset 0",
         [](PackModel& p) { --p.assets[0].name.length; }},
        {"assetInstancesOutside", Issue::meaning_range, "asset 0",
         [](PackModel& p) { ++p.assets[0].instances.count; }},
        {"assetMeshesOutside", Issue::meaning_range, "asset 0",
         [](PackModel& p) { p.assets[0].meshes.count = 0xFFFFFFFFu; }},
        {"assetNodesOutside", Issue::meaning_range, "asset 0",
         [](PackModel& p) { ++p.assets[0].nodes.count; }},
        {"assetsShareInstances", Issue::meaning_order, "asset 1",
         [](PackModel& p) { p.assets.push_back(p.assets[0]); }},
        {"assetNodesBegin", Issue::meaning_order, "asset 0",
         [](PackModel& p) {
             p.assets[0].nodes = {1, 3};
         }},
        {"instanceOfNoAsset", Issue::meaning_range, "instance 1",
         [](PackModel& p) { --p.assets[0].instances.count; }},
        {"meshOfNoAsset", Issue::meaning_reference, "asset 0",
         [](PackModel& p) { --p.assets[0].meshes.count; }},
        {"instanceOfAnotherAsset", Issue::meaning_reference, "asset 0",
         [](PackModel& p)
         {
             AssetRecord second = p.assets[0];
             p.assets[0].nodes.count = 1;
             second.instances = {2, 0};
             second.meshes = {3, 0};
             second.nodes = {1, 3};
             p.assets.push_back(second);
         }},
        {"nodeOfNoAsset", Issue::meaning_range, "node 4",
         [](PackModel& p) { p.nodes.push_back(p.nodes[0]); }},
        {"assetBoxNaN", Issue::meaning_value, "asset 0",
         [](PackModel& p) { p.assets[0].box_min.y = std::numeric_limits<float>::quiet_NaN(); }},
        {"assetBoxInfinite", Issue::meaning_value, "asset 0",
         [](PackModel& p) { p.assets[0].box_max.z = std::numeric_limits<float>::infinity(); }},
        {"assetBoxTurned", Issue::meaning_value, "asset 0",
         [](PackModel& p) { p.assets[0].box_min.x = 1000; }},
        {"assetBoxTooSmall", Issue::meaning_bounds, "asset 0",
         [](PackModel& p) { p.assets[0].box_max.x = 3.99f; }},
        {"assetBoxOfNothing", Issue::meaning_bounds, "asset 0",
         [](PackModel& p) {
             p.assets[0].box_min = p.assets[0].box_max = {0, 0, 0};
         }},
        {"authoredLevelOfNoMesh", Issue::meaning_reference, "authored level 0",
         [](PackModel& p) { p.authored_levels[0].mesh = 3; }},
        {"authoredLevelIsTheSource", Issue::meaning_reference, "authored level 0",
         [](PackModel& p) { p.authored_levels[0].level = 0; }},
        {"authoredLevelIsNotThere", Issue::meaning_reference, "authored level 0",
         [](PackModel& p) { p.authored_levels[0].level = 2; }},
        {"authoredLevelOfAMeshWithoutLevels", Issue::meaning_reference, "authored level 0",
         [](PackModel& p) { p.authored_levels[0].mesh = 1; }},
        {"authoredLevelTwice", Issue::meaning_order, "authored level 1",
         [](PackModel& p) { p.authored_levels.push_back(p.authored_levels[0]); }},
        {"authoredLevelName", Issue::meaning_range, "authored level 0",
         [](PackModel& p) {
             p.authored_levels[0].name = {static_cast<uint32_t>(p.strings.size()), 1};
         }},
        {"extrasOfAnUnknownKind", Issue::meaning_value, "extras 9",
         [](PackModel& p) { p.extras[9].owner = 10; }},
        {"extrasOfNoNode", Issue::meaning_reference, "extras 0", [](PackModel& p) { p.extras[0].index = 4; }},
        {"extrasOfNoAsset", Issue::meaning_reference, "extras 8",
         [](PackModel& p) { p.extras[8].index = 1; }},
        {"extrasEmpty", Issue::meaning_value, "extras 2", [](PackModel& p) { p.extras[2].json.length = 0; }},
        {"extrasTooLong", Issue::meaning_value, "extras 1",
         [](PackModel& p)
         {
             p.extras[1].json = {static_cast<uint32_t>(p.strings.size()), kMaxExtrasBytes + 1};
             p.strings.append(kMaxExtrasBytes + 1, ' ');
         }},
        {"extrasTwice", Issue::meaning_order, "extras 1",
         [](PackModel& p) { p.extras.insert(p.extras.begin(), p.extras[0]); }},
        {"extrasNotSorted", Issue::meaning_order, "extras 5",
         [](PackModel& p) { std::swap(p.extras[4], p.extras[5]); }},
        {"extrasOutside", Issue::meaning_range, "extras 3",
         [](PackModel& p) { p.extras[3].json.offset = 0xFFFFFFF0u; }},
        {"extrasCutACharacter", Issue::meaning_text, "extras 7",
         [](PackModel& p) { p.extras[7].json.length -= 3; }},
    };
    return list;
}

} // namespace hearth::test
