// Measures the distance between a cut and its source: two-sided distances of surface samples, of normals and
// UVs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/levels/validate.h"
#include "tests/support/surfaces/surface_distance.h"

namespace hearth::bench
{

struct CutSurface
{
    std::vector<Float3> positions;
    std::vector<Float3> normals;     ///< one for each position; empty if the mesh has none
    std::vector<Float3> uvs;         ///< UV set 0 of each position, z = 0
    std::vector<uint32_t> triangles; ///< three position ids each
    double stored_error = 0;         ///< maximum of the clusters' errors
    double stored_normal_rms = 0;    ///< radians; mean over the area of the clusters
    double stored_uv_rms = 0;        ///< object space; mean over the area of the clusters

    size_t triangleCount() const { return triangles.size() / 3; }
};

/// Surface of the source mesh, before quantisation to a grid.
CutSurface surfaceOfMesh(const mesh::SourceMesh& mesh);

/// Surface that is drawn if every group up to this error is replaced.
CutSurface surfaceOfCut(const clusters::Hierarchy& hierarchy, const clusters::DecodedHierarchy& decoded,
                        double error);

/// Two-sided distances of evenly distributed sample points.
struct CutQuality
{
    size_t triangles = 0;
    double rms = 0;            ///< object space
    double max = 0;            ///< over the points and all corners
    double normal_rms_deg = 0; ///< points on the cut against the source; 0 without normals
    double uv_rms = 0;         ///< the same for UVs, as lengths on the surface
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
