// Instances of a mesh, and samples of its surface at which their surroundings are measured.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/moments.h"
#include "cook/visibility/rays/sample_points.h"

#include <span>
#include <vector>

namespace hearth::visibility
{

/// Instance of a mesh.
struct MeshInstance
{
    uint32_t number; ///< in chunk INST
    Affine3 world_from_mesh;
};

/// Surface of a mesh with the visibility of its samples.
struct SampledSurface
{
    std::span<const Float3> positions;
    std::span<const uint32_t> corners;
    std::span<const SurfaceSample> samples;
    std::span<const Moments> moments;  ///< of each sample, in the space of the mesh
    std::span<const uint8_t> interior; ///< of each sample; interior ones do not count
};

/// Sort instances into groups of neighbours, alike in number: in halves across the longest side of their box.
/// group_count  from 1 to the number of instances
std::vector<std::span<const MeshInstance>> groupNeighbours(std::span<MeshInstance> instances,
                                                           size_t group_count);

/// Sample that stands for others.
struct ChosenSample
{
    uint32_t sample;
    float weight; ///< area that it stands for
};

/// Choose samples at even steps of a rate times their area, in their order.
/// rates    of each sample, not negative
/// returns  `count`, or none where all rates are 0; some may be the same
std::vector<ChosenSample> chooseSamples(const SampledSurface& surface, std::span<const double> rates,
                                        uint32_t count);

/// Transform chosen samples.
std::vector<SamplePoint> placeSamples(const SampledSurface& surface, std::span<const ChosenSample> chosen,
                                      const Affine3& world_from_mesh);

} // namespace hearth::visibility
