// Culling oracle in double precision, written from the design alone: shares no code with the decisions that
// it checks. If rounding or a documented margin may decide, both answers are right.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "tests/reference/double3.h"
#include "tests/reference/pack_geometry.h"

namespace hearth::reference
{

struct OracleView
{
    shared::Camera camera;
    uint32_t width = 0;
    uint32_t height = 0;
    float error_pixels = 1;
    uint32_t flags = shared::kCullEverything;
};

enum class Answer : uint8_t
{
    no,
    yes,
    either, ///< so near to the limit that rounding or a margin may decide
};

/// Reason for which a cluster is or is not drawn.
struct Judgement
{
    Answer in_cut = Answer::either;
    Answer outside_frustum = Answer::either;
    Answer faces_away = Answer::either;

    Answer drawn() const;
};

Judgement judgeCluster(const formats::PackView& view, const OracleView& oracle, DrawnCluster which);

struct CullingComparison
{
    uint64_t pairs = 0;  ///< (instance, cluster) pairs that were tested
    uint64_t drawn = 0;  ///< drawn by the code under test
    uint64_t either = 0; ///< pairs for which both answers are right
    uint64_t wrongly_drawn = 0;
    uint64_t wrongly_culled = 0;
    uint64_t outside_frustum = 0; ///< in the cut, but frustum-culled
    uint64_t facing_away = 0;
};

/// Judge a whole visible list; `drawn` is sorted.
CullingComparison compareWithOracle(const formats::PackView& view, const OracleView& oracle,
                                    std::span<const DrawnCluster> drawn);

/// Check the guarantee behind all culling: of the clusters in the cut that are not in `drawn` (sorted), count
/// those with a triangle that could cover a pixel. Such a triangle faces the eye and is not wholly outside
/// any frustum plane.
uint64_t countUnjustlyCulled(const PackGeometry& geometry, const OracleView& oracle,
                             std::span<const DrawnCluster> drawn);

/// Largest singular value of the linear part.
double largestStretch(const Affine3& transform);

} // namespace hearth::reference
