// Measures how much visibility varies over the surfaces of meshes, so that rays go where samples must not be
// far apart. See cook/visibility/README.md, "The budget".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/program/baked_source.h"
#include "cook/visibility/rays/rays.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Return for each mesh the mean square difference of ambient occlusion between points that are an edge of a
/// level's triangles apart, without the noise of rays: what the level cannot hold. None for meshes that are
/// not baked, that move, or whose finest level is planned: more rays add no vertices. The same for any number
/// of threads.
/// source  gives the points, on the levels of its plan
/// world   its occluders, finished
/// plan    levels whose edges count, of each mesh
/// errors: those of MeshPages::read
Result<std::vector<std::optional<double>>> measureVariation(const BakedSource& source, const Occluders& world,
                                                            std::span<const MeshSampling> plan,
                                                            RaySettings rays,
                                                            const FitMeshSettings& fit_mesh);

/// Return the weights of meshes for planSampling by their variation, about 1 on average, and 1 for those
/// without.
/// variation  of measureVariation
std::vector<double> makeWeights(std::span<const std::optional<double>> variation);

} // namespace hearth::visibility
