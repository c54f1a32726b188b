// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/partition/grouping.h"

#include "cook/clusters/core/morton.h"
#include "cook/mesh/free_memory.h"
#include "formats/base/assert.h"
#include "formats/codecs/vertex_codec.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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
    uint32_t other;
    float weight;
};

/// Items by key, as offsets and items (compressed sparse rows).
struct IndexTable
{
    std::vector<uint32_t> items;
    std::vector<uint32_t> offsets;

    std::span<const uint32_t> list(size_t key) const
    {
        return std::span(items).subspan(offsets[key], offsets[key + 1] - offsets[key]);
    }
};

/// Return the positions of each cluster, each once.
IndexTable gatherClusterPositions(const PreparedMesh& mesh, const ClusterStore& store)
{
    IndexTable lists;
    lists.offsets.push_back(0);
    lists.items.reserve(store.vertices.size());
    std::vector<uint32_t> seen(mesh.position_count, kInvalidIndex);
    for (uint32_t c = 0; c < store.shapes.size(); ++c)
    {
        for (const uint32_t vertex : store.clusterVertices(store.shapes[c]))
        {
            const uint32_t position = mesh.position_id_of_vertex[vertex];
            if (seen[position] != c)
                lists.items.push_back(position);
            seen[position] = c;
        }
        lists.offsets.push_back(static_cast<uint32_t>(lists.items.size()));
    }
    return lists;
}

/// Return the clusters that use each position, ascending (the transpose).
IndexTable transposeLists(const IndexTable& positions, size_t position_count)
{
    IndexTable lists;
    lists.offsets.assign(position_count + 1, 0);
    for (const uint32_t position : positions.items)
        ++lists.offsets[position + 1];
    std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
    lists.items.resize(positions.items.size());
    std::vector<uint32_t> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for (uint32_t c = 0; c + 1 < positions.offsets.size(); ++c)
        for (const uint32_t position : positions.list(c))
            lists.items[next[position]++] = c;
    return lists;
}

