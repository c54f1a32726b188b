// Reference rasteriser with the rules of the test device (lavapipe), slow and simple: vertices snapped to
// 1/256 pixel, exact integer edges, top-left rule, reversed depth.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "tests/reference/pack_geometry.h"

#include <algorithm>
#include <map>
#include <vector>

namespace hearth::reference
{

inline constexpr uint32_t kNothing = 0xFFFFFFFFu;

/// Bits: reasons that make a different result at a pixel valid, too.
enum Excuse : uint8_t
{
    kExcuseEdge = 1, ///< the sample lies within 1/256 pixel of an edge that matters there
    kExcuseTie = 2,  ///< the depths of the two nearest triangles differ by less than 1e-5, relative
    kExcuseMask = 4, ///< an alpha mask decides: one of `masked_ids` may be the nearest
};

struct RasterImage
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> ids;    ///< nearest triangle, or kNothing; rows top to bottom
    std::vector<float> depths;    ///< z_near / distance; 0 if the pixel is empty
    std::vector<uint8_t> excused; ///< bits of Excuse
    /// Masked triangles that cover the sample and are not behind the nearest, for pixels with kExcuseMask.
    std::map<size_t, std::vector<uint32_t>> masked_ids;

    size_t pixelCount() const { return ids.size(); }
};

/// Draw the triangles in order. Back faces of single-sided materials are not drawn. Triangles of masked or
/// blended materials are not drawn either: they excuse every pixel that they might win.
RasterImage rasterise(std::span<const SceneTriangle> triangles, const SceneTables& scene,
                      const shared::FrameView& frame);

struct RasterComparison
{
    uint64_t pixels = 0;
    uint64_t covered = 0;   ///< covered by the expected image
    uint64_t masked = 0;    ///< pixels that an alpha mask decides; not counted below, except in `impossible`
    uint64_t excused = 0;   ///< beside an edge, or a tie
    uint64_t different = 0; ///< ids differ, excused or not
    uint64_t different_unexcused = 0;
    uint64_t coverage_unexcused = 0; ///< subset of these for which one image is empty
    uint64_t impossible =
        0; ///< masked pixels that show neither what lies behind nor any triangle of the mask
};

/// Compare ids. `same` returns true if an expected and an actual id, neither kNothing, denote the same
/// triangle.
template <typename Same>
RasterComparison compareIds(const RasterImage& expected, std::span<const uint32_t> actual, const Same& same)
{
    RasterComparison comparison;
    comparison.pixels = expected.pixelCount();
    const auto equal = [&](uint32_t a, uint32_t b)
    { return a == kNothing || b == kNothing ? a == b : same(a, b); };
    for (size_t i = 0; i < expected.pixelCount(); ++i)
    {
        const uint32_t a = expected.ids[i], b = actual[i];
        const bool beside = (expected.excused[i] & (kExcuseEdge | kExcuseTie)) != 0;
        comparison.covered += a != kNothing;
        if (expected.excused[i] & kExcuseMask)
        {
            const std::vector<uint32_t>& candidates = expected.masked_ids.at(i);
            const bool possible =
                equal(a, b) || std::any_of(candidates.begin(), candidates.end(),
                                           [&](uint32_t candidate) { return equal(candidate, b); });
            ++comparison.masked;
            comparison.impossible += !possible && !beside;
            continue;
        }
        comparison.excused += beside;
        comparison.different += !equal(a, b);
        comparison.different_unexcused += !equal(a, b) && !beside;
        comparison.coverage_unexcused += !equal(a, b) && !beside && (a == kNothing || b == kNothing);
    }
    return comparison;
}

/// True if two triangles are the same part of the scene: same instance, material and, up to rotation,
/// corners.
bool sameTriangle(const SceneTriangle& a, const SceneTriangle& b);

} // namespace hearth::reference
