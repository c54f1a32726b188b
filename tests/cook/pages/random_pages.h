// Pages of random clusters for tests of the page codec: any triangles, any words.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/pages/page_encode.h"

#include <random>
#include <vector>

namespace hearth::test
{

struct RandomPage
{
    uint32_t layout = 0;        ///< vertex layout of the mesh
    uint32_t morph_targets = 0; ///< maximum number of morph targets of a cluster
    std::vector<formats::ClusterRecord> records;
    std::vector<pages::CodedCluster> clusters;

    /// Decoded bytes of the page.
    std::vector<std::byte> content() const;
};

/// Smallest and largest layouts, and some between.
std::vector<uint32_t> sampleLayouts();

/// Cluster whose triangles form a grid, as triangles of surfaces do.
void addGridCluster(RandomPage& page, uint32_t side, bool wide, std::mt19937& random);

/// Cluster of random triangles; may have unused vertices and triangles with equal corners.
void addWildCluster(RandomPage& page, uint32_t vertex_count, uint32_t triangle_count, std::mt19937& random);

/// Page of clusters of both kinds, about half full.
RandomPage randomPage(uint32_t layout, uint32_t seed);

} // namespace hearth::test
