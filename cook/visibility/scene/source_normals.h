// Finds the normals of the source behind the rounded normals of vertices. Ambient occlusion is taken about
// them: about a normal that is 0.7 degrees off, as codes of 8 bits may be, that of a wall is wrong by up to
// .006, the same everywhere on it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>
#include <vector>

namespace hearth::visibility
{

/// Normals of the source's vertices by grid position and rounded normal. Takes 16 bytes a vertex; empty where
/// normals have 16 bits a component, whose error of 0.003 degrees does not count.
class SourceNormals
{
public:
    /// positions, normals  of the source: normals finite; none if the mesh has no normals
    /// layout, grid_step   of the mesh's clusters
    SourceNormals(std::span<const Float3> positions, std::span<const Float3> normals, uint32_t layout,
                  float grid_step);

    /// Read the source of a mesh from the import part.
    /// errors: those of mesh::readSourceMesh
    static Result<SourceNormals> read(const formats::PackView& import_part, uint32_t mesh,
                                      const formats::MeshRecord& record);

    /// Return the unit normal of the source's vertex with this position and normal, the mean of several.
    /// Simplification moves vertices: where the source has none, return the mean of its normals with the
    /// same code, which is exact on flat surfaces, and without any the normal itself.
    /// position, normal  as decoded
    Float3 find(Float3 position, Float3 normal) const;

private:
    struct Vertex
    {
        uint32_t code;  ///< of the rounded normal
        uint32_t fine;  ///< the normal in 2 x 16 bits
        uint64_t place; ///< hash of the grid position
    };
    /// Vertices with one code, and the mean of their normals.
    struct Facing
    {
        uint32_t code;
        size_t first;
        Float3 mean;
    };
    static Float3 meanNormal(std::span<const Vertex> vertices, Float3 fallback);

    uint32_t layout_;
    std::vector<Vertex> vertices_; ///< by code, then by place
    std::vector<Facing> facings_;  ///< by code
};

/// Rotate `v` by the smallest rotation that takes the unit vector `from` to the unit vector `to`, which is
/// not opposite. Moments that are turned from the source's normal to the rounded one keep their lengths and
/// their angles with the normal, so ambient occlusion and cone are those of the source's normal.
Float3 turnWithNormal(Float3 v, Float3 from, Float3 to);

} // namespace hearth::visibility
