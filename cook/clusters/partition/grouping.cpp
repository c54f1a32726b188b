// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/partition/grouping.h"

#include "cook/clusters/core/morton.h"
#include "cook/mesh/free_memory.h"
#include "formats/base/assert.h"
#include "formats/codecs/vertex_codec.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace hearth::clusters
{

namespace
{

// A shared position that was locked on the previous level weighs this many others: the dense lines that
// locking leaves must end up inside a group, or they stay forever.
constexpr float kLockedWeight = 5.0f;

// Positions in more clusters than this (the tip of a fan) only link clusters that are consecutive in its
// list.
constexpr size_t kMaxLinked = 12;

struct Link
{
    ClusterId other;
    float weight;
};

/// Positions of each cluster, each once.
using PositionsByCluster = CsrLists<MeshPositionId>;
/// Clusters that use each position, ascending.
using ClustersByPosition = CsrLists<ClusterId>;

PositionsByCluster gatherClusterPositions(const PreparedMesh& mesh, const ClusterStore& store)
{
    PositionsByCluster lists;
    lists.reserve(store.vertices.size());
    IdVector<MeshPositionId, ClusterId> seen(mesh.position_count, kInvalid);
    for (const ClusterId c : store.shapes.ids())
    {
        for (const VertexId vertex : store.clusterVertices(store.shapes[c]))
        {
            const MeshPositionId position = mesh.position_id_of_vertex[vertex];
            if (seen[position] != c)
                lists.add(position);
            seen[position] = c;
        }
        lists.endList();
    }
    return lists;
}

ClustersByPosition transposeLists(const PositionsByCluster& positions, size_t position_count)
{
    return ClustersByPosition(position_count,
                              [&](const auto& add)
                              {
                                  for (const ClusterId c : makeIds<ClusterId>(positions.size()))
                                      for (const MeshPositionId position : positions[toIndex(c)])
                                          add(toIndex(position), c);
                              });
}

/// Return the neighbours of each cluster with the weight of the shared border.
IdVector<ClusterId, std::vector<Link>> linkClusters(const PositionsByCluster& positions,
                                                    const ClustersByPosition& users,
                                                    IdSpan<MeshPositionId, const uint8_t> locked)
{
    IdVector<ClusterId, std::vector<Link>> links(positions.size());
    IdVector<ClusterId, float> weight(links.size(), 0.0f);
    std::vector<ClusterId> touched;
    for (const ClusterId c : links.ids())
    {
        touched.clear();
        const auto touch = [&](ClusterId other, float added)
        {
            if (weight[other] == 0)
                touched.push_back(other);
            weight[other] += added;
        };
        for (const MeshPositionId position : positions[toIndex(c)])
        {
            const auto clusters = users[toIndex(position)];
            const float added = locked[position] != 0 ? kLockedWeight : 1.0f;
            if (clusters.size() <= kMaxLinked)
            {
                for (const ClusterId other : clusters)
                    if (other != c)
                        touch(other, added);
                continue;
            }
            const auto self = std::lower_bound(clusters.begin(), clusters.end(), c);
            if (self != clusters.begin())
                touch(*(self - 1), added);
            if (self + 1 != clusters.end())
                touch(*(self + 1), added);
        }
        std::sort(touched.begin(), touched.end());
        for (const ClusterId other : touched)
        {
            links[c].push_back({other, weight[other]});
            weight[other] = 0;
        }
    }
    return links;
}

/// Group while groups still merge: named by the cluster that it began as. A group that was merged into
/// another refers to it by `merged_into`.
struct MergingGroup
{
    std::vector<ClusterId> members;
    std::vector<Link> links;
    uint32_t bytes = 0;
    ClusterId merged_into = kInvalid;
};

class Merger
{
public:
    Merger(const PreparedMesh& mesh, const ClusterStore& store, IdVector<ClusterId, std::vector<Link>> links,
           const Config& config)
        : config_(config), groups_(store.shapes.size()), weight_(store.shapes.size(), 0.0f)
    {
        for (const ClusterId c : groups_.ids())
        {
            const ClusterShape& shape = store.shapes[c];
            groups_[c].members = {c};
            HEARTH_ASSERT(shape.triangle_count > 0 && shape.triangle_count <= formats::kMaxClusterTriangles);
            groups_[c].links = std::move(links[c]);
            groups_[c].bytes = formats::clusterBytes(formats::worstCaseLayout(mesh.attributes),
                                                     shape.vertex_count, shape.triangle_count);
            if (const size_t targets = mesh.vertices.morph_targets.size(); targets > 0)
                groups_[c].bytes +=
                    static_cast<uint32_t>(4 * formats::morphSectionWords(targets, shape.vertex_count));
        }
    }

    /// Grow the smallest group repeatedly until all have the target size or no neighbour that fits.
    void mergeNeighbours()
    {
        struct Entry
        {
            uint32_t size;
            ClusterId group;
            bool operator>(const Entry& b) const { return size != b.size ? size > b.size : group > b.group; }
        };
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (const ClusterId g : groups_.ids())
            queue.push({clusterCount(g), g});
        while (!queue.empty())
        {
            const Entry entry = queue.top();
            queue.pop();
            const ClusterId group = entry.group;
            if (groups_[group].merged_into != kInvalid || clusterCount(group) != entry.size ||
                entry.size >= config_.group_target_clusters)
                continue;
            const ClusterId neighbour = bestNeighbour(group);
            if (neighbour == kInvalid)
                continue;
            merge(neighbour, group);
            queue.push({clusterCount(neighbour), neighbour});
        }
    }

    /// Merge small groups that are consecutive in `order`.
    void mergeInOrder(std::span<const ClusterId> order)
    {
        ClusterId open = kInvalid;
        for (const ClusterId group : order)
        {
            if (clusterCount(group) * 2 >= config_.group_target_clusters)
                continue;
            if (open != kInvalid && fits(open, group) && clusterCount(open) < config_.group_target_clusters)
                merge(open, group);
            else
                open = group;
        }
    }

    std::vector<ClusterId> alive() const
    {
        std::vector<ClusterId> groups;
        for (const ClusterId g : groups_.ids())
            if (groups_[g].merged_into == kInvalid)
                groups.push_back(g);
        return groups;
    }

    std::span<const ClusterId> groupMembers(ClusterId group) const { return groups_[group].members; }

private:
    uint32_t clusterCount(ClusterId group) const
    {
        return static_cast<uint32_t>(groups_[group].members.size());
    }

    bool fits(ClusterId a, ClusterId b) const
    {
        return clusterCount(a) + clusterCount(b) <= config_.group_max_clusters &&
               groups_[a].bytes + groups_[b].bytes <= formats::kMaxPageBytes;
    }

    ClusterId findMerged(ClusterId group)
    {
        while (groups_[group].merged_into != kInvalid)
            group = groups_[group].merged_into;
        return group;
    }

    /// Update links: replace merged groups by the groups that contain them, one link for each neighbour.
    void refreshLinks(ClusterId group)
    {
        std::vector<Link>& links = groups_[group].links;
        size_t kept = 0;
        for (const Link& link : links)
        {
            const ClusterId other = findMerged(link.other);
            if (other == group)
                continue;
            if (weight_[other] == 0)
                links[kept++].other = other;
            weight_[other] += link.weight;
        }
        links.resize(kept);
        for (Link& link : links)
        {
            link.weight = weight_[link.other];
            weight_[link.other] = 0;
        }
    }

    ClusterId bestNeighbour(ClusterId group)
    {
        refreshLinks(group);
        ClusterId best = kInvalid;
        float best_score = 0;
        for (const Link& link : groups_[group].links)
        {
            if (!fits(group, link.other))
                continue;
            // a shared border counts more for a small neighbour, which has little border
            const float score = link.weight / std::sqrt(static_cast<float>(clusterCount(link.other)));
            if (score > best_score || (score == best_score && link.other < best))
            {
                best = link.other;
                best_score = score;
            }
        }
        return best;
    }

    void merge(ClusterId into, ClusterId from)
    {
        HEARTH_ASSERT(into != from && fits(into, from));
        MergingGroup& a = groups_[into];
        MergingGroup& b = groups_[from];
        a.members.insert(a.members.end(), b.members.begin(), b.members.end());
        a.links.insert(a.links.end(), b.links.begin(), b.links.end());
        a.bytes += b.bytes;
        mesh::freeMemory(b.members);
        mesh::freeMemory(b.links);
        b.merged_into = into;
    }

    const Config& config_;
    IdVector<ClusterId, MergingGroup> groups_;
    IdVector<ClusterId, float> weight_; ///< scratch of refreshLinks, zero between calls
};

Box3 clusterBox(const PreparedMesh& mesh, const ClusterStore& store, const ClusterShape& shape)
{
    Box3 box;
    for (const VertexId vertex : store.clusterVertices(shape))
        box.add(mesh.positions()[vertex]);
    return box;
}

/// Return the center without overflow for any finite box.
Float3 middle(const Box3& box)
{
    return box.min * 0.5f + box.max * 0.5f;
}

/// Sort groups along the Morton curve by the centers of their boxes.
std::vector<ClusterId> spatialOrder(const Merger& merger, IdSpan<ClusterId, const Box3> cluster_boxes)
{
    struct Key
    {
        uint64_t code;
        ClusterId group;
    };
    Box3 all;
    for (const Box3& box : cluster_boxes)
        all.add(box);
    std::vector<Key> keys;
    for (const ClusterId group : merger.alive())
    {
        Box3 box;
        for (const ClusterId member : merger.groupMembers(group))
            box.add(cluster_boxes[member]);
        keys.push_back({mortonCode(middle(box), all), group});
    }
    std::sort(keys.begin(), keys.end(),
              [](const Key& a, const Key& b)
              { return a.code != b.code ? a.code < b.code : a.group < b.group; });
    std::vector<ClusterId> order;
    for (const Key& key : keys)
        order.push_back(key.group);
    return order;
}

} // namespace

Groups groupClusters(const PreparedMesh& mesh, const ClusterStore& store,
                     IdSpan<MeshPositionId, const uint8_t> locked, const Config& config)
{
    HEARTH_ASSERT(!store.shapes.empty() && locked.size() == mesh.position_count);
    HEARTH_ASSERT(config.group_target_clusters <= config.group_max_clusters);
    HEARTH_ASSERT(allBelow(store.vertices, mesh.position_id_of_vertex.size()));
    const PositionsByCluster positions = gatherClusterPositions(mesh, store);
    const ClustersByPosition users = transposeLists(positions, mesh.position_count);
    Merger merger(mesh, store, linkClusters(positions, users, locked), config);
    merger.mergeNeighbours();

    IdVector<ClusterId, Box3> boxes;
    for (const ClusterShape& shape : store.shapes)
        boxes.push_back(clusterBox(mesh, store, shape));
    merger.mergeInOrder(spatialOrder(merger, boxes));

    Groups groups;
    for (const ClusterId group : spatialOrder(merger, boxes))
    {
        const auto members = merger.groupMembers(group);
        for (const ClusterId member : members)
            groups.members.add(member);
        groups.members.endList();
        std::ranges::sort(groups.members[groups.count() - 1]);
        HEARTH_ASSERT(!members.empty() && members.size() <= config.group_max_clusters);
    }
    HEARTH_ASSERT(groups.members.items().size() == store.shapes.size());
    return groups;
}

IdVector<MeshPositionId, uint8_t> lockSharedPositions(const PreparedMesh& mesh, const ClusterStore& store,
                                                      const Groups& groups,
                                                      IdSpan<MeshPositionId, const uint8_t> pinned)
{
    HEARTH_ASSERT(pinned.size() == mesh.position_count);
    HEARTH_ASSERT(groups.members.items().size() == store.shapes.size());
    IdVector<MeshPositionId, uint8_t> locked(std::vector<uint8_t>(pinned.begin(), pinned.end()));
    IdVector<MeshPositionId, uint32_t> owner(mesh.position_count, kInvalidIndex);
    for (uint32_t g = 0; g < groups.count(); ++g)
        for (const ClusterId member : groups.groupMembers(g))
            for (const VertexId vertex : store.clusterVertices(store.shapes[member]))
            {
                const MeshPositionId position = mesh.position_id_of_vertex[vertex];
                if (owner[position] == kInvalidIndex)
                    owner[position] = g;
                else if (owner[position] != g)
                    locked[position] = 1;
            }
    return locked;
}

} // namespace hearth::clusters
