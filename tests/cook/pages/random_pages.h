// Pages of random clusters: any triangles, any words, for tests of the page codec.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/pages/page_encode.h"

#include <random>
#include <vector>

namespace hearth::test
{

struct RandomPage
{
    uint32_t layout = 0;        ///< of the mesh
    uint32_t morph_targets = 0; ///< each cluster has up to so many of them
    std::vector<formats::ClusterRecord> records;
    std::vector<pages::CodedCluster> clusters;

    /// What the page is when it is decoded.
    std::vector<std::byte> content() const;
};

/// The smallest and the largest layouts, and some between.
std::vector<uint32_t> sampleLayouts();

/// A cluster whose triangles form a grid, as those of surfaces do.
void addGridCluster(RandomPage& page, uint32_t side, bool wide, std::mt19937& random);

/// A cluster of any triangles; with more vertices than triangles use, or corners that are equal.
void addWildCluster(RandomPage& page, uint32_t vertex_count, uint32_t triangle_count, std::mt19937& random);

/// Clusters of both kinds until the page is about half full.
RandomPage randomPage(uint32_t layout, uint32_t seed);

} // namespace hearth::test
