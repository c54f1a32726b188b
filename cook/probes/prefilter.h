// Cube whose mips show an environment as surfaces of growing roughness reflect it.
// B. Karis, "Real shading in Unreal Engine 4", 2013, section "Pre-filtered environment map".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/probes/radiance_tree.h"
#include "formats/records/probe.h"

#include <vector>

namespace hearth::probes
{

/// Mip of a cube: faces of side x side texels in the order of environment::Layout::cube.
struct ProbeMip
{
    uint32_t side = 0;
    std::vector<Double3> texels;
};

/// Filter an environment for the roughness of each mip (formats::probeMipRoughness). A texel of mip 0 is
/// the mean over its area. A texel of another mip with direction R is sum L k dw / sum k dw over all of
/// the environment, where k = cos t D(h) of a GGX lobe with N = V = R and the half vector h between R and
/// a direction at angle t. So one radiance stays as it is, and a small bright sun makes no fireflies. The
/// same for any number of threads.
std::vector<ProbeMip> prefilter(const RadianceTree& tree, uint32_t side, uint32_t mip_count);

} // namespace hearth::probes
