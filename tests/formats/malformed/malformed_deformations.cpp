// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

#include <limits>

namespace hearth::test
{

using namespace formats;

const std::vector<MalformedPack>& malformedDeformations()
{
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    static const std::vector<MalformedPack> list{
        {"deformedMeshOfAStaticOne", Issue::meaning_order, "deformed mesh 0",
         [](PackModel& p) { p.deformed_meshes[0].mesh = 0; }},
        {"deformedMeshTwice", Issue::meaning_order, "deformed mesh 1",
         [](PackModel& p) {
             p.deformed_meshes.push_back({2, 0, 0, 0, {1, 0}, {}, {}});
         }},
        {"deformedMeshMissing", Issue::meaning_reference, "mesh 2",
         [](PackModel& p)
         {
             p.deformed_meshes.clear();
             p.deformed_clusters.clear();
             p.cluster_joints.clear();
         }},
        {"deformedMeshWithoutItsSkin", Issue::meaning_reference, "deformed mesh 0",
         [](PackModel& p) { p.deformed_meshes[0].skin = kInvalidIndex; }},
        {"deformedMeshSkin", Issue::meaning_reference, "deformed mesh 0",
         [](PackModel& p) { p.deformed_meshes[0].skin = 1; }},
        {"deformedMeshAnchor", Issue::meaning_reference, "deformed mesh 0",
         [](PackModel& p) { p.deformed_meshes[0].anchor = 2; }},
        {"deformedMeshClusters", Issue::meaning_value, "deformed mesh 0",
         [](PackModel& p) { p.deformed_meshes[0].clusters.count = 2; }},
        {"deformedMeshBox", Issue::meaning_value, "deformed mesh 0",
         [](PackModel& p) { p.deformed_meshes[0].box_min.y = 1; }},
        {"deformedMeshReserved", Issue::meaning_padding, "deformed mesh 0",
         [](PackModel& p) { p.deformed_meshes[0].reserved = 1; }},
        {"deformedClustersOutside", Issue::meaning_range, "deformed mesh 0",
         [](PackModel& p) { p.deformed_clusters.clear(); }},
        {"deformedClustersLeftOver", Issue::meaning_range, "deformed cluster 1",
         [](PackModel& p) { p.deformed_clusters.push_back({}); }},
        {"deformedClusterJoint", Issue::meaning_reference, "deformed cluster 0",
         [](PackModel& p) { p.deformed_clusters[0].joint = 2; }},
        {"deformedClusterBox", Issue::meaning_value, "deformed cluster 0",
         [](PackModel& p) { p.deformed_clusters[0].box_max.z = kNaN; }},
        {"deformedClusterCone", Issue::meaning_value, "deformed cluster 0",
         [](PackModel& p) { p.deformed_clusters[0].cone_back = -1; }},
        {"deformedClusterReserved", Issue::meaning_padding, "deformed cluster 0",
         [](PackModel& p) { p.deformed_clusters[0].reserved = 1; }},
        {"deformedClusterMorphReach", Issue::meaning_value, "deformed cluster 0",
         [](PackModel& p) { p.deformed_clusters[0].morph_reach = -1; }},
        {"deformedClusterMorphReachNaN", Issue::meaning_value, "deformed cluster 0",
         [](PackModel& p) { p.deformed_clusters[0].morph_reach = kNaN; }},
        {"deformedClusterWithoutJoints", Issue::meaning_value, "deformed cluster 0",
         [](PackModel& p)
         {
             p.deformed_clusters[0].joints.count = 0;
             p.cluster_joints.clear();
         }},
        {"deformedClusterMainBoneNotFirst", Issue::meaning_value, "deformed cluster 0",
         [](PackModel& p) {
             p.cluster_joints = {0, 1};
         }},
        {"deformedClusterJoints", Issue::meaning_reference, "deformed cluster 0",
         [](PackModel& p) { p.cluster_joints[1] = 2; }},
        {"deformedClusterMainBoneWithAShare", Issue::meaning_value, "deformed cluster 0",
         [](PackModel& p) { p.cluster_joints[0] |= 1u << 16; }},
        {"deformedClusterSharesWithoutARest", Issue::meaning_value, "deformed cluster 0",
         [](PackModel& p)
         {
             p.deformed_clusters[0].joints.count = 3;
             p.cluster_joints = {1, 0x80000000u, 0x80000000u};
         }},
        {"deformedClusterShareBehindNone", Issue::meaning_order, "deformed cluster 0",
         [](PackModel& p)
         {
             p.deformed_clusters[0].joints.count = 3;
             p.cluster_joints = {1, 0, 0x10000u};
         }},
        {"deformedClusterJointsOutside", Issue::meaning_range, "deformed cluster 0",
         [](PackModel& p) { p.deformed_clusters[0].joints.count = 3; }},
        {"deformedClusterJointsLeftOver", Issue::meaning_range, "joint of a cluster 2",
         [](PackModel& p) { p.cluster_joints.push_back(0); }},
        {"deformedMeshDrawnWithAnotherSkin", Issue::meaning_reference, "node 3",
         [](PackModel& p)
         {
             p.skins.push_back(p.skins[0]);
             p.nodes[3].skin = 1;
         }},
    };
    return list;
}

} // namespace hearth::test
