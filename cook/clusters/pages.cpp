// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/pages.h"

#include "cook/clusters/page_encode.h"
#include "formats/assert.h"
#include "formats/container_reader.h"

#include <algorithm>
#include <cstring>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace hearth::clusters
{

namespace
{

using namespace formats;

uint32_t bytesOf(const CodedCluster& cluster)
{
    return static_cast<uint32_t>(4 * (cluster.words.size() + (cluster.indices.size() + 3) / 4));
}

/// Give each group its page, and each cluster its place in the page.
void assignPages(std::span<const CodedCluster> coded, Hierarchy& hierarchy)
{
    uint32_t used = kPageMaxBytes;
    for (GroupRecord& group : hierarchy.groups)
    {
        uint32_t bytes = 0;
        for (uint32_t c = 0; c < group.clusters.count; ++c)
            bytes += bytesOf(coded[group.clusters.first + c]);
        HEARTH_ASSERT(bytes <= kPageMaxBytes);
        if (used + bytes > kPageMaxBytes)
        {
            PageRecord page{};
            page.clusters.first = group.clusters.first;
            hierarchy.pages.push_back(page);
            used = 0;
        }
        group.page = static_cast<uint32_t>(hierarchy.pages.size() - 1);
        PageRecord& page = hierarchy.pages.back();
        page.clusters.count += group.clusters.count;
        for (uint32_t c = group.clusters.first; c < group.clusters.first + group.clusters.count; ++c)
        {
            hierarchy.clusters[c].page = group.page;
            hierarchy.clusters[c].page_word = static_cast<uint16_t>(used / 4);
            used += bytesOf(coded[c]);
        }
        page.size = used;
    }
}

/// The pages that must be there before each page: those of the clusters that were made from its groups.
void linkPages(Hierarchy& hierarchy)
{
    std::vector<std::vector<uint32_t>> parents(hierarchy.pages.size());
    for (const ClusterRecord& cluster : hierarchy.clusters)
    {
        if (cluster.refined_group == kNone)
            continue;
        const uint32_t finer = hierarchy.groups[cluster.refined_group].page;
        // clusters stand in page order: each list comes out ascending
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
    hierarchy.mesh.attributes = chooseLayout(mesh, config);
    hierarchy.mesh.grid_step = static_cast<float>(mesh.grid.step);
    std::vector<CodedCluster> coded(hierarchy.clusters.size());
    tbb::parallel_for(size_t{0}, coded.size(),
                      [&](size_t c) {
                          coded[c] = codeCluster(mesh, store, shapes[c], hierarchy.mesh.attributes,
                                                 hierarchy.clusters[c]);
                      });
    assignPages(coded, hierarchy);
    std::vector<std::vector<std::byte>> stored(hierarchy.pages.size());
    tbb::enumerable_thread_specific<PageEncoder> encoders;
    tbb::parallel_for(size_t{0}, stored.size(),
                      [&](size_t i)
                      {
                          PageRecord& page = hierarchy.pages[i];
                          const auto [first, count] = page.clusters;
                          stored[i] = encoders.local().encode(
                              std::span(hierarchy.clusters).subspan(first, count), hierarchy.mesh.attributes,
                              std::span(coded).subspan(first, count));
                          page.codec = static_cast<uint32_t>(PageCodec::clusters);
                          page.stored_size = static_cast<uint32_t>(stored[i].size());
                          page.hash = hashBytes(stored[i]);
                      });
    uint64_t end = 0;
    for (size_t i = 0; i < stored.size(); ++i)
    {
        hierarchy.pages[i].offset = (end + kChunkAlignment - 1) / kChunkAlignment * kChunkAlignment;
        end = hierarchy.pages[i].offset + stored[i].size();
    }
    hierarchy.page_bytes.resize((end + kChunkAlignment - 1) / kChunkAlignment * kChunkAlignment);
    for (size_t i = 0; i < stored.size(); ++i)
        std::memcpy(hierarchy.page_bytes.data() + hierarchy.pages[i].offset, stored[i].data(),
                    stored[i].size());
    linkPages(hierarchy);
}

} // namespace hearth::clusters
