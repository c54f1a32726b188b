// Traces an image of a pack by paths: materials, lights, emission and sky with all bounces, or with nothing
// that occludes. A reference for the whole picture, beside the renderers that nobody here wrote.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "tests/reference/tracer/shaded_scene.h"

namespace hearth::reference
{

enum class Occlusion
{
    none, ///< surfaces are under the whole sky and all lights, and see no other; occlusion textures count
    full, ///< paths; occlusion textures, which stand for them, do not count
    /// Emission, and light that comes straight from lights, with their shadows: no sky, no other surfaces.
    lights,
};

struct PathTracing
{
    shared::Camera camera{};
    uint32_t width = 640;
    uint32_t height = 360;
    uint32_t samples = 16; ///< paths of each pixel
    /// All paths begin at the centre of their pixel, as the samples of a renderer, not anywhere in it.
    bool through_centers = false;
    uint32_t max_bounces = 12;
    TextureFilter filter = TextureFilter::anisotropic; ///< of surfaces that the camera sees
    Occlusion occlusion = Occlusion::full;
    uint64_t seed = 1;
    /// Radiance that no path exceeds after its first bounce: rarer and brighter samples would be noise that
    /// no number of samples removes.
    double max_indirect = 20;
};

/// Return the radiance of each pixel, rows from top to bottom. Deterministic: same arguments, same result.
std::vector<Double3> tracePaths(const ShadedScene& scene, const PathTracing& tracing);

} // namespace hearth::reference
