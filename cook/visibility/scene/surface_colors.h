// Finds the colours that surfaces reflect, one for each triangle.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/scene/level_meshes.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace hearth::visibility
{

/// Small copy of an image's colours, linear.
struct ColorThumbnail
{
    static constexpr uint32_t kSide = 32;
    std::array<Float3, size_t{kSide} * kSide> texels{};
    Float3 mean;
};

/// Share of light that a scene's materials reflect, diffuse and specular together: all reflections count as
/// diffuse light. Metalness and roughness are the means of their textures.
class SurfaceColors
{
public:
    /// scene  the import part: materials and images; must outlive this
    explicit SurfaceColors(const formats::PackView& scene)
        : scene_(&scene), thumbnails_(scene.images().size())
    {
    }

    /// Return the colour of each triangle of a level: of the texture at its middle, or the texture's mean
    /// where the triangle covers much of it, times factor and vertex colours. Coded by encodeSurfaceColor.
    /// errors: those of PackView::imageData; meaning_reference for a missing image
    Result<std::vector<uint32_t>> find(const MeshPages& pages, const LevelArrays& level);

private:
    Result<const ColorThumbnail*> findThumbnail(uint32_t material, uint32_t image);

    const formats::PackView* scene_;
    std::vector<std::unique_ptr<const ColorThumbnail>> thumbnails_;
};

} // namespace hearth::visibility
