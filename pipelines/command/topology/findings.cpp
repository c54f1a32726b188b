// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/topology/findings.h"

#include "formats/base/double3.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace hearth::command
{

using namespace topology;

namespace
{

Json pointJson(Float3 p)
{
    return {p.x, p.y, p.z};
}

std::string atText(Float3 p)
{
    return fmt::format("at ({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z);
}

uint32_t addPosition(FindingGeometry& geometry, Float3 position)
{
    geometry.positions.push_back(position);
    return static_cast<uint32_t>(geometry.positions.size() - 1);
}

void addPoint(FindingGeometry& geometry, Float3 position)
{
    geometry.points.push_back(addPosition(geometry, position));
}

void addEdge(FindingGeometry& geometry, Float3 from, Float3 to)
{
    const uint32_t first = addPosition(geometry, from);
    geometry.edges.push_back({first, addPosition(geometry, to)});
}

void addFace(FindingGeometry& geometry, const std::array<Float3, 3>& corners)
{
    const uint32_t first = addPosition(geometry, corners[0]);
    addPosition(geometry, corners[1]);
    addPosition(geometry, corners[2]);
    geometry.faces.push_back({first, first + 1, first + 2});
}

/// Collects the findings of one mesh, kind by kind.
class Collector
{
public:
    Collector(const mesh::SourceMesh& mesh, const Topology& topology) : mesh_(mesh), topology_(topology) {}

    /// Collect the shells for which `isOfKind` is true.
    template <typename IsOfKind>
    FindingGroup collectShells(Finding finding, const IsOfKind& isOfKind) const
    {
        FindingGroup group{.finding = finding};
        uint64_t triangles = 0;
        const Shells& shells = topology_.shells;
        for (const Shell& shell : shells.shells)
            if (isOfKind(shell))
            {
                if (group.count++ == 0)
                    group.detail = atText(position(surface().corners[3 * size_t{shell.first_triangle}]));
                triangles += shell.triangles;
            }
        for (uint32_t t = 0; t < surface().triangleCount(); ++t)
            if (isOfKind(shells.shells[shells.shell_of_triangle[t]]))
                addFace(group.geometry, findTriangle(surface().source_of_triangle[t]));
        group.detail = fmt::format("of {} triangles, the first {}", triangles, group.detail);
        group.json = {{"triangles", triangles}};
        return group;
    }

    FindingGroup collectEdges(Finding finding, const std::vector<uint32_t>& found) const
    {
        FindingGroup group{.finding = finding, .count = found.size()};
        Json list = Json::array();
        for (const uint32_t e : found)
        {
            const Edge& edge = topology_.edges.edges[e];
            addEdge(group.geometry, position(edge.from), position(edge.to));
            if (list.size() < kMaxListed)
                list.push_back({{"from", pointJson(position(edge.from))},
                                {"to", pointJson(position(edge.to))},
                                {"triangles", edge.count}});
        }
        if (!found.empty())
            group.detail = "the first " + atText(position(topology_.edges.edges[found[0]].from));
        group.json = {{"list", std::move(list)}};
        return group;
    }

    /// Collect the edges between opposite sides, with the fewer triangles of each shell that has some.
    FindingGroup collectInconsistentEdges() const
    {
        FindingGroup group = collectEdges(Finding::inconsistent_edges, topology_.inconsistent_edges);
        uint64_t reversed = 0;
        for (uint32_t t = 0; t < surface().triangleCount(); ++t)
            if (topology_.shells.is_reversed[t])
            {
                ++reversed;
                addFace(group.geometry, findTriangle(surface().source_of_triangle[t]));
            }
        group.detail = fmt::format("{} triangles face the other side; {}", reversed, group.detail);
        group.json["reversed_triangles"] = reversed;
        return group;
    }

    FindingGroup collectVertices() const
    {
        FindingGroup group{.finding = Finding::non_manifold_vertices,
                           .count = topology_.non_manifold_vertices.size()};
        Json list = Json::array();
        for (const NonManifoldVertex& vertex : topology_.non_manifold_vertices)
        {
            addPoint(group.geometry, position(vertex.position));
            if (list.size() < kMaxListed)
                list.push_back({{"position", pointJson(position(vertex.position))}, {"fans", vertex.fans}});
        }
        if (group.count > 0)
            group.detail = "the first " + atText(position(topology_.non_manifold_vertices[0].position));
        group.json = {{"list", std::move(list)}};
        return group;
    }

    FindingGroup collectTJunctions() const
    {
        FindingGroup group{.finding = Finding::t_junctions, .count = topology_.t_junctions.size()};
        Json list = Json::array();
        uint64_t open = 0;
        for (const TJunction& junction : topology_.t_junctions)
        {
            const Edge& edge = topology_.edges.edges[junction.edge];
            open += edge.count == 1 ? 1 : 0;
            addPoint(group.geometry, position(junction.position));
            addEdge(group.geometry, position(edge.from), position(edge.to));
            if (list.size() < kMaxListed)
                list.push_back({{"position", pointJson(position(junction.position))},
                                {"from", pointJson(position(edge.from))},
                                {"to", pointJson(position(edge.to))},
                                {"is_open", edge.count == 1}});
        }
        if (group.count > 0)
            group.detail = fmt::format("{} on open edges; the first {}", open,
                                       atText(position(topology_.t_junctions[0].position)));
        group.json = {{"on_open_edges", open}, {"list", std::move(list)}};
        return group;
    }

    FindingGroup collectDoubled() const
    {
        FindingGroup group{.finding = Finding::doubled_triangles, .count = surface().doubled.size()};
        uint64_t opposite = 0;
        for (const DoubledTriangle& pair : surface().doubled)
        {
            opposite += pair.is_opposite ? 1 : 0;
            addFace(group.geometry, findTriangle(pair.copy));
        }
        const auto& shells = topology_.shells.shells;
        const auto whole = std::count_if(shells.begin(), shells.end(),
                                         [](const Shell& shell) { return shell.doubled == shell.triangles; });
        if (group.count > 0)
            group.detail = fmt::format("{} facing the other side; {} whole shells; the first {}", opposite,
                                       whole, atText(findTriangle(surface().doubled[0].copy)[0]));
        group.json = {{"opposite", opposite}, {"whole_shells", whole}};
        return group;
    }

    FindingGroup collectBoundaryLoops() const
    {
        const std::vector<BoundaryLoop>& loops = topology_.boundary_loops;
        FindingGroup group{.finding = Finding::boundary_loops, .count = loops.size()};
        Json list = Json::array();
        uint64_t edges = 0;
        double length = 0;
        for (const BoundaryLoop& loop : loops)
        {
            edges += loop.edgeCount();
            length += loop.length;
            const auto first = static_cast<uint32_t>(group.geometry.positions.size());
            const auto size = static_cast<uint32_t>(loop.positions.size());
            for (const uint32_t id : loop.positions)
                addPosition(group.geometry, position(id));
            for (uint32_t i = 0; i < loop.edgeCount(); ++i)
                group.geometry.edges.push_back({first + i, first + (i + 1) % size});
            if (list.size() < kMaxListed)
                list.push_back({{"length", loop.length},
                                {"edges", loop.edgeCount()},
                                {"is_closed", loop.is_closed},
                                {"position", pointJson(position(loop.positions[0]))}});
        }
        if (group.count > 0)
            group.detail = fmt::format("{} edges, {:.4g} m; the longest of {:.4g} m {}", edges, length,
                                       loops[0].length, atText(position(loops[0].positions[0])));
        group.json = {{"edges", edges}, {"length", length}, {"list", std::move(list)}};
        return group;
    }

    FindingGroup collectZeroArea() const
    {
        FindingGroup group{.finding = Finding::zero_area_triangles, .count = surface().zero_area.size()};
        for (const uint32_t triangle : surface().zero_area)
        {
            const std::array<Float3, 3> corners = findTriangle(triangle);
            addEdge(group.geometry, corners[0], corners[1]);
            addEdge(group.geometry, corners[1], corners[2]);
        }
        if (group.count > 0)
            group.detail = "the first " + atText(findTriangle(surface().zero_area[0])[0]);
        group.json = Json::object();
        return group;
    }

    FindingGroup collectUnreferenced() const
    {
        FindingGroup group{.finding = Finding::unreferenced_vertices,
                           .count = topology_.unreferenced_vertices.size()};
        for (const uint32_t vertex : topology_.unreferenced_vertices)
            addPoint(group.geometry, mesh_.positions[vertex]);
        if (group.count > 0)
            group.detail = "the first " + atText(mesh_.positions[topology_.unreferenced_vertices[0]]);
        group.json = Json::object();
        return group;
    }

    FindingGroup collectDuplicates() const
    {
        return {.finding = Finding::duplicate_vertices,
                .count = topology_.duplicate_vertices,
                .detail = "",
                .json = Json::object(),
                .geometry = {}};
    }

    FindingGroup collectIntersections(const SelfIntersections& intersections) const
    {
        FindingGroup group{.finding = Finding::self_intersections, .count = intersections.triangle_pairs};
        std::vector<std::array<uint32_t, 2>> pairs = intersections.pairs;
        std::erase_if(pairs, [&](const auto& pair) // another program names them: it is not trusted
                      { return std::max(pair[0], pair[1]) >= mesh_.triangleCount(); });
        std::vector<uint32_t> triangles;
        for (const auto& pair : pairs)
            triangles.insert(triangles.end(), pair.begin(), pair.end());
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        for (const uint32_t triangle : triangles)
            addFace(group.geometry, findTriangle(triangle));
        group.detail = "pairs";
        if (!triangles.empty())
            group.detail += "; the first " + atText(findTriangle(pairs[0][0])[0]);
        group.json = {{"list", pairs}};
        return group;
    }

private:
    const Surface& surface() const { return topology_.surface; }
    Float3 position(uint32_t id) const { return topology_.surface.positions[id]; }
    std::array<Float3, 3> findTriangle(uint32_t source_triangle) const
    {
        const uint32_t* const vertices = &mesh_.indices[size_t{3} * source_triangle];
        return {mesh_.positions[vertices[0]], mesh_.positions[vertices[1]], mesh_.positions[vertices[2]]};
    }

    const mesh::SourceMesh& mesh_;
    const Topology& topology_;
};

/// Sort the shells by size, and find a corner of each.
void addShells(const Topology& topology, MeshFindings& findings)
{
    findings.shells = topology.shells.shells;
    std::stable_sort(findings.shells.begin(), findings.shells.end(),
                     [](const Shell& a, const Shell& b) { return a.triangles > b.triangles; });
    for (const Shell& shell : findings.shells)
        findings.shell_positions.push_back(
            topology.surface.positions[topology.surface.corners[size_t{3} * shell.first_triangle]]);
}

} // namespace

MeshFindings collectFindings(const mesh::SourceMesh& mesh, uint32_t index,
                             const std::optional<SelfIntersections>& intersections)
{
    const Topology topology = analyzeTopology(mesh);
    MeshFindings findings{.mesh = index,
                          .name = mesh.name,
                          .triangles = static_cast<uint32_t>(mesh.triangleCount()),
                          .vertices = static_cast<uint32_t>(mesh.vertexCount()),
                          .positions = static_cast<uint32_t>(topology.surface.positions.size()),
                          .components = topology.components,
                          .tolerance = topology.t_junction_tolerance,
                          .shells = {},
                          .shell_positions = {},
                          .groups = {}};
    addShells(topology, findings);
    const Collector collector(mesh, topology);
    const auto add = [&](FindingGroup group)
    {
        if (group.count > 0)
            findings.groups.push_back(std::move(group));
    };
    add(collector.collectShells(Finding::flipped_shells,
                                [](const Shell& shell) { return shell.side == ShellSide::flipped; }));
    add(collector.collectInconsistentEdges());
    add(collector.collectShells(Finding::one_sided_shells,
                                [](const Shell& shell) { return !shell.is_orientable; }));
    add(collector.collectEdges(Finding::non_manifold_edges, topology.non_manifold_edges));
    if (intersections)
        add(collector.collectIntersections(*intersections));
    add(collector.collectVertices());
    add(collector.collectTJunctions());
    add(collector.collectDoubled());
    add(collector.collectBoundaryLoops());
    add(collector.collectZeroArea());
    add(collector.collectDuplicates());
    add(collector.collectUnreferenced());
    return findings;
}

const FindingGroup* findGroup(const MeshFindings& mesh, Finding finding)
{
    const auto found = std::find_if(mesh.groups.begin(), mesh.groups.end(),
                                    [&](const FindingGroup& group) { return group.finding == finding; });
    return found == mesh.groups.end() ? nullptr : &*found;
}

const char* shellSideName(ShellSide side)
{
    switch (side)
    {
    case ShellSide::open:
        return "open";
    case ShellSide::outward:
        return "outward";
    case ShellSide::cavity:
        return "cavity";
    case ShellSide::flipped:
        return "flipped";
    case ShellSide::flat:
        return "flat";
    case ShellSide::unclear:
        return "unclear";
    }
    return "";
}

} // namespace hearth::command
