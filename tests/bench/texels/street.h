// A street of walls, ground and crates whose textures are far larger than a budget, and the finest mip that
// each pixel of a picture wants of them: from rays and UVs alone, without the renderer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "sample_assets/shapes/document.h"
#include "tests/reference/double3.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::bench
{

/// Rectangle with a texture, seen from both sides.
struct Panel
{
    reference::Double3 corner;
    reference::Double3 across, up; ///< edges, perpendicular: u grows along the first, v along the second
    double u = 1, v = 1;           ///< UVs at the ends of the edges
    uint32_t texture = 0;
};

/// Street along -z, from 0 to -160 m, 20 m wide between the houses.
struct Street
{
    uint32_t textures = 0;
    std::vector<std::vector<Panel>> objects; ///< a mesh each
};

Street makeStreet();

/// Return the name of a texture's image.
std::string textureName(uint32_t texture);

/// Return the street as a source: unlit, each texture square with detail in every mip.
/// side  texels
samples::Document makeDocument(const Street& street, uint32_t side);

/// Texture that a pixel shows.
struct WantedMip
{
    static constexpr uint32_t kNothing = ~0u;

    uint32_t texture = kNothing; ///< kNothing: the pixel shows the sky
    double mip = 0;              ///< that a sampler takes by Vulkan's rules, 0 or more
};

/// Return what the pixels of a picture want, row after row.
/// max_anisotropy  of the sampler, 1 or more
std::vector<WantedMip> findWantedMips(const Street& street, uint32_t side, const shared::Camera& camera,
                                      uint32_t width, uint32_t height, double max_anisotropy);

} // namespace hearth::bench
