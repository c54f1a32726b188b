// Bakes the visibility of shapes with `hearth cook` and reads it back out of the pack, for tests of baked
// occlusion.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "sample_assets/shapes/document.h"
#include "tests/support/sandbox.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace hearth::test
{

/// Triangle mesh that is written as PLY.
struct Shape
{
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< empty: import makes them
    std::vector<std::array<uint32_t, 3>> triangles;

    /// Add a parallelogram of n x m quads that faces cross(u, v).
    void addGrid(Float3 corner, Float3 u, Float3 v, uint32_t n, uint32_t m);
    /// Add a sheet with positions `place` over [0, 1]^2; it faces the cross product of its derivatives.
    void addSheet(uint32_t n, uint32_t m, const std::function<Float3(double, double)>& place);

    std::string ply() const;
};

/// Return a box of 8 x 8 quads a side between the origin and `size`, which faces outwards.
Shape makeBox(Float3 size);

/// Return the shape as a primitive of a sample scene.
samples::Primitive makePrimitive(const Shape& shape, int material);

/// Vertex with visibility, as hearth extract writes it.
struct SeenVertex
{
    Float3 position, normal, axis;
    float aperture, scale, ao, m0;
    Float3 m1;
};
static_assert(sizeof(SeenVertex) == 16 * sizeof(float));

/// Return the vertices of the finest level of a mesh, which must have visibility and no UVs.
std::vector<SeenVertex> extractVertices(Sandbox& sandbox, const std::string& pack, uint32_t mesh = 0);

/// Cook the shape with `--visibility` and these flags, verify the pack, and return its vertices.
/// sandbox  gets shape.ply and shape.hearth
std::vector<SeenVertex> bakeShape(Sandbox& sandbox, const Shape& shape,
                                  const std::vector<std::string>& flags);

/// Return the rms difference of the ambient occlusion of equal meshes.
double rmsDifference(const std::vector<SeenVertex>& a, const std::vector<SeenVertex>& b);

} // namespace hearth::test
