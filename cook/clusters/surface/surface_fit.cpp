// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/surface_fit.h"

#include "cook/clusters/core/facet_fan.h"
#include "cook/clusters/core/islands.h"
#include "cook/clusters/simplify/turning.h"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace hearth::clusters
{

namespace
{

// The residual at a vertex is a mean over the triangles around it: right where all of them have the same
// residual, too small elsewhere. So steps are longer.
constexpr float kOverrelaxation = 1.3f;

// Tolerance of the foot of a perpendicular, in parts of a triangle's edges.
constexpr float kUpright = 1e-3f;

class SurfaceFit
{
public:
    SurfaceFit(const GroupMesh& group, Simplified& simplified, Surface& after, SurfacePoints& points)
        : group_(group),
          placement_(simplified.placement),
          corners_(simplified.corners),
          after_(after),
          points_(points),
          place_rests_(group.positions.size()),
          exact_weights_(group.positions.size(), 0),
          exact_distance2_(
              static_cast<float>(group.grid_step * group.grid_step / (group.scale * group.scale))),
          attribute_rests_(group.attributes.size()),
          attribute_weights_(group.vertex_of_wedge.size(), 0)
    {
    }

    void run()
    {
        for (uint32_t triangle = 0; triangle < points_.of_middle.size(); ++triangle)
            if (points_.of_middle[triangle].facet != kNoFacet)
                addMiddle(triangle);
        for (uint32_t wedge = 0; wedge < attribute_weights_.size(); ++wedge)
        {
            const bool has_rest = attribute_weights_[wedge] > 0;
            const bool remade = placement_.remade[group_.position_of_wedge[wedge]] != 0;
            if (has_rest & remade)
                changeAttributes(wedge);
        }
        for (uint32_t position = 0; position < place_rests_.size(); ++position)
        {
            const bool has_rest = place_rests_[position][3] > 2 * exact_weights_[position];
            const bool remade = placement_.remade[position] != 0;
            if (has_rest & remade)
                move(position);
        }
        after_.setPlaces(placement_.places);
        for (uint32_t position = 0; position < points_.of_position.size(); ++position)
            measure(points_.of_position[position], position);
        for (uint32_t wedge = 0; wedge < points_.of_wedge.size(); ++wedge)
            measure(points_.of_wedge[wedge], group_.position_of_wedge[wedge]);
    }

private:
    /// Distribute the residual between the middle of a triangle and its point on the new surface to the
    /// corners of the triangle there.
    void addMiddle(uint32_t triangle)
    {
        const uint32_t* before = &group_.corners[size_t{triangle} * 3];
        const FacetPoint& point = points_.of_middle[triangle];
        const uint32_t* after = &corners_[size_t{point.facet} * 3];
        const uint32_t* positions = &after_.positions[size_t{point.facet} * 3];
        const Float3 a = group_.positions[group_.position_of_wedge[before[0]]];
        const Float3 b = group_.positions[group_.position_of_wedge[before[1]]];
        const Float3 c = group_.positions[group_.position_of_wedge[before[2]]];
        const Float3 away = triangleCenter(a, b, c) - placeOf(point, after_.facets);
        if (!isUpright(point, away))
            return;
        const float area = length(cross(b - a, c - a));
        const std::array<float, 3> parts = point.parts();
        const Lanes rest = Lanes{away.x, away.y, away.z, 1} * allLanes(area);
        for (size_t k = 0; k < 3; ++k)
            place_rests_[positions[k]] += rest * allLanes(parts[k]);
        if (dot(away, away) <= exact_distance2_)
            for (size_t k = 0; k < 3; ++k)
                exact_weights_[positions[k]] += area * parts[k];
        // at a seam both sides would have to change equally, and the middle may lie on the other side
        if ((points_.on_seam[positions[0]] | points_.on_seam[positions[1]] | points_.on_seam[positions[2]]) ==
            0)
            addAttributes(before, after, parts, area);
    }

    /// True if the line to a point is perpendicular to the triangle. On the rim of the fan it is not: other
    /// triangles may be nearer there.
    bool isUpright(const FacetPoint& point, Float3 away) const
    {
        const Facet& facet = after_.facets[point.facet];
        return std::abs(dot(away, facet.ab)) <= kUpright * facet.ab_ab &&
               std::abs(dot(away, facet.ac)) <= kUpright * facet.ac_ac;
    }

    void addAttributes(const uint32_t* before, const uint32_t* after, const std::array<float, 3>& parts,
                       float area)
    {
        const uint32_t rows = group_.attribute_rows;
        const Lanes* of_after = placement_.attributes.data();
        for (uint32_t r = 0; r < rows; ++r)
        {
            Lanes rest = (group_.attributesOf(before[0])[r] + group_.attributesOf(before[1])[r] +
                          group_.attributesOf(before[2])[r]) *
                         allLanes(1.0f / 3);
            for (size_t k = 0; k < 3; ++k)
                rest -= of_after[size_t{after[k]} * rows + r] * allLanes(parts[k]);
            rest *= allLanes(area);
            for (size_t k = 0; k < 3; ++k)
                attribute_rests_[size_t{after[k]} * rows + r] += rest * allLanes(parts[k]);
        }
        for (size_t k = 0; k < 3; ++k)
            attribute_weights_[after[k]] += parts[k] * area;
    }

    void changeAttributes(uint32_t wedge)
    {
        const Lanes step = allLanes(kOverrelaxation / attribute_weights_[wedge]);
        const size_t first = size_t{wedge} * group_.attribute_rows;
        for (size_t row = first; row < first + group_.attribute_rows; ++row)
            placement_.attributes[row] += attribute_rests_[row] * step;
    }

    void move(uint32_t position)
    {
        const Lanes step = place_rests_[position] * allLanes(kOverrelaxation / place_rests_[position][3]);
        const Float3 object_place =
            objectPlace(group_, placement_.places[position] + Float3{step[0], step[1], step[2]});
        const Float3 place = localPlace(group_, object_place);
        if (turnsOver(position, place))
            return;
        placement_.places[position] = place;
        placement_.object_places[position] = object_place;
    }

    bool turnsOver(uint32_t position, Float3 place) const
    {
        const std::vector<Float3>& places = placement_.places;
        for (const uint32_t facet : after_.facets_at.of(position))
        {
            const uint32_t* p = &after_.positions[size_t{facet} * 3];
            const size_t k = (p[1] == position ? 1u : 0u) + (p[2] == position ? 2u : 0u);
            if (turnsTriangle(places[p[(k + 1) % 3]], places[p[(k + 2) % 3]], places[position], place))
                return true;
        }
        return false;
    }

    void measure(FacetPoint& point, uint32_t position) const
    {
        if (point.facet == kNoFacet)
            return;
        const Float3 away = group_.positions[position] - placeOf(point, after_.facets);
        point.distance2 = dot(away, away);
    }

    const GroupMesh& group_;
    Placement& placement_;
    std::span<const uint32_t> corners_; ///< wedges of the new surface's triangles
    Surface& after_;
    SurfacePoints& points_;
    std::vector<Lanes> place_rests_;       ///< sum for each position, and its weight
    std::vector<float> exact_weights_;     ///< part of the weight that is already on the new surface
    float exact_distance2_;                ///< resolution of the grid
    std::vector<Lanes> attribute_rests_;   ///< rows of each wedge
    std::vector<float> attribute_weights_; ///< for each wedge
};

} // namespace

void fitToGroup(const GroupMesh& group, Simplified& simplified, Surface& after, SurfacePoints& points)
{
    if (!points.of_middle.empty())
        SurfaceFit(group, simplified, after, points).run();
}

} // namespace hearth::clusters
