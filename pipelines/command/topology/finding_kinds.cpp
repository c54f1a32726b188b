// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/topology/finding_kinds.h"

namespace hearth::command
{

std::span<const FindingKind> findingKinds()
{
    static constexpr FindingKind kKinds[] = {
        {"flipped_shells",
         "flipped shells",
         "closed pieces that face inwards: culled from outside, dark when lit. Recalculate their normals to "
         "the outside, unless they are rooms or skies seen from within",
         {230, 25, 75}},
        {"inconsistent_edges",
         "edges between opposite sides",
         "two triangles that face different sides. Recalculate the normals, or flip the fewer triangles",
         {245, 130, 48}},
        {"one_sided_shells",
         "one-sided shells",
         "pieces without an inside, as Moebius' strip. Cut them at an edge, or make them double-sided",
         {170, 110, 40}},
        {"non_manifold_edges",
         "non-manifold edges",
         "more than two triangles share them. Delete faces inside the model, or split the edge between its "
         "pieces",
         {240, 50, 230}},
        {"self_intersections",
         "intersecting triangles",
         "triangles pass through others. Join the pieces by a boolean union, or wrap the model",
         {128, 0, 0}},
        {"non_manifold_vertices",
         "non-manifold vertices",
         "pieces touch in one point only. Give each piece a vertex of its own, or join them by an edge",
         {145, 30, 180}},
        {"t_junctions",
         "T-junctions",
         "vertices within an edge of another triangle: pixels shine through where the edge is open. Cut the "
         "edge at the vertex",
         {255, 225, 25}},
        {"doubled_triangles",
         "doubled triangles",
         "drawn twice at one place. Merge by distance and delete the copies; of leaves with two sides make "
         "the material double-sided instead",
         {0, 130, 200}},
        {"boundary_loops",
         "boundary loops",
         "the surface ends there. Fill holes, merge vertices that nearly meet; rims of cloth, leaves and "
         "terrain are right",
         {60, 180, 75}},
        {"zero_area_triangles",
         "triangles without area",
         "nothing shows them, and cooks leave them out. Dissolve degenerate faces",
         {70, 240, 240}},
        {"duplicate_vertices",
         "duplicate vertices",
         "equal in every attribute: cooks join them. Merge them for a smaller file",
         {128, 128, 128}},
        {"unreferenced_vertices",
         "unreferenced vertices",
         "no triangle uses them, and cooks leave them out. Delete loose vertices",
         {200, 200, 200}},
    };
    return kKinds;
}

} // namespace hearth::command
