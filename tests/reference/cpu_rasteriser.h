// A rasteriser that does what the test device does, slowly: vertices snapped to 1/256 pixel, exact integer edges,
// top-left rule, reversed depth. RUNTIME section 0 (design notes) has the measurements.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/shared/frame.h"
#include "tests/reference/pack_geometry.h"

#include <vector>

namespace hearth::reference
{

inline constexpr uint32_t kNothing = 0xFFFFFFFFu;

struct RasterImage
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> ids; ///< of the nearest triangle, or kNothing; rows top to bottom
    std::vector<float> depths; ///< z_near / distance; 0 where nothing is
    /// 1 where another result is right as well: the sample lies within 1/256 pixel of an edge that matters there, or
    /// the two nearest triangles are closer together than 1e-5 of their depth, or an alpha mask decides.
    std::vector<uint8_t> excused;

    size_t pixelCount() const { return ids.size(); }
};

/// Draw the triangles in order. Back faces of single-sided materials are not drawn; triangles of masked or blended
/// materials are not drawn either, and excuse every pixel that they would win.
RasterImage rasterise(std::span<const SceneTriangle> triangles, const SceneTables& scene,
                      const shared::FrameView& frame);

struct RasterComparison
{
    uint64_t pixels = 0;
    uint64_t covered = 0; ///< by the expected image
    uint64_t excused = 0;
    uint64_t different = 0; ///< all pixels whose ids differ
    uint64_t different_unexcused = 0;
    uint64_t coverage_unexcused = 0; ///< of these, one image has nothing there
};

/// Compare ids; `same` says whether an expected and an actual id, both not kNothing, mean the same triangle.
template <typename Same>
RasterComparison compareIds(const RasterImage& expected, std::span<const uint32_t> actual, const Same& same)
{
    RasterComparison comparison;
    comparison.pixels = expected.pixelCount();
    for (size_t i = 0; i < expected.pixelCount(); ++i)
    {
        const uint32_t a = expected.ids[i], b = actual[i];
        const bool equal = a == kNothing || b == kNothing ? a == b : same(a, b);
        comparison.covered += a != kNothing;
        comparison.excused += expected.excused[i];
        comparison.different += !equal;
        comparison.different_unexcused += !equal && !expected.excused[i];
        comparison.coverage_unexcused += !equal && !expected.excused[i] && (a == kNothing || b == kNothing);
    }
    return comparison;
}

/// Whether two triangles are the same piece of the scene: instance, material and, up to rotation, corners.
bool sameTriangle(const SceneTriangle& a, const SceneTriangle& b);

} // namespace hearth::reference
