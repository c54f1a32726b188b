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

/// Triangles that share nothing, since CGAL's mesh holds manifolds only: the distance needs no edges. CGAL
/// has no nearest point on triangles whose corners lie on a line.
Mesh makeMesh(const TriangleSurface& surface)
{
    Mesh mesh;
    for (size_t t = 0; t < surface.triangles.size(); t += 3)
    {
        const auto corner = [&](size_t k)
        {
            const Float3 place = surface.positions[surface.triangles[t + k]];
            return Kernel::Point_3(place.x, place.y, place.z);
        };
        const Kernel::Point_3 a = corner(0), b = corner(1), c = corner(2);
        if (CGAL::collinear(a, b, c))
            continue;
        const auto first = mesh.add_vertex(a), second = mesh.add_vertex(b), third = mesh.add_vertex(c);
        mesh.add_face(first, second, third);
    }
    return mesh;
}

} // namespace

double cgalDistance(const TriangleSurface& from, const TriangleSurface& to, double error)
{
    const Mesh mesh = makeMesh(from);
    if (mesh.number_of_faces() == 0)
        return 0;
    return CGAL::Polygon_mesh_processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(
        mesh, makeMesh(to), error);
}

} // namespace hearth
