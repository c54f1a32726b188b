// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/pages/pages.h"

#include "cook/clusters/pages/coded_cluster.h"
#include "formats/base/assert.h"
#include "formats/codecs/vertex_codec.h"
#include "formats/container/container_reader.h"

#include <algorithm>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace hearth::clusters
{

namespace
{

using namespace formats;

uint32_t encodedBytes(const CodedCluster& cluster)
{
    return static_cast<uint32_t>(
        4 * (cluster.words.size() + (cluster.indices.size() + 3) / 4 + cluster.morphs.size()));
}

/// Writes the clusters of one group after the other. Holds only clusters that are not in a stored page yet: a
/// few pages, for any mesh size.
class PageWriter
{
public:
    PageWriter(const PreparedMesh& mesh, const ClusterStore& store, std::span<const ClusterShape> shapes,
               Hierarchy& hierarchy)
        : mesh_(mesh), store_(store), shapes_(shapes), hierarchy_(hierarchy)
    {
    }

    void write()
    {
        reserveBytes();
        auto& groups = hierarchy_.groups;
        for (auto group = groups.begin(); group != groups.end();)
        {
            const auto first = group;
            uint32_t count = 0;
            for (; group != groups.end() && count < kBatchClusters; ++group)
                count += group->clusters.count;
            codeClusters(count);
            std::for_each(first, group, [&](GroupRecord& placed) { placeGroup(placed); });
            // the last page may have room for the next batch's first group
            storePages(hierarchy_.pages.size() - 1);
        }
        storePages(hierarchy_.pages.size());
    }

private:
    /// Clusters of a batch, enough for many threads: about forty pages.
    static constexpr uint32_t kBatchClusters = 2048;

    const CodedCluster& codedCluster(uint32_t cluster) const
    {
        HEARTH_ASSERT(cluster >= first_coded_ && cluster - first_coded_ < coded_.size());
        return coded_[cluster - first_coded_];
    }

    /// Reserve the decoded size, which bounds the stored size. Untouched memory costs nothing, but a copy
    /// would.
    void reserveBytes()
    {
        size_t bytes = 0;
        for (const ClusterShape& shape : shapes_)
            bytes += clusterBytes(hierarchy_.mesh.attributes, shape.vertex_count, shape.triangle_count);
        hierarchy_.page_bytes.reserve(bytes);
    }

    void codeClusters(uint32_t count)
    {
        const size_t held = coded_.size();
        coded_.resize(held + count);
        tbb::parallel_for(held, coded_.size(),
                          [&](size_t i)
                          {
                              const size_t c = first_coded_ + i;
                              coded_[i] = codeCluster(mesh_, store_, shapes_[c], hierarchy_.mesh.attributes,
                                                      hierarchy_.clusters[c]);
                          });
    }

    /// Assign a group to a page, and each of its clusters to a position in the page.
    void placeGroup(GroupRecord& group)
    {
        const uint32_t end = group.clusters.first + group.clusters.count;
        uint32_t bytes = 0;
        for (uint32_t c = group.clusters.first; c < end; ++c)
            bytes += encodedBytes(codedCluster(c));
        HEARTH_ASSERT(bytes <= kMaxPageBytes);
        if (hierarchy_.pages.empty() || hierarchy_.pages.back().size + bytes > kMaxPageBytes)
        {
            PageRecord page{};
            page.clusters.first = group.clusters.first;
            hierarchy_.pages.push_back(page);
        }
        group.page = static_cast<uint32_t>(hierarchy_.pages.size() - 1);
        PageRecord& page = hierarchy_.pages.back();
        page.clusters.count += group.clusters.count;
        for (uint32_t c = group.clusters.first; c < end; ++c)
        {
            hierarchy_.clusters[c].page = group.page;
            hierarchy_.clusters[c].page_word = static_cast<uint16_t>(page.size / 4);
            page.size += encodedBytes(codedCluster(c));
        }
    }

    /// Encode and append the pages before `end` that are not stored yet, and release their clusters.
    void storePages(size_t end)
    {
        std::vector<std::vector<std::byte>> stored(end - stored_pages_);
        tbb::parallel_for(size_t{0}, stored.size(),
                          [&](size_t i) { stored[i] = storedPage(hierarchy_.pages[stored_pages_ + i]); });
        for (const std::vector<std::byte>& bytes : stored)
        {
            PageRecord& page = hierarchy_.pages[stored_pages_++];
            page.offset = hierarchy_.page_bytes.size();
            hierarchy_.page_bytes.insert(hierarchy_.page_bytes.end(), bytes.begin(), bytes.end());
            hierarchy_.page_bytes.resize(alignChunk(hierarchy_.page_bytes.size()));
        }
        const size_t next =
            end < hierarchy_.pages.size() ? hierarchy_.pages[end].clusters.first : hierarchy_.clusters.size();
        coded_.erase(coded_.begin(), coded_.begin() + static_cast<ptrdiff_t>(next - first_coded_));
        first_coded_ = next;
    }

    std::vector<std::byte> storedPage(PageRecord& page)
    {
        const auto [first, count] = page.clusters;
        auto bytes = encoders_.local().encode(std::span(hierarchy_.clusters).subspan(first, count),
                                              hierarchy_.mesh.attributes,
                                              std::span(coded_).subspan(first - first_coded_, count));
        page.codec = static_cast<uint32_t>(PageCodec::clusters);
        HEARTH_ASSERT(!bytes.empty() && page.size <= kMaxPageBytes);
        page.stored_size = static_cast<uint32_t>(bytes.size());
        page.hash = hashBytes(bytes);
        return bytes;
    }

    const PreparedMesh& mesh_;
    const ClusterStore& store_;
    std::span<const ClusterShape> shapes_;
    Hierarchy& hierarchy_;
    std::vector<CodedCluster> coded_; ///< clusters from first_coded_ on
    size_t first_coded_ = 0;
    size_t stored_pages_ = 0;
    tbb::enumerable_thread_specific<pages::PageEncoder> encoders_;
};

/// Link each page to its parents, which must be resident before it: the pages of the clusters that were made
/// from its groups.
void linkPages(Hierarchy& hierarchy)
{
    std::vector<std::vector<uint32_t>> parents(hierarchy.pages.size());
    for (const ClusterRecord& cluster : hierarchy.clusters)
    {
        if (cluster.refined_group == kInvalidIndex)
            continue;
        const uint32_t finer = hierarchy.groups[cluster.refined_group].page;
        // clusters are in page order: each list comes out ascending
        if (finer != cluster.page && (parents[finer].empty() || parents[finer].back() != cluster.page))
            parents[finer].push_back(cluster.page);
    }
    for (size_t i = 0; i < parents.size(); ++i)
    {
        hierarchy.pages[i].parents = {static_cast<uint32_t>(hierarchy.page_parents.size()),
                                      static_cast<uint32_t>(parents[i].size())};
        hierarchy.page_parents.insert(hierarchy.page_parents.end(), parents[i].begin(), parents[i].end());
    }
}

} // namespace

void buildPages(const PreparedMesh& mesh, const ClusterStore& store, std::span<const ClusterShape> shapes,
                const Config& config, Hierarchy& hierarchy)
{
    HEARTH_ASSERT(shapes.size() == hierarchy.clusters.size() && hierarchy.pages.empty());
    hierarchy.mesh.attributes = chooseLayout(mesh, config);
    hierarchy.mesh.grid_step = static_cast<float>(mesh.grid.step);
    PageWriter(mesh, store, shapes, hierarchy).write();
    HEARTH_ASSERT(!hierarchy.pages.empty());
    linkPages(hierarchy);
}

} // namespace hearth::clusters