/// Return the neighbours of each cluster with the weight of the shared border.
std::vector<std::vector<Link>> linkClusters(const IndexTable& positions, const IndexTable& users,
                                            std::span<const uint8_t> locked)
{
    const size_t cluster_count = positions.offsets.size() - 1;
    std::vector<std::vector<Link>> links(cluster_count);
    std::vector<float> weight(cluster_count, 0.0f);
    std::vector<uint32_t> touched;
    for (uint32_t c = 0; c < cluster_count; ++c)
    {
        touched.clear();
        const auto touch = [&](uint32_t other, float added)
        {
            if (weight[other] == 0)
                touched.push_back(other);
            weight[other] += added;
        };
        for (const uint32_t position : positions.list(c))
        {
            const auto clusters = users.list(position);
            const float added = locked[position] != 0 ? kLockedWeight : 1.0f;
            if (clusters.size() <= kMaxLinked)
            {
                for (const uint32_t other : clusters)
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
        for (const uint32_t other : touched)
        {
            links[c].push_back({other, weight[other]});
            weight[other] = 0;
        }
    }
    return links;
}

/// Group while groups still merge. A group that was merged into another refers to it by `merged_into`.
struct MergingGroup
{
    std::vector<uint32_t> members;
    std::vector<Link> links;
    uint32_t bytes = 0;
    uint32_t merged_into = kInvalidIndex;
};

class Merger
{
public:
    Merger(const PreparedMesh& mesh, const ClusterStore& store, std::vector<std::vector<Link>> links,
           const Config& config)
        : config_(config), groups_(store.shapes.size()), weight_(store.shapes.size(), 0.0f)
    {
        for (uint32_t c = 0; c < groups_.size(); ++c)
        {
            const ClusterShape& shape = store.shapes[c];
            groups_[c].members = {c};
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
            uint32_t group;
            bool operator>(const Entry& b) const { return size != b.size ? size > b.size : group > b.group; }
        };
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (uint32_t g = 0; g < groups_.size(); ++g)
            queue.push({clusterCount(g), g});
        while (!queue.empty())
        {
            const Entry entry = queue.top();
            queue.pop();
            const uint32_t group = entry.group;
            if (groups_[group].merged_into != kInvalidIndex || clusterCount(group) != entry.size ||
                entry.size >= config_.group_target_clusters)
                continue;
            const uint32_t neighbour = bestNeighbour(group);
            if (neighbour == kInvalidIndex)
                continue;
            merge(neighbour, group);
            queue.push({clusterCount(neighbour), neighbour});
        }
    }

    /// Merge small groups that are consecutive in `order`.
    void mergeInOrder(std::span<const uint32_t> order)
    {
        uint32_t open = kInvalidIndex;
        for (const uint32_t group : order)
        {
            if (clusterCount(group) * 2 >= config_.group_target_clusters)
                continue;
            if (open != kInvalidIndex && fits(open, group) &&
                clusterCount(open) < config_.group_target_clusters)
                merge(open, group);
            else
                open = group;
        }
    }

    std::vector<uint32_t> alive() const
    {
        std::vector<uint32_t> groups;
        for (uint32_t g = 0; g < groups_.size(); ++g)
            if (groups_[g].merged_into == kInvalidIndex)
                groups.push_back(g);
        return groups;
    }

    std::span<const uint32_t> groupMembers(uint32_t group) const { return groups_[group].members; }

private:
    uint32_t clusterCount(uint32_t group) const
    {
        return static_cast<uint32_t>(groups_[group].members.size());
    }

    bool fits(uint32_t a, uint32_t b) const
    {
        return clusterCount(a) + clusterCount(b) <= config_.group_max_clusters &&
               groups_[a].bytes + groups_[b].bytes <= formats::kMaxPageBytes;
    }

    uint32_t findMerged(uint32_t group)
    {
        while (groups_[group].merged_into != kInvalidIndex)
            group = groups_[group].merged_into;
        return group;
    }

    /// Update links: replace merged groups by the groups that contain them, one link for each neighbour.
    void refreshLinks(uint32_t group)
    {
        std::vector<Link>& links = groups_[group].links;
        size_t kept = 0;
        for (const Link& link : links)
        {
            const uint32_t other = findMerged(link.other);
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

    uint32_t bestNeighbour(uint32_t group)
    {
        refreshLinks(group);
        uint32_t best = kInvalidIndex;
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

    void merge(uint32_t into, uint32_t from)
    {
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
    std::vector<MergingGroup> groups_;
    std::vector<float> weight_; ///< scratch of refreshLinks, zero between calls
};

Box3 clusterBox(const PreparedMesh& mesh, const ClusterStore& store, const ClusterShape& shape)
{
    Box3 box;
    for (const uint32_t vertex : store.clusterVertices(shape))
        box.add(mesh.vertices.positions[vertex]);
    return box;
}

/// Return the center without overflow for any finite box.
Float3 middle(const Box3& box)
{
    return box.min * 0.5f + box.max * 0.5f;
}

/// Sort groups along the Morton curve by the centers of their boxes.
std::vector<uint32_t> spatialOrder(const Merger& merger, std::span<const Box3> cluster_boxes)
{
    struct Key
    {
        uint64_t code;
        uint32_t group;
    };
    Box3 all;
    for (const Box3& box : cluster_boxes)
        all.add(box);
    std::vector<Key> keys;
    for (const uint32_t group : merger.alive())
    {
        Box3 box;
        for (const uint32_t member : merger.groupMembers(group))
            box.add(cluster_boxes[member]);
        keys.push_back({mortonCode(middle(box), all), group});
    }
    std::sort(keys.begin(), keys.end(),
              [](const Key& a, const Key& b)
              { return a.code != b.code ? a.code < b.code : a.group < b.group; });
    std::vector<uint32_t> order;
    for (const Key& key : keys)
        order.push_back(key.group);
    return order;
}

} // namespace

Groups groupClusters(const PreparedMesh& mesh, const ClusterStore& store, std::span<const uint8_t> locked,
                     const Config& config)
{
    HEARTH_ASSERT(!store.shapes.empty());
    const IndexTable positions = gatherClusterPositions(mesh, store);
    const IndexTable users = transposeLists(positions, mesh.position_count);
    Merger merger(mesh, store, linkClusters(positions, users, locked), config);
    merger.mergeNeighbours();

    std::vector<Box3> boxes;
    for (const ClusterShape& shape : store.shapes)
        boxes.push_back(clusterBox(mesh, store, shape));
    merger.mergeInOrder(spatialOrder(merger, boxes));

    Groups groups;
    for (const uint32_t group : spatialOrder(merger, boxes))
    {
        const auto members = merger.groupMembers(group);
        groups.members.insert(groups.members.end(), members.begin(), members.end());
        std::sort(groups.members.begin() + groups.offsets.back(), groups.members.end());
        groups.offsets.push_back(static_cast<uint32_t>(groups.members.size()));
    }
    return groups;
}

std::vector<uint8_t> lockSharedPositions(const PreparedMesh& mesh, const ClusterStore& store,
                                         const Groups& groups, std::span<const uint8_t> pinned)
{
    std::vector<uint8_t> locked(pinned.begin(), pinned.end());
    std::vector<uint32_t> owner(mesh.position_count, kInvalidIndex);
    for (uint32_t g = 0; g < groups.count(); ++g)
        for (const uint32_t member : groups.groupMembers(g))
            for (const uint32_t vertex : store.clusterVertices(store.shapes[member]))
            {
                const uint32_t position = mesh.position_id_of_vertex[vertex];
                if (owner[position] == kInvalidIndex)
                    owner[position] = g;
                else if (owner[position] != g)
                    locked[position] = 1;
            }
    return locked;
}

} // namespace hearth::clusters
