// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/surfaces/cgal_distance.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

namespace hearth
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Triangles that share nothing, since CGAL's mesh holds manifolds only: the distance needs no edges.
Mesh makeMesh(const TriangleSurface& surface)
{
    Mesh mesh;
    for (size_t t = 0; t < surface.triangles.size(); t += 3)
    {
        const auto vertex = [&](size_t k)
        {
            const Float3 place = surface.positions[surface.triangles[t + k]];
            return mesh.add_vertex({place.x, place.y, place.z});
        };
        const auto a = vertex(0), b = vertex(1), c = vertex(2);
        mesh.add_face(a, b, c);
    }
    return mesh;
}

} // namespace

double cgalDistance(const TriangleSurface& from, const TriangleSurface& to, double error)
{
    return CGAL::Polygon_mesh_processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(
        makeMesh(from), makeMesh(to), error);
}

} // namespace hearth
