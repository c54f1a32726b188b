// How far a cut is from its source, as the peers were measured: design notes, PEERS, "Method" and section 4.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/levels/validate.h"
#include "tests/support/surface_distance.h"

namespace hearth::bench
{

struct CutSurface
{
    std::vector<Float3> positions;
    std::vector<Float3> normals;     ///< for each position; empty where the mesh has none
    std::vector<Float3> uvs;         ///< the same of set 0, z = 0
    std::vector<uint32_t> triangles; ///< three positions for each
    double stored_error = 0;         ///< largest error of its clusters
    double stored_normal_rms = 0;    ///< radians: over the area of its clusters
    double stored_uv_rms = 0;        ///< object space

    size_t triangleCount() const { return triangles.size() / 3; }
};

/// The source itself, before anything was moved to a grid.
CutSurface surfaceOfMesh(const mesh::SourceMesh& mesh);

/// What is drawn where every group up to this error is replaced.
CutSurface surfaceOfCut(const clusters::Hierarchy& hierarchy, const clusters::DecodedHierarchy& decoded,
                        double error);

/// Two-sided distances of evenly spread points.
struct CutQuality
{
    size_t triangles = 0;
    double rms = 0;            ///< object space
    double max = 0;            ///< of the points and all corners
    double normal_rms_deg = 0; ///< of points on the cut against the source; 0 without normals
    double uv_rms = 0;         ///< the same of UVs, as lengths on the surface
    double stored_error = 0;
    double stored_normal_rms_deg = 0;
    double stored_uv_rms = 0;
};

class CutMeter
{
public:
    /// source  outlives the meter;  samples  points on each side
    CutMeter(const CutSurface& source, size_t samples);

    /// Uses all threads.
    CutQuality measure(const CutSurface& cut) const;

private:
    const CutSurface& source_;
    size_t samples_;
    SurfaceDistance to_source_;
    std::vector<SurfacePoint> on_source_;
};

} // namespace hearth::bench
